//! Which cut a stroke follows, from where to where: told from its way over the cloth alone.

use super::cover::{Cover, Covers};
use super::ground::Ground;
use super::heading;
use super::lines::{Foot, Line, Lines};
use super::rules::Rule;
use super::strokes::Stroke;
use super::worst::Worst;
use crate::geom::{Point, cross, polyline};

/// Places of a stroke that are compared with all cuts, at the most.
const PROBES: usize = 48;
/// Longest step between places of the blade that are compared with the line, mm; and of the blade as it is plunged.
const STEP: f64 = 0.2;
const PLUNGED_STEP: f64 = 0.05;
/// How much farther along the line a place may be than along the way of the blade, in steps and mm.
const SLACK: [f64; 2] = [2.0, 1.0];
/// A cut and a stroke whose directions differ by more, as a sine, do not follow each other.
const SINE: f64 = 0.5;

/// Judges a stroke: finds its cut, and what of it is cut.
pub(super) fn judge(stroke: &Stroke, lines: &Lines, ground: &Ground, covers: &mut Covers, worst: &mut Worst) {
    let tolerance = ground.tolerance();
    let samples = samples(&stroke.trace);
    let length = polyline::length(&stroke.trace);
    let at = |sample: &Sample| stroke.places[sample.row.min(stroke.places.len() - 1)];
    let all: Vec<(Followed, usize)> = candidates(&samples, lines, tolerance)
        .into_iter()
        .filter_map(|line| Some((followed(&samples, &lines.all[line], tolerance)?, line)))
        .collect();
    let way = |range: &[Sample]| range.windows(2).map(|ends| (ends[1].point - ends[0].point).norm()).sum::<f64>();
    let beyond = |found: &Followed| [way(&samples[..=found.range[0]]), way(&samples[found.range[1]..])];
    let farthest = farthest(stroke, ground);
    let rank = |(found, line): &(Followed, usize)| {
        let [before, behind] = beyond(found);
        // What breaks no rule on a line is of none on which it breaks one.
        let excess = (before.max(behind) - farthest).max(0.0) + (found.deviation - tolerance).max(0.0);
        (excess, !names(stroke, &lines.all[*line]), covers.doubled(*line, found.span()), -found.length())
    };
    let best = all.iter().min_by(|a, b| {
        let (a, b) = (rank(a), rank(b));
        a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)).then(a.2.total_cmp(&b.2)).then(a.3.total_cmp(&b.3))
    });
    let Some(&(found, line)) = best else {
        worst.see(Rule::Stray, length, 0.0, Some(stroke.places[0]));
        return;
    };
    worst.see(Rule::Stray, 0.0, 0.0, None);
    heading::judge(stroke, &under(stroke, &found, &samples, &lines.all[line]), ground, worst);
    worst.see(Rule::Deviation, found.deviation, tolerance, Some(at(&samples[found.worst])));
    for (beyond, sample) in beyond(&found).into_iter().zip(found.range) {
        worst.see(Rule::Overcut, beyond, farthest, Some(at(&samples[sample])));
    }
    let is_named = names(stroke, &lines.all[line]);
    worst.count(Rule::Block, usize::from(!is_named), Some(stroke.places[0]));
    let place = stroke.places[0];
    covers.add(line, Cover { span: found.span(), head: place.head, plunge: stroke.is_plunge(), place });
}

/// The way that lies under the blade as it is plunged: the line, as far as it is under it, where the blade is none.
fn under(stroke: &Stroke, found: &Followed, samples: &[Sample], line: &Line) -> Vec<Point> {
    let first = found.range[0];
    let mut way = vec![stroke.trace[0]];
    if samples[first].row == 0 {
        let width = (stroke.trace[1] - stroke.trace[0]).norm();
        let to = line.foot_near(stroke.trace[1], found.stations[0], SLACK[0] * width + SLACK[1]).station;
        way.extend(line.between([found.stations[0], to]));
    }
    way
}

/// How far a stroke may go beyond the line that it cuts, mm.
fn farthest(stroke: &Stroke, ground: &Ground) -> f64 {
    let knife = &ground.profile.knife;
    let overlaps = [
        knife.heel_overlap_mm,
        knife.corner_heel_overlap_mm,
        knife.reflex_heel_overlap_mm,
        knife.front_overlap_mm,
        knife.corner_front_overlap_mm,
        knife.reflex_front_overlap_mm,
    ];
    let surplus = if stroke.is_plunge() { knife.width_mm } else { 0.0 };
    overlaps.into_iter().fold(0.0, f64::max) + surplus + OVERCUT
}

/// Whether all rows of a stroke name a block of a line.
fn names(stroke: &Stroke, line: &Line) -> bool {
    stroke.blocks.iter().all(|block| line.blocks.binary_search(block).is_ok())
}

/// How much farther than an overlap a blade may go beyond a line, mm: where it leaves it is known no better.
const OVERCUT: f64 = 1.0;

