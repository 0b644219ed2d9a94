//! What the axes do while a run is cut: pieces of the centre's way, each an arc or a line with C linear along it.

use super::fade::{Beside, Fade};
use super::fit::{Ends, fit};
use super::tube::Tube;
use crate::geom::{Heading, Point, Rotation, Vector, angle, cross, left, polyline};
use crate::ir::toolpath::{Pose, Run, Shape};
use crate::machine::Job;
use crate::units::rad;

/// Part of the permitted angle by which C may be off where it turns evenly along arcs; the rest is for decimals.
const TURN_SHARE: f64 = 0.9;
/// The same where lines stand for arcs, which are off by as much again.
pub(super) const LINE_SHARE: f64 = 0.45;
/// The part of that which joining a piece too short to be told may take.
const ASKEW_SHARE: f64 = 0.25;
/// Part of the tolerance that the bow of a chord may take, beside what the fit may use: numbers of a file are rounded by
/// nearly as much as that, and in a narrower tube its curves would waver.
const BOW_SHARE: f64 = 0.03;
/// Part of the angle that a blade is judged by that joining a piece may take where it could be told by itself.
const FAIR_SHARE: f64 = 0.4;
/// Part of the tolerance that joining a piece too short to be told may take.
const OFF_SHARE: f64 = 0.02;
/// Shorter ways are none, mm.
const LENGTH_EPSILON: f64 = 1e-3;
/// An arc that turns by less is a line, rad: controllers take those of a millionth for whole turns.
const TURN_MIN: f64 = 2e-5;
/// An arc that bows by less is a line, mm.
const BOW_MIN: f64 = 1e-5;
/// Curvature of a way that straight lines of a few decimals can still follow, per mm: on a tighter one rounding turns short
/// lines, and long ones lie askew to it.
const GENTLE: f64 = 0.4;
/// How far about a place its direction is looked for on such a way, in tolerances, the first that leads to its end.
const GENTLE_REACHES: [f64; 4] = [10.0, 5.0, 20.0, 3.0];
/// Shortest part of a fade, mm: shorter ones are no truer, because places are rounded.
const FADING_MIN: f64 = 0.02;
/// Shortest piece that is written where it can be joined with its neighbour, in steps of the last decimal: rounding turns
/// its direction by less than a fifth of a degree.
const STEPS_MIN: f64 = 400.0;
/// Shortest piece that is written at all: rounding would make a turn on the spot of one that is much shorter.
const STEPS_LEAST: f64 = 50.0;

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
    /// Greatest speed of the tip, mm/s.
    pub(super) feed: f64,
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
        Self { to, arc, length, speed: tip.feed * length / tip.length, feed: tip.feed }
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
    /// From the C axis to the tip, mm.
    pub(super) radius: f64,
    /// By how much C stands askew to the direction from the axis to the tip, rad.
    pub(super) yaw: f64,
    /// How far a chord that stands for an arc may leave it, mm.
    pub(super) bow: f64,
}

/// What joining pieces may cost, and which are joined.
#[derive(Debug, Clone, Copy)]
struct Joining {
    /// Shorter pieces are joined when that costs little, mm.
    length_min: f64,
    /// Shorter ones always are, mm.
    length_least: f64,
    /// One that would lie farther askew to the way of the tip is joined with what is before it if that is better, rad.
    askew_max: f64,
    /// By how much a joined piece may lie askew to the way of the tip where it could be told by itself, rad.
    askew_fair: f64,
    /// By how much that may leave the way of the tip, mm.
    off_fair: f64,
}

/// What joining two ways of the tip costs.
#[derive(Debug, Clone, Copy)]
struct Joined {
    /// By how much it lies askew to the way of the tip, rad.
    askew: f64,
    /// How far it leaves that where they are joined and in the middle of each, mm.
    off: f64,
}

/// Joins what is too short to be told with what comes behind it; with what is before it at the end, and where one arc for
/// both would lie less askew to them. Where either would leave the way of the tip it is told as short as it is.
struct Pieces {
    way: Way,
    /// Where the last piece begins, and what the tip does on it.
    last: Option<(Pose, Tip)>,
    /// Where the next piece begins.
    next: Pose,
    /// What the tip did since, and where that ends: too short to be told.
    short: Option<(Pose, Tip)>,
    joining: Joining,
}

impl Pieces {
    /// None yet, with room for so many.
    fn with_room(pieces: usize, start: Pose, joining: Joining) -> Self {
        let way = Way { pieces: Vec::with_capacity(pieces), ..Way::rest(start) };
        Self { way, last: None, next: start, short: None, joining }
    }

    fn push(&mut self, to: Pose, tip: Tip) {
        let mut tip = tip;
        if let Some((end, short)) = self.short.take() {
            let forward = short.joined(tip);
            let backward = self.last.map(|(_, last)| last.joined(short));
            let Joining { askew_max, .. } = self.joining;
            let is_better = |back: &Joined| {
                let is_straighter = forward.askew > askew_max && back.askew < forward.askew;
                if self.is_fair(&forward) {
                    is_straighter && self.is_fair(back)
                } else {
                    is_straighter || self.is_fair(back)
                }
            };
            if self.is_told(end) && !self.is_fair(&forward) && !backward.as_ref().is_some_and(|back| self.is_fair(back))
            {
                self.add(end, short);
            } else if backward.as_ref().is_some_and(is_better) {
                self.join(end, short);
            } else {
                tip = short.and(tip);
            }
        }
        if (to.centre - self.next.centre).norm() < self.joining.length_min {
            self.short = Some((to, tip));
        } else {
            self.add(to, tip);
        }
    }

