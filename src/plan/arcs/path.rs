//! The path of a run: arcs of the tip inside the tolerance band, and the corresponding pieces of the C axis.

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

/// Fraction of the permitted angle that C may deviate while it turns uniformly along arcs; the rest covers decimals.
const TURN_SHARE: f64 = 0.9;
/// Fraction of the permitted angle where lines approximate arcs, which adds an error of the same size.
const LINE_SHARE: f64 = 0.45;
/// Fraction of that angle available for merging a piece that is too short to be written.
const ASKEW_SHARE: f64 = 0.25;
/// Fraction of the tolerance by which chords may leave the arc that they approximate, in addition to the share of the fit.
/// Coordinates of a file are rounded by nearly as much; in a narrower band the curves would waver.
const CHORD_SHARE: f64 = 0.03;
/// Fraction of the verified angle available for merging a piece that could be written by itself.
const FAIR_SHARE: f64 = 0.4;
/// Fraction of the tolerance available for merging a piece that is too short to be written.
const OFF_SHARE: f64 = 0.02;
/// Maximum curvature that straight lines of a few decimals still follow, per mm. On tighter curves rounding turns short lines,
/// and long lines are skewed.
const GENTLE: f64 = 0.4;
/// Half lengths of the secants tried for directions on a gentle path, in tolerances. The first that leads to the end of the run
/// is used.
const GENTLE_REACHES: [f64; 4] = [10.0, 5.0, 20.0, 3.0];
/// Minimum step of a fade, mm. Shorter steps gain no accuracy because places are rounded.
const FADING_MIN: f64 = 0.02;
/// Minimum length of a piece that could be merged with its neighbour, in steps of the last decimal. At this length rounding
/// turns its direction by less than a fifth of a degree.
const STEPS_MIN: f64 = 400.0;
/// Minimum length of any piece, in steps of the last decimal. Rounding would turn a much shorter one into a turn on the spot.
const STEPS_LEAST: f64 = 50.0;

/// The path of a run. Where the next run continues this one, the path passes through its start. The error is the point from
/// which no arc stays inside the tolerance band.
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
    // A blade that plunged as a chord lags behind the tangent and fades into it over its width.
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
        let (mut from, mut start) = (0.0, arc.at(0.0));
        for part in fade.parts(Beside { arc, tangent, done }, FADING_MIN) {
            let (ends, along, length) = ([start, arc.at(part.to)], arc.along_at(from), part.to - from);
            let turn = arc.curvature * length;
            pieces.push(pose(ends[1], part.c), Tip { ends, along, turn, more: part.turn - turn, length, feed });
            (from, start) = (part.to, ends[1]);
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
    /// Unit vector along the first arc at its start, and its start point.
    start: Vector,
    from: Point,
}

/// Fits arcs inside the tolerance band of the tip's line. The error is the point from which none stays inside.
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
    // A ring ends at its own start: the overlap repeats the same path.
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
    // If the reduced bands are all too tight, the run uses its full band, and the verifier measures whether the cuts cross.
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

/// The overlap of a ring: its first arcs repeated over `length` mm. `lap` is the number of chords of the ring, `last` the index
/// of the last chord of the overlap.
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

/// Direction of a ring at its start: that of the circle through its first point and both neighbours.
fn at_seam(run: &Run) -> Vector {
    let n = run.points.len();
    let (to, from) = (run.points[0] - run.points[n - 2], run.points[1] - run.points[0]);
    let (a, b) = (to.norm(), from.norm());
    (to * (b / a) + from * (a / b)).normalize()
}

/// Turn of a ring at its start, rad.
fn seam_turn(run: &Run) -> f64 {
    let n = run.points.len();
    polyline::turn_at(run.points[n - 2], run.points[0], run.points[1])
}
