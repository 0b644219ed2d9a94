//! Lines of a segment list as they were appended, with their monotone chains and the boxes around these.
//!
//! Most passes ask for chains, and most lines stay as they were appended.

use std::borrow::Cow;

use crate::geom::monotone::{self, Chain};
use crate::geom::{Extent, Point};

/// Usual number of segments of a chain, for the room that is made.
const SEGMENTS_A_CHAIN: usize = 8;

/// Monotone chains of some points.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Chains<'a> {
    /// The chains, as indices of the points.
    pub all: Cow<'a, [Chain]>,
    /// The box around each.
    pub boxes: Cow<'a, [Extent]>,
}

impl Chains<'_> {
    /// Chains of a line.
    pub(super) fn of(points: &[Point]) -> Self {
        let (all, boxes): (Vec<_>, Vec<_>) =
            monotone::chains(points).map(|chain| (chain, chain.extent(points))).unzip();
        Self { all: all.into(), boxes: boxes.into() }
    }

    /// Chains with their boxes.
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
    /// The chains of all, as indices of the points of their line.
    chains: Vec<Chain>,
    /// The box around each.
    boxes: Vec<Extent>,
}

/// A line.
#[derive(Debug, Clone)]
pub(super) struct Line {
    /// Its first and its last segment, as ids.
    ends: [u32; 2],
    /// Its chains, by their places among those of all lines.
    chains: [u32; 2],
    /// The box around it.
    pub(super) extent: Extent,
    /// Whether a point of it was moved since: then chains and boxes are out of date.
    is_moved: bool,
}

impl Lines {
    /// Makes room for more segments in some lines.
    pub(super) fn reserve(&mut self, segments: usize, lines: usize) {
        self.all.reserve(lines);
        self.chains.reserve(segments / SEGMENTS_A_CHAIN);
        self.boxes.reserve(segments / SEGMENTS_A_CHAIN);
    }

    /// Adds a line behind all others, by the ids of its first and its last segment.
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

    /// The line with these ends, unless a point of it was moved.
    pub(super) fn get(&self, LineId(id): LineId, ends: [u32; 2]) -> Option<&Line> {
        self.all.get(id as usize).filter(|line| line.ends == ends && !line.is_moved)
    }

    /// The chains of a line.
    pub(super) fn chains(&self, line: &Line) -> Chains<'_> {
        let [first, end] = line.chains.map(|place| place as usize);
        Chains { all: Cow::Borrowed(&self.chains[first..end]), boxes: Cow::Borrowed(&self.boxes[first..end]) }
    }

    /// Forgets the chains of a line of which a point is moved: the end of that segment, or the start of the next one.
    pub(super) fn forget(&mut self, id: u32) {
        let place = self.all.partition_point(|line| line.ends[1] < id);
        if let Some(line) = self.all.get_mut(place).filter(|line| line.ends[0] <= id + 1) {
            line.is_moved = true;
        }
    }

    /// Forgets all lines, as all points are moved.
    pub(super) fn clear(&mut self) {
        self.all.clear();
        self.chains.clear();
        self.boxes.clear();
    }
}
