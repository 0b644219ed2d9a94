//! Chains of linked strokes.

use crate::geom::Point;
use crate::ir::drawing::Drawing;

/// End of a stroke: twice its index, plus one for its last place.
pub(super) type End = usize;

/// Other end of a stroke.
pub(super) const fn other(end: End) -> End {
    end ^ 1
}

/// Place of an end.
pub(super) fn place(drawing: &Drawing, end: End) -> Point {
    let stroke = drawing.strokes[end / 2];
    drawing.vertices[if end.is_multiple_of(2) { stroke.first } else { stroke.end - 1 } as usize].at
}

/// Links between the ends of strokes, and the resulting chains.
#[derive(Debug)]
pub(super) struct Chains {
    /// End that continues each end; `None` for a free end.
    pub(super) links: Vec<Option<End>>,
    /// Other end of the chain, valid for the ends of chains only.
    far: Vec<End>,
}

impl Chains {
    /// Chains of one stroke each.
    pub(super) fn alone(strokes: usize) -> Self {
        Self { links: vec![None; 2 * strokes], far: (0..2 * strokes).map(other).collect() }
    }

    /// Other end of the chain with this end.
    pub(super) fn far(&self, end: End) -> End {
        self.far[end]
    }

    /// Joins two chains.
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

    /// Strokes of a chain, by the ends at which they start, from one on.
    pub(super) fn from(&self, first: End) -> impl Iterator<Item = End> {
        std::iter::successors(Some(first), move |&at| self.links[other(at)].filter(|&next| next != first))
    }

    /// Start of the chain that contains a stroke; the stroke itself for a closed chain.
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
