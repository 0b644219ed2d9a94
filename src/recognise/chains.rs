//! Chains of strokes: which end continues which.

use crate::geom::Point;
use crate::ir::drawing::Drawing;

/// An end of a stroke: twice its index, and one more for its last place.
pub(super) type End = usize;

/// The other end of a stroke.
pub(super) const fn other(end: End) -> End {
    end ^ 1
}

/// Where an end is.
pub(super) fn place(drawing: &Drawing, end: End) -> Point {
    let stroke = drawing.strokes[end / 2];
    drawing.vertices[if end.is_multiple_of(2) { stroke.first } else { stroke.end - 1 } as usize].at
}

/// Links between the ends of strokes, and the chains that they make.
#[derive(Debug)]
pub(super) struct Chains {
    /// The end that continues each end, where one does.
    pub(super) links: Vec<Option<End>>,
    /// The other end of the chain, for each end of a chain of linked strokes; of no use for other ends.
    far: Vec<End>,
}

impl Chains {
    /// Chains of one stroke each.
    pub(super) fn alone(strokes: usize) -> Self {
        Self { links: vec![None; 2 * strokes], far: (0..2 * strokes).map(other).collect() }
    }

    /// The other end of the chain that an end is one of.
    pub(super) fn far(&self, end: End) -> End {
        self.far[end]
    }

    /// Makes one chain of two.
    pub(super) fn join(&mut self, [a, b]: [End; 2]) {
        (self.links[a], self.links[b]) = (Some(b), Some(a));
        let [start, end] = [self.far[a], self.far[b]];
        if start != b {
            (self.far[start], self.far[end]) = (end, start);
        }
    }

    /// Adds a stroke that continues one end and leads to another.
    pub(super) fn join_over(&mut self, [a, b]: [End; 2]) {
        let start = self.links.len();
        self.links.extend([None, None]);
        self.far.extend([start + 1, start]);
        self.join([a, start]);
        self.join([start + 1, b]);
    }

    /// The strokes of a chain by the ends that they start at, from one on.
    pub(super) fn from(&self, first: End) -> impl Iterator<Item = End> {
        std::iter::successors(Some(first), move |&at| self.links[other(at)].filter(|&next| next != first))
    }

    /// Where a chain that holds a stroke starts. One that closes starts with that stroke itself.
    pub(super) fn start(&self, stroke: usize) -> End {
        let mut at = 2 * stroke;
        while let Some(before) = self.links[at] {
            at = other(before);
            if at / 2 == stroke {
                return 2 * stroke;
            }
        }
        at
    }
}
