//! Lines of a segment list as they were appended, with their monotone chains and the boxes of the chains.
//!
//! Most passes need the chains, and most lines are never edited.

use std::borrow::Cow;

use crate::geom::monotone::{self, Chain};
use crate::geom::{Extent, Point};

/// Typical number of segments per chain, used to reserve capacity.
const SEGMENTS_A_CHAIN: usize = 8;

/// Monotone chains of a polyline.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Chains<'a> {
    /// The chains, as point indices.
    pub all: Cow<'a, [Chain]>,
    /// Bounding box of each chain.
    pub boxes: Cow<'a, [Extent]>,
}

impl Chains<'_> {
    /// The chains of a polyline.
    pub(super) fn of(points: &[Point]) -> Self {
        let (all, boxes): (Vec<_>, Vec<_>) =
            monotone::chains(points).map(|chain| (chain, chain.extent(points))).unzip();
        Self { all: all.into(), boxes: boxes.into() }
    }

    /// The chains with their boxes.
    pub fn each(&self) -> impl Iterator<Item = (&Chain, &Extent)> {
        self.all.iter().zip(&*self.boxes)
    }
}

/// Index of a line.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct LineId(u32);

/// Lines in the order in which they were appended.
#[derive(Debug, Clone, Default)]
pub(super) struct Lines {
    all: Vec<Line>,
    /// Chains of all lines, as point indices of their line.
    chains: Vec<Chain>,
    /// Bounding box of each chain.
    boxes: Vec<Extent>,
}

/// A line as it was appended.
#[derive(Debug, Clone)]
pub(super) struct Line {
    /// Ids of its first and its last segment.
    ends: [u32; 2],
    /// Range of its chains among those of all lines.
    chains: [u32; 2],
    /// Bounding box.
    pub(super) extent: Extent,
    /// True once a point of it has been moved: its chains and boxes are then out of date.
    is_moved: bool,
}

impl Lines {
    /// Reserves capacity for more segments in more lines.
    pub(super) fn reserve(&mut self, segments: usize, lines: usize) {
        self.all.reserve(lines);
        self.chains.reserve(segments / SEGMENTS_A_CHAIN);
        self.boxes.reserve(segments / SEGMENTS_A_CHAIN);
    }

    /// Appends a line, given the ids of its first and its last segment.
    pub(super) fn add(&mut self, ends: [u32; 2], points: &[Point]) -> LineId {
        let first = self.chains.len();
        self.chains.extend(monotone::chains(points));
        self.boxes.extend(self.chains[first..].iter().map(|chain| chain.extent(points)));
        let mut extent = Extent::EMPTY;
        self.boxes[first..].iter().for_each(|of_chain| extent.join(of_chain));
        let chains = [first, self.chains.len()].map(|place| place as u32);
        self.all.push(Line { ends, chains, extent, is_moved: false });
        LineId(self.all.len() as u32 - 1)
    }

    /// The line with these ends; `None` once a point of it has been moved.
    pub(super) fn get(&self, LineId(id): LineId, ends: [u32; 2]) -> Option<&Line> {
        self.all.get(id as usize).filter(|line| line.ends == ends && !line.is_moved)
    }

    /// The chains of a line.
    pub(super) fn chains(&self, line: &Line) -> Chains<'_> {
        let [first, end] = line.chains.map(|place| place as usize);
        Chains { all: Cow::Borrowed(&self.chains[first..end]), boxes: Cow::Borrowed(&self.boxes[first..end]) }
    }

    /// Marks the chains of a line as out of date when the end of segment `id`, or the start of the next one, is moved.
    pub(super) fn forget(&mut self, id: u32) {
        let place = self.all.partition_point(|line| line.ends[1] < id);
        if let Some(line) = self.all.get_mut(place).filter(|line| line.ends[0] <= id + 1) {
            line.is_moved = true;
        }
    }

    /// Drops all lines, because all points are moved.
    pub(super) fn clear(&mut self) {
        self.all.clear();
        self.chains.clear();
        self.boxes.clear();
    }
}
