//! What the axes do while a run is cut: pieces of the centre's way, each an arc or a line with C linear along it.

use super::fit::{Arc, Ends, fit};
use super::tube::Tube;
use crate::geom::{Heading, Point, Rotation, Vector, angle, polyline};
use crate::ir::toolpath::{Pose, Run, Shape};
use crate::machine::Job;

/// A piece of the centre's way.
#[derive(Debug, Clone, Copy)]
pub(super) struct Piece {
    /// Where it ends.
    pub(super) to: Pose,
    /// The centre of its arc and how far it turns, rad; `None` = straight.
    pub(super) arc: Option<(Point, f64)>,
    /// Way of the centre, mm.
    pub(super) length: f64,
    /// Greatest speed of the tip, mm/s.
    pub(super) feed: f64,
}

/// The way of a run.
#[derive(Debug)]
pub(super) struct Way {
    /// Where the axes plunge.
    pub(super) start: Pose,
    pub(super) pieces: Vec<Piece>,
}

/// Part of the tolerance by which a straight piece may stand for a curved one.
const CHORD_SHARE: f64 = 0.03;
/// Part of the permitted angle that a straight piece of C may be off.
const TURN_SHARE: f64 = 0.3;
/// Greatest second derivative of the step by which the blade fades from chord to tangent, over its length squared.
const FADE_BEND: f64 = 7.6;
/// Shorter pieces vanish in the decimals, mm.
const LENGTH_MIN: f64 = 1e-3;
/// Smaller leads are none, rad.
const LEAD_EPSILON: f64 = 1e-6;

/// The way of a run; otherwise the point at which no arc stays in the tube.
pub(super) fn way(run: &Run, tolerance: f64, job: &Job) -> Result<Way, Point> {
    let knife = &job.profile.knife;
    let (points, chords, tail) = tip_line(run, knife.width_mm);
    let ring = run.shape == Shape::Ring;
    let turn = if ring { seam_turn(run) } else { 0.0 };
    let seam = [turn, if run.front == 0.0 { turn } else { 0.0 }];
    let tube = Tube::new(points, tolerance, (seam, &job.profile));
    let last = tube.chords() - 1;
    let start = if ring { at_seam(run) } else { tube.direction(0) };
    let end = if ring && run.front == 0.0 { start } else { tube.direction(last) };
    let arcs = fit(&tube, Ends { start, end })?;
    // Plunged as a chord, the blade lags behind its way and fades into it over its width.
    let length: f64 = arcs.iter().map(|arc| arc.length).sum();
    let lead = tail.map_or(0.0, |tail| angle::turn(tube.points[0] - tail, start));
    let fade = if lead.abs() > LEAD_EPSILON { knife.width_mm.min(length) } else { 0.0 };
    let first = Heading::new(start.y.atan2(start.x) - lead);
    let radius = knife.radius();
    let pose = |tip: Point, c: f64| Pose { centre: tip - Rotation(c).unit() * radius, c: Rotation(c) };
    let mut c = run.start.c.nearest(first).0;
    let mut way = Way { start: pose(tube.points[0], c), pieces: Vec::with_capacity(arcs.len()) };
    let mut tangent = c + lead;
    let (mut done, mut beside) = (0.0, 0);
    for arc in &arcs {
        let feed = chords[beside..=arc.chord].iter().map(|&chord| run.feeds[chord]).fold(f64::INFINITY, f64::min);
        beside = arc.chord;
        tangent += angle::wrap(angle::turn(Rotation(tangent).unit(), arc.along));
        let parts = parts(arc, (fade - done).max(0.0).min(arc.length), [lead, fade], job, tolerance);
        let mut from = 0.0;
        for part in parts {
            let to = from + part;
            let lag = if fade > 0.0 { lead * left_of((done + to) / fade) } else { 0.0 };
            let before = pose(arc.at(from), c);
            c = tangent + arc.curvature * to - lag;
            let after = pose(arc.at(to), c);
            let turn = arc.curvature * part;
            let is_arc = done + from >= fade && arc.curvature != 0.0 && part > LENGTH_MIN;
            let centre = arc.from + crate::geom::left(arc.along) / arc.curvature;
            let chord = (after.centre - before.centre).norm();
            way.pieces.push(Piece {
                to: after,
                arc: is_arc.then_some((centre, turn)),
                length: if is_arc { turn.abs() * (before.centre - centre).norm() } else { chord },
                feed,
            });
            from = to;
        }
        tangent += arc.turn();
        done += arc.length;
    }
    Ok(way)
}

/// The lengths into which an arc is cut: short ones while the blade fades, so that straight pieces serve.
fn parts(arc: &Arc, fading: f64, [lead, fade]: [f64; 2], job: &Job, tolerance: f64) -> Vec<f64> {
    if fading <= LENGTH_MIN {
        return vec![arc.length];
    }
    let permitted = TURN_SHARE * crate::units::rad(job.profile.gcode.heading_tolerance_deg);
    let by_turn = fade * (8.0 * permitted / (FADE_BEND * lead.abs())).sqrt();
    let by_bow =
        if arc.curvature == 0.0 { f64::INFINITY } else { (8.0 * CHORD_SHARE * tolerance / arc.curvature.abs()).sqrt() };
    let count = (fading / by_turn.min(by_bow)).ceil().max(1.0) as usize;
    let mut parts = vec![fading / count as f64; count];
    if arc.length - fading > LENGTH_MIN {
        parts.push(arc.length - fading);
    } else {
        parts[count - 1] += arc.length - fading;
    }
    parts
}

/// What is left of the lead at a part of the fade: 1 less the step of degree 7.
fn left_of(x: f64) -> f64 {
    let x = x.min(1.0);
    let x4 = x * x * x * x;
    1.0 - x4 * (35.0 - x * (84.0 - x * (70.0 - x * 20.0)))
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
            while left > LENGTH_MIN {
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
                if (point - points[points.len() - 1]).norm() > LENGTH_MIN {
                    points.push(point);
                    chords.push(chord_of(i - 1));
                }
            }
            if points.len() < 2 {
                // The tip stands at its end already: a way too short to be told from none.
                let along = polyline::direction(extended[last - 1], extended[last]).unwrap_or(Vector::new(1.0, 0.0));
                points.push(tip + along * LENGTH_MIN);
                chords.push(chord_of(last - 1));
            }
            (points, chords, Some(tail))
        }
    }
}
