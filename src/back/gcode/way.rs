//! What the axes do while a run is cut: pieces of the centre's way, each an arc or a line with C linear along it.

use super::fade::{Beside, Fade};
use super::fit::{Ends, fit};
use super::tube::Tube;
use crate::geom::{Heading, Point, Rotation, Vector, angle, left, polyline};
use crate::ir::toolpath::{Pose, Run, Shape};
use crate::machine::Job;

/// Part of the permitted angle by which C may be off where it turns evenly along arcs; the rest is for decimals.
const TURN_SHARE: f64 = 0.9;
/// The same where lines stand for arcs, which are off by as much again.
pub(super) const LINE_SHARE: f64 = 0.45;
/// The part of that which joining a piece too short to be told may take.
const ASKEW_SHARE: f64 = 0.25;
/// The most of the tolerance that the bow of a chord may take.
const BOW_SHARE: f64 = 0.5;
/// Shorter ways are none, mm.
const LENGTH_EPSILON: f64 = 1e-3;
/// An arc that turns by less is a line, rad: controllers take those of a millionth for whole turns.
const TURN_MIN: f64 = 2e-5;
/// An arc that bows by less is a line, mm.
const BOW_MIN: f64 = 1e-5;
/// Shortest part of a fade, mm: shorter ones are no truer, because places are rounded.
const FADING_MIN: f64 = 0.02;
/// Shortest piece that is written, in steps of the last decimal: rounding turns its direction by less than a fifth of a
/// degree.
const STEPS_MIN: f64 = 400.0;

/// A piece of the centre's way.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::back) struct Piece {
    /// Where it ends.
    pub(super) to: Pose,
    /// The centre of its arc and how far it turns, rad; `None` = straight.
    pub(super) arc: Option<(Point, f64)>,
    /// Way of the C axis, mm.
    pub(super) length: f64,
    /// Greatest speed of the C axis that lets the tip keep its own, mm/s; infinite when nothing caps it.
    pub(super) speed: f64,
}

impl Piece {
    /// The piece from a pose along which the tip goes a way that turns.
    fn from(from: Pose, to: Pose, tip: Tip) -> Self {
        let chord = to.centre - from.centre;
        let turn = tip.turn + tip.more;
        let (width, half) = (chord.norm(), 0.5 * turn);
        let bows = width * half.abs() / 4.0 > BOW_MIN && turn.abs() > TURN_MIN;
        let is_arc = width > LENGTH_EPSILON && bows;
        let (arc, length) = if is_arc {
            let centre = from.centre + chord * 0.5 + left(chord) * (0.5 / half.tan());
            (Some((centre, turn)), width * half / half.sin())
        } else {
            (None, width)
        };
        Self { to, arc, length, speed: tip.feed * length / tip.length }
    }
}

/// A way of the tip.
#[derive(Debug, Clone, Copy)]
struct Tip {
    /// Where it starts and ends.
    ends: [Point; 2],
    /// Unit vector along it where it starts.
    along: Vector,
    /// How far it turns, rad.
    turn: f64,
    /// How much more the way of the C axis turns beside it, rad: where the blade fades from chord to tangent.
    more: f64,
    /// mm.
    length: f64,
    /// Its greatest speed, mm/s.
    feed: f64,
}

/// The way of a run.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::back) struct Way {
    /// Where the axes plunge.
    pub(super) start: Pose,
    pub(super) pieces: Vec<Piece>,
}

/// Joins what is too short to be told with what comes behind it; with what is before it at the end, and where one arc for
/// both would lie less askew to them.
struct Pieces {
    way: Way,
    /// Where the last piece begins, and what the tip does on it.
    last: Option<(Pose, Tip)>,
    /// Where the next piece begins.
    next: Pose,
    /// What the tip did since, and where that ends: too short to be told.
    short: Option<(Pose, Tip)>,
    length_min: f64,
    /// By how much a joined piece may lie askew to the way of the tip, rad.
    askew_max: f64,
}

impl Pieces {
    /// None yet, with room for so many.
    fn with_room(pieces: usize, start: Pose, [length_min, askew_max]: [f64; 2]) -> Self {
        let way = Way { start, pieces: Vec::with_capacity(pieces) };
        Self { way, last: None, next: start, short: None, length_min, askew_max }
    }