/// A place of the blade's leading end.
#[derive(Debug, Clone, Copy)]
struct Sample {
    point: Point,
    /// The row that it is before, counted from the first of the stroke.
    row: usize,
    /// Whether it lies under the plunged blade, between its ends: that is straight, and lies beside a curve.
    under: bool,
}

fn samples(trace: &[Point]) -> Vec<Sample> {
    let mut samples = vec![Sample { point: trace[0], row: 0, under: false }];
    for (row, ends) in trace.windows(2).enumerate() {
        let way = ends[1] - ends[0];
        let step = if row == 0 { PLUNGED_STEP } else { STEP };
        let parts = (way.norm() / step).ceil().max(1.0);
        if way.norm() == 0.0 {
            continue;
        }
        let under = |i: u32| row == 0 && f64::from(i) < parts;
        let part = |i: u32| Sample { point: ends[0] + way * (f64::from(i) / parts), row, under: under(i) };
        samples.extend((1..=parts as u32).map(part));
    }
    samples
}

/// The cuts along which a stroke goes somewhere.
fn candidates(samples: &[Sample], lines: &Lines, tolerance: f64) -> Vec<usize> {
    let every = (samples.len() / PROBES).max(1);
    let mut found = Vec::new();
    for i in (0..samples.len()).step_by(every) {
        let here = samples[i].point;
        let other = if i + 1 < samples.len() { samples[i + 1].point } else { samples[i.saturating_sub(1)].point };
        let Some(along) = polyline::direction(here, other) else { continue };
        let is_along =
            |line: usize, k: usize| lines.all[line].along(k).is_some_and(|way| cross(way, along).abs() < SINE);
        found.extend(lines.near(here, tolerance).filter(|near| is_along(near.0, near.1)).map(|near| near.0));
    }
    found.sort_unstable();
    found.dedup();
    found
}

/// What a stroke cuts of a line.
#[derive(Debug, Clone, Copy)]
struct Followed {
    /// The first and the last sample on it.
    range: [usize; 2],
    /// Their stations.
    stations: [f64; 2],
    /// How far samples between them are from it at the most, mm, and which.
    deviation: f64,
    worst: usize,
}

impl Followed {
    fn length(&self) -> f64 {
        (self.stations[1] - self.stations[0]).abs()
    }

    fn span(&self) -> [f64; 2] {
        let [a, b] = self.stations;
        [a.min(b), a.max(b)]
    }
}

/// The longest stretch of a stroke along a line.
fn followed(samples: &[Sample], line: &Line, tolerance: f64) -> Option<Followed> {
    let mut best: Option<Followed> = None;
    let mut first = 0;
    while first < samples.len() {
        let starts = starts(samples[first].point, line, tolerance);
        let mut farthest = first;
        for station in starts {
            let found = track(samples, first, station, line, tolerance);
            farthest = farthest.max(found.range[1]);
            if best.as_ref().is_none_or(|best| found.length() > best.length()) {
                best = Some(found);
            }
        }
        // A stretch that is most of the stroke needs no other.
        first = if farthest > first { farthest + 1 } else { first + 1 };
    }
    best
}

/// Where a point is on a line: each place of it.
fn starts(point: Point, line: &Line, tolerance: f64) -> Vec<f64> {
    let mut found: Vec<f64> = Vec::new();
    for segment in 0..line.points.len() - 1 {
        let (a, b) = (line.points[segment], line.points[segment + 1]);
        if polyline::distance_to_segment(point, a, b) <= tolerance {
            let share = polyline::foot(point, a, b);
            let station = line.stations[segment] + share * (line.stations[segment + 1] - line.stations[segment]);
            if found.last().is_none_or(|last| (last - station).abs() > STEP) {
                found.push(station);
            }
        }
    }
    found
}

/// Follows a line from a sample on, as long as later samples come back to it.
fn track(samples: &[Sample], first: usize, station: f64, line: &Line, tolerance: f64) -> Followed {
    let mut found = Followed { range: [first; 2], stations: [station; 2], deviation: 0.0, worst: first };
    let mut aside: Option<(f64, usize)> = None;
    let mut step = 0.0;
    for i in first..samples.len() {
        if i > first {
            step += (samples[i].point - samples[i - 1].point).norm();
        }
        let Foot { station, distance } =
            line.foot_near(samples[i].point, found.stations[1], SLACK[0] * step + SLACK[1]);
        if distance > tolerance {
            if samples[i].under {
                continue;
            }
            if aside.is_none_or(|(worst, _)| distance > worst) {
                aside = Some((distance, i));
            }
            // What has left the line by so much does not come back.
            if step > RETURN {
                break;
            }
            continue;
        }
        if let Some((worst, at)) = aside.take()
            && worst > found.deviation
        {
            (found.deviation, found.worst) = (worst, at);
        }
        if distance > found.deviation && !samples[i].under {
            (found.deviation, found.worst) = (distance, i);
        }
        (found.range[1], found.stations[1], step) = (i, station, 0.0);
    }
    found
}

/// Way beside a line behind which a blade is no more expected on it, mm.
const RETURN: f64 = 60.0;
