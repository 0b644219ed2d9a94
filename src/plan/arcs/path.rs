//! The path of a run: arcs of the tip inside the tolerance band, and beside each the pieces of the C axis.

use super::band::ToleranceBand;
use super::fade::{Beside, Fade};
use super::fit::{Arc, Ends, Stop, fit};
use super::pieces::{Joining, Pieces, Tip};
use super::stroke::Stroke;
use super::tip::{LENGTH_EPSILON, TipLine};
use crate::geom::{Heading, Point, Rotation, Vector, angle, polyline};
use crate::ir::arcs::{Deviation, Interpolation, Path};
use crate::ir::toolpath::{Pose, Run, Shape};
use crate::machine::Job;
use crate::plan::spline::JUNCTION_SHARES;
use crate::units::rad;

/// Part of the permitted angle by which C may be off where it turns evenly along arcs; the rest is for decimals.
const TURN_SHARE: f64 = 0.9;
/// The same where lines stand for arcs, which are off by as much again.
const LINE_SHARE: f64 = 0.45;
/// The part of that which joining a piece too short to be told may take.
const ASKEW_SHARE: f64 = 0.25;
/// Part of the tolerance that chords which stand for an arc may leave it by, beside what the fit may use: numbers of a file
/// are rounded by nearly as much as that, and in a narrower band its curves would waver.
const CHORD_SHARE: f64 = 0.03;
/// Part of the angle that a blade is judged by that joining a piece may take where it could be told by itself.
const FAIR_SHARE: f64 = 0.4;
/// Part of the tolerance that joining a piece too short to be told may take.
const OFF_SHARE: f64 = 0.02;
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