    fn push(&mut self, to: Pose, tip: Tip) {
        let mut tip = tip;
        if let Some((end, short)) = self.short.take() {
            let joined = short.and(tip);
            let backward = self.last.map(|(_, last)| last.and(short));
            if joined.askew() > self.askew_max && backward.is_some_and(|back| back.askew() < joined.askew()) {
                self.join(end, short);
            } else {
                tip = joined;
            }
        }
        if (to.centre - self.next.centre).norm() < self.length_min {
            self.short = Some((to, tip));
        } else {
            self.way.pieces.push(Piece::from(self.next, to, tip));
            (self.last, self.next) = (Some((self.next, tip)), to);
        }
    }

    /// Makes what the tip does up to a pose part of the last piece.
    fn join(&mut self, to: Pose, tip: Tip) {
        let (from, tip) = self.last.map_or((self.next, tip), |(from, last)| (from, last.and(tip)));
        self.way.pieces.pop();
        self.way.pieces.push(Piece::from(from, to, tip));
        (self.last, self.next) = (Some((from, tip)), to);
    }

    fn finish(mut self) -> Way {
        if let Some((to, tip)) = self.short {
            self.join(to, tip);
        }
        self.way
    }
}

impl Tip {
    fn and(self, next: Self) -> Self {
        Self {
            ends: [self.ends[0], next.ends[1]],
            along: self.along,
            turn: self.turn + next.turn,
            more: self.more + next.more,
            length: self.length + next.length,
            feed: self.feed.min(next.feed),
        }
    }

    /// By how much one arc from its start to its end lies askew to it at both, rad: none when it is that arc.
    fn askew(&self) -> f64 {
        let chord = self.ends[1] - self.ends[0];
        angle::wrap(angle::turn(self.along, chord) - 0.5 * self.turn).abs()
    }
}

impl Way {
    /// The same with C corrected by an angle, rad.
    #[must_use]
    pub(super) fn turned(mut self, by: f64) -> Self {
        for pose in std::iter::once(&mut self.start).chain(self.pieces.iter_mut().map(|piece| &mut piece.to)) {
            pose.c.0 += by;
        }
        self
    }
}

/// The way of a run; otherwise the point at which no arc stays in the tube.
pub(super) fn way(run: &Run, tolerance: f64, job: &Job) -> Result<Way, Point> {
    let (knife, keys) = (&job.profile.knife, &job.profile.gcode);
    let (points, chords, tail) = tip_line(run, knife.width_mm);
    let ring = run.shape == Shape::Ring;
    let turn = if ring { seam_turn(run) } else { 0.0 };
    let seam = [turn, if run.front == 0.0 { turn } else { 0.0 }];
    // Chords that stand for arcs leave them by a bow, which is taken from the tube.
    let bow = if keys.arcs { 0.0 } else { keys.chord_mm.min(BOW_SHARE * tolerance) };
    let tube = Tube::new(points, tolerance - bow, (seam, &job.profile));
    let start = if ring { at_seam(run) } else { tube.direction(0) };
    let end = if ring && run.front == 0.0 { start } else { tube.direction(tube.chords() - 1) };
    let stops = (1..chords.len()).filter(|&k| run.feeds[chords[k - 1]] != run.feeds[chords[k]]).collect();
    let arcs = fit(&tube, &Ends { start, end, stops })?;
    // Plunged as a chord, the blade lags behind its way and fades into it over its width.
    let length: f64 = arcs.iter().map(|arc| arc.length).sum();
    let lead = tail.map_or(0.0, |tail| angle::turn(tube.points[0] - tail, start));
    let first = Heading::new(start.y.atan2(start.x) - lead);
    let radius = run.edge.lead(knife.ends());
    let pose = |tip: Point, c: f64| Pose { centre: tip - Rotation(c).unit() * radius, c: Rotation(c) };
    let c = Rotation(run.start.c.0 - run.edge.turn()).nearest(first).0;
    let at = pose(tube.points[0], c);
    let permitted = if keys.arcs { TURN_SHARE } else { LINE_SHARE } * job.profile.blade_tolerance();
    let mut pieces = Pieces::with_room(arcs.len(), at, [STEPS_MIN * keys.step(), ASKEW_SHARE * permitted]);
    let fade = Fade::new(lead, [knife.width_mm, length], radius, permitted);
    let mut tangent = c + lead;
    let (mut done, mut beside) = (0.0, 0);
    for arc in &arcs {
        let feed = chords[beside..=arc.chord].iter().map(|&chord| run.feeds[chord]).fold(f64::INFINITY, f64::min);
        beside = arc.chord + usize::from(arc.stops);
        tangent += angle::turn(Rotation(tangent).unit(), arc.along);
        let mut from = 0.0;
        for part in fade.parts(Beside { arc, tangent, done }, FADING_MIN) {
            let (ends, along, length) = ([arc.at(from), arc.at(part.to)], arc.along_at(from), part.to - from);
            let turn = arc.curvature * length;
            pieces.push(pose(ends[1], part.c), Tip { ends, along, turn, more: part.turn - turn, length, feed });
            from = part.to;
        }
        tangent += arc.turn();
        done += arc.length;
    }
    Ok(pieces.finish())
}

