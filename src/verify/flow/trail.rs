//! Path of a blade along a cut: its longest stretch on the line.

use super::lines::{Foot, Line};
use crate::geom::{Point, polyline};

/// Longest step between the places of the path that are compared with the line, mm; and between those of the plunged blade.
const STEP: f64 = 0.2;
const PLUNGED_STEP: f64 = 0.05;
/// Maximum number of steps between two rows: a jump that needs more is a fault of the axes.
const STEPS_MAX: f64 = 4096.0;
/// Greatest advance along the line per step: a factor on the length of the step, and an addition, mm.
const SLACK: [f64; 2] = [2.0, 1.0];
/// Path length beside a line after which a blade is no longer expected to return to it, mm.
const RETURN: f64 = 60.0;

/// Greatest advance along a line for a path of length `way`, mm.
pub(super) fn reach(way: f64) -> f64 {
    SLACK[0] * way + SLACK[1]
}

/// Place of the blade's leading end.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sample {
    pub(super) point: Point,
    /// Index of the row at the place or next after it, from the first row of the stroke.
    pub(super) row: usize,
    /// True for a place under the plunged blade, between its ends: the blade is straight and may lie beside a curve.
    pub(super) under: bool,
}

/// Closely spaced places along the path of a blade.
pub(super) fn samples(trace: &[Point]) -> Vec<Sample> {
    let mut samples = vec![Sample { point: trace[0], row: 0, under: false }];
    for (row, ends) in trace.windows(2).enumerate() {
        let way = ends[1] - ends[0];
        if way.norm() == 0.0 {
            continue;
        }
        let step = if row == 0 { PLUNGED_STEP } else { STEP };
        let parts = (way.norm() / step).ceil().clamp(1.0, STEPS_MAX);
        let under = |i: u32| row == 0 && f64::from(i) < parts;
        let part = |i: u32| Sample { point: ends[0] + way * (f64::from(i) / parts), row, under: under(i) };
        samples.extend((1..=parts as u32).map(part));
    }
    samples
}

/// Path of a blade, and a cut that it may follow.
#[derive(Clone, Copy)]
pub(super) struct Trail<'a> {
    pub(super) samples: &'a [Sample],
    pub(super) line: &'a Line,
    /// Greatest permitted distance of the blade from the line, mm.
    pub(super) tolerance: f64,
}

/// Stretch of a line that a stroke follows.
#[derive(Debug, Clone, Copy)]
pub(super) struct Followed {
    /// First and last sample on the line.
    pub(super) range: [usize; 2],
    /// Stations of these samples, mm.
    pub(super) stations: [f64; 2],
    /// Greatest distance of the samples in between from the line, mm, and the index of that sample.
    pub(super) deviation: f64,
    pub(super) worst: usize,
}

impl Followed {
    pub(super) fn length(&self) -> f64 {
        (self.stations[1] - self.stations[0]).abs()
    }

    pub(super) fn span(&self) -> [f64; 2] {
        let [a, b] = self.stations;
        [a.min(b), a.max(b)]
    }
}

impl Trail<'_> {
    /// Longest stretch of the path along the line; `None` if it never is on it.
    pub(super) fn followed(&self) -> Option<Followed> {
        let mut best: Option<Followed> = None;
        let mut first = 0;
        while first < self.samples.len() {
            let mut farthest = first;
            for station in self.starts(self.samples[first].point) {
                let found = self.track(first, station);
                farthest = farthest.max(found.range[1]);
                if best.as_ref().is_none_or(|best| found.length() > best.length()) {
                    best = Some(found);
                }
            }
            // After a stretch that is most of the stroke, no other is needed.
            first = if farthest > first { farthest + 1 } else { first + 1 };
        }
        best
    }

    /// Stations of all places of the line that are near a point.
    fn starts(&self, point: Point) -> Vec<f64> {
        let line = self.line;
        let mut found: Vec<f64> = Vec::new();
        for segment in 0..line.points.len() - 1 {
            let (a, b) = (line.points[segment], line.points[segment + 1]);
            if polyline::distance_to_segment(point, a, b) <= self.tolerance {
                let share = polyline::foot(point, a, b);
                let station = line.stations[segment] + share * (line.stations[segment + 1] - line.stations[segment]);
                if found.last().is_none_or(|last| (last - station).abs() > STEP) {
                    found.push(station);
                }
            }
        }
        found
    }

    /// Follows the line from a sample for as long as later samples return to it.
    fn track(&self, first: usize, station: f64) -> Followed {
        let samples = self.samples;
        let mut found = Followed { range: [first; 2], stations: [station; 2], deviation: 0.0, worst: first };
        let mut aside: Option<(f64, usize)> = None;
        let mut step = 0.0;
        for i in first..samples.len() {
            if i > first {
                step += (samples[i].point - samples[i - 1].point).norm();
            }
            let Foot { station, distance } = self.line.foot_near(samples[i].point, found.stations[1], reach(step));
            if distance > self.tolerance {
                if samples[i].under {
                    continue;
                }
                if aside.is_none_or(|(worst, _)| distance > worst) {
                    aside = Some((distance, i));
                }
                // After that length beside the line the path does not return.
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

    /// Path length of the blade before and behind the stretch that follows the line, mm.
    pub(super) fn beyond(&self, found: &Followed) -> [f64; 2] {
        let way = |range: &[Sample]| range.windows(2).map(|ends| (ends[1].point - ends[0].point).norm()).sum::<f64>();
        [way(&self.samples[..=found.range[0]]), way(&self.samples[found.range[1]..])]
    }

    /// Greatest distance from the line before and behind the stretch, mm, and the sample there; places under the plunged blade
    /// do not count.
    pub(super) fn aside(&self, found: &Followed) -> [Option<(f64, usize)>; 2] {
        let [first, last] = found.range;
        let farthest = |range: std::ops::Range<usize>, station: f64| {
            let mut way = 0.0;
            let off = |i: usize| {
                way += (self.samples[i].point - self.samples[i.saturating_sub(1)].point).norm();
                (self.line.foot_near(self.samples[i].point, station, reach(way)).distance, i)
            };
            let moving = range.filter(|&i| self.samples[i].row > 0 && !self.samples[i].under);
            moving.map(off).max_by(|a, b| a.0.total_cmp(&b.0))
        };
        [farthest(0..first, found.stations[0]), farthest(last + 1..self.samples.len(), found.stations[1])]
    }
}
