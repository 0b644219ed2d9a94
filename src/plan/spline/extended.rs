//! The polyline that the tip and, in the plunge, the heel follow: a run with its overlaps.

use super::lap::Lap;
use crate::geom::{Point, polyline};
use crate::ir::motion::Spell;
use crate::ir::toolpath::{OrientationMode, Run, Shape};

/// A run with its overlaps.
#[derive(Debug)]
pub(in crate::plan) struct Extended {
    pub(in crate::plan) points: Vec<Point>,
    /// The block of each chord.
    pub(in crate::plan) blocks: Vec<u32>,
    /// Greatest speed of the tip on each chord, mm/s.
    pub(in crate::plan) feeds: Vec<f64>,
    /// The chords about which the run crosses cuts of other parts; empty = none.
    pub(in crate::plan) junctions: Vec<bool>,
    /// Station at which the run proper starts, mm.
    pub(in crate::plan) start: f64,
    /// Station at which the tip is lifted, mm.
    pub(in crate::plan) end: f64,
}

impl Extended {
    /// The run with its overlaps, as one polyline; `width` is that of the blade, mm. A ring goes on along itself before its
    /// start and behind its end by `lead` mm at least.
    pub(in crate::plan) fn new(run: &Run, width: f64, lead: f64) -> Self {
        match (run.shape, run.orientation) {
            (Shape::Open, _) => open(run),
            (Shape::Ring, OrientationMode::Tangent) => ring(run, [lead, lead]),
            (Shape::Ring, OrientationMode::Chord) => ring(run, [lead + HEEL_REACH * width, lead]),
        }
    }

    /// The lap of a ring.
    pub(in crate::plan) fn lap(&self, run: &Run) -> Option<Lap> {
        Lap::of(run, self.start, self.end + SEAM)
    }

    /// Its points, each with its station, mm.
    pub(in crate::plan) fn stations(&self) -> impl Iterator<Item = (Point, f64)> + '_ {
        let mut station = 0.0;
        self.points.iter().enumerate().map(move |(i, &point)| {
            station += if i > 0 { (point - self.points[i - 1]).norm() } else { 0.0 };
            (point, station)
        })
    }
}

/// Overlaps run straight on along the end chords.
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

/// Least length of contour before the start and behind the end of a ring that joins the polyline, so that the curve there is
/// what it is elsewhere, mm; and the fewest chords of it.
pub(in crate::plan) const LEAD: f64 = 8.0;
const LEAD_CHORDS: usize = 3;
/// Most laps that join it at either end.
const MOST_LAPS: usize = 4;
/// Length behind the end of a ring up to which its curve may be cut, mm: smoothing may have drawn it back.
const SEAM: f64 = 1.0;

/// How far behind its tip along a curve the heel of a blade may lie, in widths of the blade: on the tightest curve whose
/// chord it can be, with the radius of 0.55 widths, it is 1.26.
const HEEL_REACH: f64 = 1.3;

/// A ring overlaps along itself: it starts as its orientation mode has it, its heel on the path behind, and goes past its
/// start by the front overlap.
fn ring(run: &Run, [lead_before, lead_behind]: [f64; 2]) -> Extended {
    let n = run.points.len() - 1;
    let chord = |i: usize| (run.points[i % n + 1] - run.points[i % n]).norm();
    // Chords of the contour, walked on and on until they are as long as asked.
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

/// The source blocks of a run by station.
#[derive(Debug)]
pub(in crate::plan) struct Blocks {
    /// Station from which each block holds, mm; the first is 0.
    starts: Vec<f64>,
    /// The blocks. No two in a row are equal.
    blocks: Vec<u32>,
}

impl Blocks {
    /// The blocks of chords between `stations`, one more than `blocks`.
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

    /// The blocks of a motion of `ticks` periods of which `at` says the station at each tick, never falling.
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

/// The first tick that `is_behind` something, when all after it are; the end of the range when there is none. The search
/// doubles its steps before it halves them, so that what is near is found at once.
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
