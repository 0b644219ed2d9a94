//! What the axes do while a run is cut: pieces of the centre's way, each an arc or a line with C linear along it.

use super::fit::{Ends, fit};
use super::tube::Tube;
use crate::geom::fade::left_of;
use crate::geom::{Heading, Point, Rotation, Vector, angle, left, polyline};
use crate::ir::toolpath::{Pose, Run, Shape};
use crate::machine::Job;
use crate::units::rad;

/// Part of the permitted angle by which C may be off where it turns evenly along arcs; the rest is for decimals.
const TURN_SHARE: f64 = 0.9;
/// The same where lines stand for arcs, which are off by as much again.
pub(super) const LINE_SHARE: f64 = 0.45;
/// The most of the tolerance that the bow of a chord may take.
const BOW_SHARE: f64 = 0.5;
/// Greatest second derivative of the step by which the blade fades from chord to tangent, over its length squared.
const FADE_BEND: f64 = 7.6;
/// Shorter ways are none, mm.
const LENGTH_EPSILON: f64 = 1e-3;
/// An arc that turns by less is a line, rad: controllers take those of a millionth for whole turns.
const TURN_MIN: f64 = 2e-5;
/// An arc that bows by less is a line, mm.
const BOW_MIN: f64 = 1e-5;
/// Smaller leads are none, rad.
const LEAD_EPSILON: f64 = 1e-6;
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
        let (width, half) = (chord.norm(), 0.5 * tip.turn);
        let bows = width * half.abs() / 4.0 > BOW_MIN && tip.turn.abs() > TURN_MIN;
        let is_arc = width > LENGTH_EPSILON && bows;
        let (arc, length) = if is_arc {
            let centre = from.centre + chord * 0.5 + left(chord) * (0.5 / half.tan());
            (Some((centre, tip.turn)), width * half / half.sin())
        } else {
            (None, width)
        };
        Self { to, arc, length, speed: tip.feed * length / tip.length }
    }
}

/// A way of the tip.
#[derive(Debug, Clone, Copy)]
struct Tip {
    /// How far it turns, rad.
    turn: f64,
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

/// Joins what is too short to be told with what comes behind it, or at the end with what is before it.
struct Pieces {
    way: Way,
    /// Where the last piece begins, and what the tip does on it.
    last: Option<(Pose, Tip)>,
    /// Where the next piece begins, and what the tip did since.
    next: (Pose, Option<Tip>),
    length_min: f64,
}

impl Pieces {
    fn new(start: Pose, length_min: f64) -> Self {
        Self { way: Way { start, pieces: Vec::new() }, last: None, next: (start, None), length_min }
    }

    fn push(&mut self, to: Pose, tip: Tip) {
        let (from, before) = self.next;
        let tip = before.map_or(tip, |before| before.and(tip));
        if (to.centre - from.centre).norm() < self.length_min {
            self.next.1 = Some(tip);
        } else {
            self.way.pieces.push(Piece::from(from, to, tip));
            (self.last, self.next) = (Some((from, tip)), (to, None));
        }
    }

    fn finish(mut self, to: Pose) -> Way {
        if let (_, Some(tip)) = self.next {
            let (from, tip) = self.last.map_or((self.next.0, tip), |(from, last)| (from, last.and(tip)));
            self.way.pieces.pop();
            self.way.pieces.push(Piece::from(from, to, tip));
        }
        self.way
    }
}

impl Tip {
    fn and(self, next: Self) -> Self {
        Self { turn: self.turn + next.turn, length: self.length + next.length, feed: self.feed.min(next.feed) }
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
    let fade = if lead.abs() > LEAD_EPSILON { knife.width_mm.min(length) } else { 0.0 };
    let first = Heading::new(start.y.atan2(start.x) - lead);
    let radius = run.edge.lead(knife.ends());
    let pose = |tip: Point, c: f64| Pose { centre: tip - Rotation(c).unit() * radius, c: Rotation(c) };
    let mut c = Rotation(run.start.c.0 - run.edge.turn()).nearest(first).0;
    let mut at = pose(tube.points[0], c);
    let mut pieces = Pieces::new(at, STEPS_MIN * keys.step());
    let permitted = if keys.arcs { TURN_SHARE } else { LINE_SHARE } * rad(keys.heading_tolerance_deg);
    let mut tangent = c + lead;
    let (mut done, mut beside) = (0.0, 0);
    for arc in &arcs {
        let feed = chords[beside..=arc.chord].iter().map(|&chord| run.feeds[chord]).fold(f64::INFINITY, f64::min);
        beside = arc.chord + usize::from(arc.stops);
        tangent += angle::turn(Rotation(tangent).unit(), arc.along);
        let mut from = 0.0;
        let (count, part) = parts((fade - done).clamp(0.0, arc.length), [lead, fade], permitted);
        for i in 1..=count + 1 {
            let to = part * i as f64;
            let to = if i > count || arc.length - to < LENGTH_EPSILON { arc.length } else { to };
            if to - from < LENGTH_EPSILON && i > 1 {
                continue;
            }
            let lag = if fade > 0.0 { lead * left_of((done + to) / fade)[0] } else { 0.0 };
            c = tangent + arc.curvature * to - lag;
            at = pose(arc.at(to), c);
            pieces.push(at, Tip { turn: arc.curvature * (to - from), length: to - from, feed });
            from = to;
        }
        tangent += arc.turn();
        done += arc.length;
    }
    Ok(pieces.finish(at))
}

/// How many parts of what length the blade fades on, so that C may turn evenly along each.
fn parts(fading: f64, [lead, fade]: [f64; 2], permitted: f64) -> (usize, f64) {
    if fading < LENGTH_EPSILON {
        return (0, 0.0);
    }
    let longest = fade * (8.0 * permitted / (FADE_BEND * lead.abs())).sqrt();
    let count = (fading / longest).ceil().max(1.0);
    (count as usize, fading / count)
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