    /// Whether joining costs so little that a piece need not be told.
    fn is_fair(&self, joined: &Joined) -> bool {
        joined.askew <= self.joining.askew_fair && joined.off <= self.joining.off_fair
    }

    /// Whether a piece from the last one to a pose is long enough to be told.
    fn is_told(&self, to: Pose) -> bool {
        (to.centre - self.next.centre).norm() >= self.joining.length_least
    }

    /// Adds a piece.
    fn add(&mut self, to: Pose, tip: Tip) {
        self.way.pieces.push(Piece::from(self.next, to, tip));
        (self.last, self.next) = (Some((self.next, tip)), to);
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
            let is_fair = self.last.is_none_or(|(_, last)| self.is_fair(&last.joined(tip)));
            if is_fair || !self.is_told(to) { self.join(to, tip) } else { self.add(to, tip) }
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

    /// What joining it with the next one costs.
    fn joined(self, next: Self) -> Joined {
        let both = self.and(next);
        let off = [next.ends[0], self.middle(), next.middle()].map(|place| both.off(place));
        Joined { askew: both.askew(), off: off.into_iter().fold(0.0, f64::max) }
    }

    /// The place in its middle.
    fn middle(&self) -> Point {
        let chord = self.ends[1] - self.ends[0];
        self.ends[0] + chord * 0.5 - left(chord) * (self.turn / 8.0)
    }

    /// By how much one arc from its start to its end lies askew to it at both, rad: none when it is that arc.
    fn askew(&self) -> f64 {
        let chord = self.ends[1] - self.ends[0];
        angle::wrap(angle::turn(self.along, chord) - 0.5 * self.turn).abs()
    }

    /// How far a place on it lies beside one arc from its start to its end that turns as it does, mm.
    fn off(&self, place: Point) -> f64 {
        let [start, end] = self.ends;
        let chord = end - start;
        let width = chord.norm();
        let away = place - start;
        if width <= LENGTH_EPSILON {
            return away.norm();
        }
        // A parabola of that turn: its middle lies beside the chord by an eighth of the turn.
        let share = away.dot(&chord) / (width * width);
        let bow = -0.5 * self.turn * share * (1.0 - share) * width;
        (cross(chord, away) / width - bow).abs()
    }
}

impl Way {
    /// That of a plunge without motion.
    pub(super) fn rest(start: Pose) -> Self {
        Self { start, pieces: Vec::new(), radius: 0.0, yaw: 0.0, bow: 0.0 }
    }

    /// The same with C corrected by an angle, rad.
    #[must_use]
    pub(super) fn turned(mut self, by: f64) -> Self {
        for pose in std::iter::once(&mut self.start).chain(self.pieces.iter_mut().map(|piece| &mut piece.to)) {
            pose.c.0 += by;
        }
        self.yaw += by;
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
    let tube = Tube::new(points, tolerance, (seam, &job.profile));
    let start = if ring { at_seam(run) } else { tube.direction(0) };
    let end = if ring && run.front == 0.0 { start } else { tube.direction(tube.chords() - 1) };
    let stops = (1..chords.len()).filter(|&k| run.feeds[chords[k - 1]] != run.feeds[chords[k]]).collect();
    let ends = Ends { start, end, stops, curvature: f64::INFINITY, spares: false, reach: 0.0 };
    let gentle = |&reach: &f64| fit(&tube, &Ends { curvature: GENTLE, reach, ..ends.clone() }).ok();
    let gentle = if keys.arcs { None } else { GENTLE_REACHES.iter().find_map(gentle) };
    let arcs = gentle.map_or_else(|| fit(&tube, &ends), Ok);
    let arcs = arcs.or_else(|_| fit(&tube, &Ends { spares: true, ..ends }))?;
    // Plunged as a chord, the blade lags behind its way and fades into it over its width.
    let length: f64 = arcs.iter().map(|arc| arc.length).sum();
    let lead = tail.map_or(0.0, |tail| angle::turn(tube.points[0] - tail, start));
    let first = Heading::new(start.y.atan2(start.x) - lead);
    let radius = run.edge.lead(knife.ends());
    let pose = |tip: Point, c: f64| Pose { centre: tip - Rotation(c).unit() * radius, c: Rotation(c) };
    let c = Rotation(run.start.c.0 - run.edge.turn()).nearest(first).0;
    let at = pose(tube.points[0], c);
    let permitted = if keys.arcs { TURN_SHARE } else { LINE_SHARE } * job.profile.blade_tolerance();
    let joining = Joining {
        length_min: STEPS_MIN * keys.step(),
        length_least: STEPS_LEAST * keys.step(),
        askew_max: ASKEW_SHARE * permitted,
        askew_fair: FAIR_SHARE * rad(job.profile.verify.max_heading_deg),
        off_fair: OFF_SHARE * tolerance,
    };
    let mut pieces = Pieces::with_room(arcs.len(), at, joining);
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
    Ok(Way { radius, bow: keys.chord_mm.min(BOW_SHARE * tolerance), ..pieces.finish() })
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
            let joining =
                Joining { length_min: 0.04, length_least: 0.005, askew_max: 0.002, askew_fair: 0.1, off_fair: 0.01 };
            let mut pieces = Pieces::with_room(3, Pose::default(), joining);
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
