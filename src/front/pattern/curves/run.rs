//! Runs: vertices that share one curve.

use super::nodes::Node;
use crate::front::pattern::chain::Chain;
use crate::geom::Point;

/// True if a vertex is a curve point.
pub(super) fn is_curve(node: Node) -> bool {
    matches!(node, Node::Smooth | Node::Notched)
}

/// A run of vertices that share one curve.
pub(super) struct Run<'a> {
    pub(super) line: &'a Chain,
    pub(super) nodes: &'a [Node],
    /// Indices of its vertices in the line, in order, including both ends.
    pub(super) places: &'a [usize],
    /// True for a ring without corners: its curve continues from the last vertex to the first.
    pub(super) is_ring: bool,
}

impl Run<'_> {
    pub(super) fn at(&self, i: usize) -> Point {
        self.line.vertices[self.places[i % self.places.len()]].at
    }
}