/// The path of a run that comes by the start of the next one, where that goes on along it; otherwise the point from which no
/// arc stays inside the tolerance band.
pub(super) fn path(stroke: &Stroke, tolerance: f64, interpolation: &Interpolation, job: &Job) -> Result<Path, Point> {
    let run = stroke.run;
    let knife = &job.profile.knife;
    let Interpolation { circular, step, chord_tolerance, heading_tolerance } = *interpolation;
    let line = TipLine::new(run, knife.width_mm).without_bend_at_start([STEPS_LEAST * step, OFF_SHARE * tolerance]);
    let line = match stroke.next {
        Some(next) => line.by_way_of(next),
        None => line,
    };
    let TipArcs { arcs, start, from } = tip_arcs(stroke, &line, tolerance, interpolation, job)?;
    let TipLine { chords, heel, .. } = line;
    // Plunged as a chord, the blade lags behind its way and fades into it over its width.
    let length: f64 = arcs.iter().map(|arc| arc.length).sum();
    let lead = heel.map_or(0.0, |heel| angle::turn(from - heel, start));
    let first = Heading::new(start.y.atan2(start.x) - lead);
    let radius = run.edge.lead(knife.ends());
    let pose = |tip: Point, c: f64| Pose { centre: tip - Rotation(c).unit() * radius, c: Rotation(c) };
    let c = Rotation(run.start.c.0 - run.edge.turn()).nearest(first).0;
    let permitted = if circular { TURN_SHARE } else { LINE_SHARE } * heading_tolerance;
    let joining = Joining {
        length_min: STEPS_MIN * step,
        length_least: STEPS_LEAST * step,
        askew_max: ASKEW_SHARE * permitted,
        askew_fair: FAIR_SHARE * rad(job.profile.verify.max_heading_deg),
        off_fair: OFF_SHARE * tolerance,
    };
    let mut pieces = Pieces::with_room(arcs.len(), pose(from, c), joining);
    let fade = Fade::new(lead, [knife.width_mm, length], radius, permitted);
    let mut tangent = c + lead;
    let (mut done, mut beside) = (0.0, 0);
    for arc in &arcs {
        let feeds = chords[beside..=arc.chord].iter().map(|&chord| run.feeds[chord]);
        let feed = feeds.fold(f64::INFINITY, f64::min);
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
    let chord =
        Deviation { distance: chord_tolerance.min(CHORD_SHARE * tolerance), angle: LINE_SHARE * heading_tolerance };
    Ok(Path { radius, chord, ..pieces.finish() })
}

/// The arcs of the tip along a run.
struct TipArcs {
    arcs: Vec<Arc>,
    /// Unit vector along the first one where it starts, and that place.
    start: Vector,
    from: Point,
}

/// Arcs inside the tolerance band of the line of the tip; otherwise the point from which none stays inside.
fn tip_arcs(
    stroke: &Stroke,
    line: &TipLine,
    tolerance: f64,
    interpolation: &Interpolation,
    job: &Job,
) -> Result<TipArcs, Point> {
    let run = stroke.run;
    let lap = run.points.len() - 1;
    let ring = run.shape == Shape::Ring;
    let turn = if ring { seam_turn(run) } else { 0.0 };
    // A ring ends on its own start: what goes on over that is the same way again.
    let (points, chords) =
        if ring { (&line.points[..=lap], &line.chords[..lap]) } else { (&line.points[..], &line.chords[..]) };
    let is_junction = |&chord: &usize| run.junctions.get(chord) == Some(&true);
    let plain = ToleranceBand::new(points.to_vec(), tolerance, [turn; 2], &job.profile);
    let is_overlap = |chord: usize| chord + 1 == chords.len();
    let is_shared = stroke.share < 1.0 && run.front > 0.0;
    let shared = is_shared.then(|| plain.clone().with_junctions((0..chords.len()).map(is_overlap), stroke.share));
    let band = shared.as_ref().unwrap_or(&plain);
    let mut shares = JUNCTION_SHARES.iter().filter(|_| chords.iter().any(&is_junction));
    let start = if ring { at_seam(run) } else { band.direction(0) };
    let end = if ring { start } else { band.direction(band.chords() - 1) };
    let changes = |k: usize| run.feeds[chords[k - 1]] != run.feeds[chords[k]];
    let along = |k: usize| line.meets.filter(|&(vertex, _)| vertex == k).map(|(_, along)| along);
    let stop = |k: usize| (changes(k) || along(k).is_some()).then(|| Stop { vertex: k, along: along(k) });
    let stops = (1..chords.len()).filter_map(stop).collect();
    let ends = Ends { start, end, stops, curvature: f64::INFINITY, spares: false, reach: 0.0 };
    let fitted = |band: &ToleranceBand| {
        let gentle = |&reach: &f64| fit(band, &Ends { curvature: GENTLE, reach, ..ends.clone() }).ok();
        let gentle = if interpolation.circular { None } else { GENTLE_REACHES.iter().find_map(gentle) };
        let arcs = gentle.map_or_else(|| fit(band, &ends), Ok);
        arcs.or_else(|_| fit(band, &Ends { spares: true, ..ends.clone() }))
    };
    let nearer = |&share: &f64| fitted(&band.clone().with_junctions(chords.iter().map(is_junction), share)).ok();
    // Where all that is too tight the run keeps to its band, and the verifier measures whether the cuts cross.
    let mut arcs = shares.find_map(nearer).map_or_else(|| fitted(band), Ok).or_else(|_| fitted(&plain))?;
    if ring {
        // The feed may change at the seam.
        if let Some(closing) = arcs.last_mut() {
            closing.stops |= run.front > 0.0 && run.feeds[0] != run.feeds[lap - 1];
        }
        arcs.extend(again(&arcs, run.front, [lap, line.chords.len() - 1]));
    }
    Ok(TipArcs { arcs, start, from: band.points[0] })
}

/// The overlap of a ring: its first arcs repeated over `length` mm. `lap` is its number of chords, `last` the last chord of the
/// overlap.
fn again(arcs: &[Arc], length: f64, [lap, last]: [usize; 2]) -> Vec<Arc> {
    let (mut left, mut found) = (length, Vec::new());
    for arc in arcs {
        if left <= LENGTH_EPSILON {
            break;
        }
        let length = arc.length.min(left);
        let stops = arc.stops && length == arc.length;
        found.push(Arc { length, stops, chord: (arc.chord + lap).min(last), ..*arc });
        left -= length;
    }
    found
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
