//! The way of a blade beside a cut: the longest stretch of it along that.

use super::lines::{Foot, Line};
use crate::geom::{Point, polyline};

/// Longest step between places of the blade that are compared with the line, mm; and of the blade as it is plunged.
const STEP: f64 = 0.2;
const PLUNGED_STEP: f64 = 0.05;
/// Most steps between two rows: a jump that takes more is a fault of the axes.
const STEPS_MAX: f64 = 4096.0;
/// How much farther along the line a place may be than along the way of the blade, in steps and mm.
const SLACK: [f64; 2] = [2.0, 1.0];
/// Way beside a line behind which a blade is no more expected on it, mm.
const RETURN: f64 = 60.0;

/// How far along a line a place may be from the one before, when the blade went so far between them, mm.
pub(super) fn reach(way: f64) -> f64 {
    SLACK[0] * way + SLACK[1]
}

/// A place of the blade's leading end.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sample {
    pub(super) point: Point,
    /// The row that it is before, counted from the first of the stroke.
    pub(super) row: usize,
    /// Whether it lies under the plunged blade, between its ends: that is straight, and lies beside a curve.
    pub(super) under: bool,
}

/// Places of the way of a blade, near to each other.
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

/// The way of a blade, and a cut that it may follow.
#[derive(Clone, Copy)]
pub(super) struct Trail<'a> {
    pub(super) samples: &'a [Sample],
    pub(super) line: &'a Line,
    /// How far the blade may be beside it, mm.
    pub(super) tolerance: f64,
}

/// What a stroke cuts of a line.
#[derive(Debug, Clone, Copy)]
pub(super) struct Followed {
    /// The first and the last sample on it.
    pub(super) range: [usize; 2],
    /// Their stations.
    pub(super) stations: [f64; 2],
    /// How far samples between them are from it at the most, mm, and which.
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
    /// The longest stretch of the way along the line.
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
            // A stretch that is most of the stroke needs no other.
            first = if farthest > first { farthest + 1 } else { first + 1 };
        }
        best
    }

    /// Where a point is on the line: each place of it.
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

    /// Follows the line from a sample on, as long as later samples come back to it.
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

    /// The way of the blade before the stretch that follows the line, and behind it, mm.
    pub(super) fn beyond(&self, found: &Followed) -> [f64; 2] {
        let way = |range: &[Sample]| range.windows(2).map(|ends| (ends[1].point - ends[0].point).norm()).sum::<f64>();
        [way(&self.samples[..=found.range[0]]), way(&self.samples[found.range[1]..])]
    }

    /// How far it goes beside the line there at the most, mm, and where: places under the plunged blade do not count.
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
