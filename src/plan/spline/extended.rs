//! The polyline followed by the tip and, during the plunge, by the heel: a run with its overlaps.

use super::lap::Lap;
use crate::geom::{Point, polyline};
use crate::ir::motion::Spell;
use crate::ir::toolpath::{OrientationMode, Run, Shape};

/// A run with its overlaps.
#[derive(Debug)]
pub(in crate::plan) struct Extended {
    pub(in crate::plan) points: Vec<Point>,
    /// Source block of each chord.
    pub(in crate::plan) blocks: Vec<u32>,
    /// Speed cap of the tip on each chord, mm/s.
    pub(in crate::plan) feeds: Vec<f64>,
    /// True for each chord near which the run crosses cuts of other parts; empty = none.
    pub(in crate::plan) junctions: Vec<bool>,
    /// Station of the start of the run proper, mm.
    pub(in crate::plan) start: f64,
    /// Station where the tip is lifted, mm.
    pub(in crate::plan) end: f64,
}

impl Extended {
    /// The run with its overlaps, as one polyline; `width` is that of the blade, mm. A ring is extended along itself by at
    /// least `lead` mm before its start and after its end.
    pub(in crate::plan) fn new(run: &Run, width: f64, lead: f64) -> Self {
        match (run.shape, run.orientation) {
            (Shape::Open, _) => open(run),
            (Shape::Ring, OrientationMode::Tangent) => ring(run, [lead, lead]),
            (Shape::Ring, OrientationMode::Chord) => ring(run, [lead + HEEL_REACH * width, lead]),
        }
    }

    /// The lap of a ring; `None` for an open run.
    pub(in crate::plan) fn lap(&self, run: &Run) -> Option<Lap> {
        Lap::of(run, self.start, self.end + SEAM)
    }

    /// The vertices, each with its station, mm.
    pub(in crate::plan) fn stations(&self) -> impl Iterator<Item = (Point, f64)> + '_ {
        let mut station = 0.0;
        self.points.iter().enumerate().map(move |(i, &point)| {
            station += if i > 0 { (point - self.points[i - 1]).norm() } else { 0.0 };
            (point, station)
        })
    }
}

/// An open run. Overlaps continue straight along the end chords.
fn open(run: &Run) -> Extended {
    let points = run.extended();
    let mut blocks: Vec<u32> = run.spans.iter().map(|s| s.block).collect();
    let mut feeds = run.feeds.clone();
    let mut junctions = run.junctions.clone();
    if run.heel > 0.0 {
        blocks.insert(0, blocks[0]);
        feeds.insert(0, feeds[0]);
        if let Some(&first) = junctions.first() {
            junctions.insert(0, first);
        }
    }
    blocks.resize(points.len() - 1, blocks[blocks.len() - 1]);
    feeds.resize(points.len() - 1, feeds[feeds.len() - 1]);
    if let Some(&last) = junctions.last() {
        junctions.resize(points.len() - 1, last);
    }
    let end = polyline::length(&points);
    Extended { points, blocks, feeds, junctions, start: 0.0, end }
}

/// Minimum length of contour added before the start and after the end of a ring, mm, so that the curve has its usual shape
/// there; and the minimum number of chords.
pub(in crate::plan) const LEAD: f64 = 8.0;
const LEAD_CHORDS: usize = 3;
/// Maximum number of laps added at either end.
const MOST_LAPS: usize = 4;
/// Length after the end of a ring that may still be cut, mm: smoothing may have shortened the curve.
const SEAM: f64 = 1.0;

/// Maximum length of curve between the tip and the heel of a blade, in widths of the blade. On the tightest curve for the chord
/// mode, of radius 0.55 widths, it is 1.26.
const HEEL_REACH: f64 = 1.3;

