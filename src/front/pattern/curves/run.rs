//! Runs: the vertices through which one curve goes.

use super::nodes::Node;
use crate::front::pattern::chain::Chain;
use crate::geom::Point;

/// Whether a vertex is a curve point.
pub(super) fn is_curve(node: Node) -> bool {
    matches!(node, Node::Smooth | Node::Notched)
}

/// A run of vertices through which one curve goes.
pub(super) struct Run<'a> {
    pub(super) line: &'a Chain,
    pub(super) nodes: &'a [Node],
    /// Indices of its vertices in the line, in order, both ends included.
    pub(super) places: &'a [usize],
    /// Whether it goes round without a corner: then the curve leads on from its last vertex to its first.
    pub(super) is_ring: bool,
}

impl Run<'_> {
    pub(super) fn at(&self, i: usize) -> Point {
        self.line.vertices[self.places[i % self.places.len()]].at
    }
}
