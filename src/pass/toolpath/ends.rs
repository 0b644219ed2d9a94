//! Ends of the runs of a toolpath by place, and the cuts that meet there.

use crate::analysis::plunge::Plunge;
use crate::geom::{Point, bits, polyline};
use crate::ir::toolpath::Run;

/// Ends of runs, sorted by their places.
#[derive(Debug)]
pub(super) struct Ends {
    all: Vec<RunEnd>,
}

/// One end of a run.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct RunEnd {
    /// Bits of its coordinates.
    place: [u64; 2],
    /// Index of the run.
    run: usize,
    is_start: bool,
}

impl Ends {
    /// Ends of all runs.
    pub(super) fn new<'a>(runs: impl Iterator<Item = &'a Run>) -> Self {
        let ends = runs.enumerate().flat_map(|(run, Run { points, .. })| {
            let end = |at: Point, is_start: bool| RunEnd { place: bits(at), run, is_start };
            [end(points[0], true), end(points[points.len() - 1], false)]
        });
        let mut all: Vec<RunEnd> = ends.collect();
        all.sort_unstable();
        Self { all }
    }

    /// Ends at a place.
    fn at(&self, place: Point) -> &[RunEnd] {
        let place = bits(place);
        let first = self.all.partition_point(|end| end.place < place);
        let count = self.all[first..].iter().take_while(|end| end.place == place).count();
        &self.all[first..first + count]
    }

    /// True if several ends are at a place.
    pub(super) fn are_several(&self, place: Point) -> bool {
        self.at(place).len() > 1
    }

    /// True if the blade that plunges at the start of a run passes beside another cut that begins or ends there, by more than
    /// `allowed` mm. Both are as wide as their overlaps reach; the blade has `width` mm.
    pub(super) fn has_miss(&self, runs: &[&Run], run: usize, allowed: f64, width: f64) -> bool {
        let Some(blade) = plunged(runs[run], width) else { return false };
        let others = self.at(runs[run].points[0]).iter().filter(|end| (end.run, end.is_start) != (run, true));
        let cut = |end: &RunEnd| {
            let other = runs[end.run];
            if end.is_start { plunged(other, width) } else { Some(lifted(other)) }
        };
        others.filter_map(cut).any(|cut| polyline::distance_of_segments(blade, cut) > allowed)
    }
}

/// The blade of `width` mm plunged at the start of a run, from heel to tip; `None` if the run is shorter.
fn plunged(run: &Run, width: f64) -> Option<[Point; 2]> {
    let plunge = Plunge::at_start(&run.extended(), width);
    (!plunge.covers_all).then_some([plunge.heel, plunge.tip])
}

/// The last chord of a run with its overlap.
fn lifted(Run { points, front, .. }: &Run) -> [Point; 2] {
    let [from, to] = [points[points.len() - 2], points[points.len() - 1]];
    let along = polyline::direction(from, to).expect("no chord of a run has length zero");
    [from, to + along * *front]
}