/// A ring. It overlaps along itself: it starts in its orientation mode, with the heel on the path behind, and ends past its
/// start by the front overlap.
fn ring(run: &Run, [lead_before, lead_behind]: [f64; 2]) -> Extended {
    let n = run.points.len() - 1;
    let chord = |i: usize| (run.points[i % n + 1] - run.points[i % n]).norm();
    // Walk along the chords of the contour until the required length is reached.
    let lead = |length: f64, next: &dyn Fn(usize) -> usize| {
        let (mut chords, mut sum) = (0, 0.0);
        while (sum < length || chords < LEAD_CHORDS) && chords < MOST_LAPS * n {
            sum += chord(next(chords));
            chords += 1;
        }
        (chords, sum)
    };
    let (before, start) = lead(lead_before, &|i| n - 1 - i % n);
    let (after, _) = lead(run.front + lead_behind, &|i| i);
    let first = n - before % n;
    let chords = before + n + after;
    let points = (0..=chords).map(|i| run.points[(first + i) % n]).collect();
    let blocks = (0..chords).map(|i| run.spans[(first + i) % n].block).collect();
    let feeds = (0..chords).map(|i| run.feeds[(first + i) % n]).collect();
    let is_junction = |i: usize| run.junctions.get((first + i) % n).copied();
    let junctions = (0..chords).filter_map(is_junction).collect();
    let end = start + polyline::length(&run.points) + run.front;
    Extended { points, blocks, feeds, junctions, start, end }
}

/// Source blocks of a run by station.
#[derive(Debug)]
pub(in crate::plan) struct Blocks {
    /// Station where each block starts, mm; the first is 0.
    starts: Vec<f64>,
    /// The blocks; consecutive ones differ.
    blocks: Vec<u32>,
}

impl Blocks {
    /// The blocks of the chords between `stations`, of which there is one more than `blocks`.
    pub(in crate::plan) fn new(stations: &[f64], blocks: &[u32]) -> Self {
        let mut of_run = Self { starts: Vec::new(), blocks: Vec::new() };
        for (&start, &block) in stations.iter().zip(blocks) {
            if of_run.blocks.last() != Some(&block) {
                of_run.starts.push(start);
                of_run.blocks.push(block);
            }
        }
        of_run
    }

    /// The block at a station.
    pub(in crate::plan) fn at(&self, u: f64) -> u32 {
        self.blocks[self.starts.partition_point(|&start| start <= u).max(1) - 1]
    }

    /// The blocks of a motion of `ticks` periods; `at` gives the station at each tick and must not decrease.
    pub(in crate::plan) fn spells(&self, ticks: u32, at: impl Fn(u32) -> f64) -> Vec<Spell> {
        let mut spells = vec![Spell { first: 0, block: self.blocks[0] }];
        for (&start, &block) in self.starts.iter().zip(&self.blocks).skip(1) {
            let last = spells[spells.len() - 1];
            let first = first_behind(last.first..ticks, |i| at(i) >= start);
            if first == ticks {
                break;
            }
            if first == last.first {
                spells.pop();
            }
            if spells.last().is_none_or(|before| before.block != block) {
                spells.push(Spell { first, block });
            }
        }
        spells
    }
}

/// The first tick of the range for which `is_behind`, which then holds for all later ticks; the end of the range when there is
/// none. The search doubles its steps before it bisects, so near results are found at once.
fn first_behind(ticks: std::ops::Range<u32>, is_behind: impl Fn(u32) -> bool) -> u32 {
    let (mut low, mut step) = (ticks.start, 1);
    let mut high = low;
    while high < ticks.end && !is_behind(high) {
        low = high + 1;
        high = high.saturating_add(step);
        step *= 2;
    }
    let mut high = high.min(ticks.end);
    while low < high {
        let middle = u32::midpoint(low, high);
        if is_behind(middle) {
            high = middle;
        } else {
            low = middle + 1;
        }
    }
    low
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spells_say_the_block_of_every_tick() {
        let stations = [0.0, 1.0, 1.5, 1.6, 7.0, 9.0, 30.0, 31.0];
        let blocks = Blocks::new(&stations, &[4, 4, 5, 6, 4, 9, 9]);
        for ticks in [1_u32, 2, 7, 40, 400] {
            let at = |i: u32| 29.0 * (f64::from(i) / f64::from(ticks)).powi(2);
            let spells = blocks.spells(ticks, at);
            assert!(spells.windows(2).all(|w| w[0].first < w[1].first && w[0].block != w[1].block), "{spells:?}");
            for i in 0..ticks {
                let said = spells.iter().rev().find(|spell| spell.first <= i).map(|spell| spell.block);
                assert_eq!(said, Some(blocks.at(at(i))), "tick {i} of {ticks}");
            }
        }
    }
}