/// Direction of a ring where it starts: that of the circle through its first point and both neighbours.
fn at_seam(run: &Run) -> Vector {
    let n = run.points.len();
    let (to, from) = (run.points[0] - run.points[n - 2], run.points[1] - run.points[0]);
    let (a, b) = (to.norm(), from.norm());
    (to * (b / a) + from * (a / b)).normalize()
}

/// Turn of a ring where it starts, rad.
fn seam_turn(run: &Run) -> f64 {
    let n = run.points.len();
    polyline::turn_at(run.points[n - 2], run.points[0], run.points[1])
}

/// The line of the tip from plunge to lift, the chord of the run that each of its chords lies on, and where the tail
/// plunges when the blade stands as a chord.
fn tip_line(run: &Run, width: f64) -> (Vec<Point>, Vec<usize>, Option<Point>) {
    let n = run.points.len();
    match run.shape {
        Shape::Ring => {
            let mut points = run.points.clone();
            let mut chords: Vec<usize> = (0..n - 1).collect();
            let mut left = run.front;
            let mut chord = 0;
            while left > LENGTH_EPSILON {
                let (a, b) = (run.points[chord], run.points[chord + 1]);
                let length = (b - a).norm();
                points.push(if left < length { a + (b - a) * (left / length) } else { b });
                chords.push(chord);
                left -= length;
                chord = (chord + 1) % (n - 1);
            }
            (points, chords, None)
        }
        Shape::Open => {
            let extended = run.extended();
            let heel = usize::from(run.heel > 0.0);
            let chord_of = |i: usize| i.saturating_sub(heel).min(n - 2);
            if width <= 0.0 {
                let chords = (0..extended.len() - 1).map(chord_of).collect();
                return (extended, chords, None);
            }
            let last = extended.len() - 1;
            let (tip, first) = polyline::first_at_distance(&extended, width).unwrap_or((extended[last], last - 1));
            let tail = extended[0];
            let mut points = vec![tip];
            let mut chords = Vec::new();
            for (i, &point) in extended.iter().enumerate().skip(first + 1) {
                if (point - points[points.len() - 1]).norm() > LENGTH_EPSILON {
                    points.push(point);
                    chords.push(chord_of(i - 1));
                }
            }
            if points.len() < 2 {
                // The tip stands at its end already: a way too short to be told from none.
                let along = polyline::direction(extended[last - 1], extended[last]).unwrap_or(Vector::new(1.0, 0.0));
                points.push(tip + along * LENGTH_EPSILON);
                chords.push(chord_of(last - 1));
            }
            (points, chords, Some(tail))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::back::gcode::fit::Arc;

    #[test]
    fn what_is_too_short_to_be_told_is_joined_to_what_it_lies_along() {
        let check = |curvatures: [f64; 3], expected: f64| {
            let (mut at, mut along) = (Point::origin(), Vector::new(1.0, 0.0));
            let mut pieces = Pieces::with_room(3, Pose::default(), [0.04, 0.002]);
            for (length, curvature) in [0.66, 0.02, 0.68].into_iter().zip(curvatures) {
                let arc = Arc { from: at, along, length, curvature, chord: 0, stops: false };
                let ends = [at, arc.at(length)];
                pieces.push(
                    Pose { centre: ends[1], ..Pose::default() },
                    Tip { ends, along, turn: arc.turn(), more: 0.0, length, feed: 1.0 },
                );
                (at, along) = (ends[1], arc.along_at(length));
            }
            let way = pieces.finish();
            assert_eq!((way.pieces.len(), way.pieces[1].to.centre), (2, at));
            assert!((way.pieces[0].length - expected).abs() < 1e-6, "{}", way.pieces[0].length);
        };
        // One arc for the end of a turn to the left and a turn to the right would be askew to both.
        check([0.5, 0.5, -0.5], 0.68);
        check([-0.5, 0.5, 0.5], 0.66);
        // Where it hardly would, it is joined with what comes.
        check([0.01, 0.01, -0.01], 0.66);
    }
}
