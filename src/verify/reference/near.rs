//! Stretches of lines beside which the edge of another part runs: the blade may have to be slower there.

use super::shared::{SAME, lies_on};
use crate::geom::Extent;
use crate::geom::boxes::Boxes;
use crate::ir::Marker;
use crate::ir::list::Segment;
use crate::ir::marker::NearEdge;

/// Near edges of a marker, indexed by place.
#[derive(Debug)]
pub(in crate::verify) struct Near<'a> {
    edges: &'a [NearEdge],
    boxes: Boxes,
}

impl<'a> Near<'a> {
    /// Near edges of a marker.
    pub(super) fn new(marker: &'a Marker) -> Self {
        let extents = marker.near.iter().map(|edge| Extent::between(edge.ends[0], edge.ends[1]).grown(SAME));
        Self { edges: &marker.near, boxes: Boxes::new(extents.collect()) }
    }

    /// Station ranges of a line of a piece that lie on near edges, in order of their starts, mm.
    pub(super) fn along(&self, piece: u32, line: &[Segment]) -> Vec<[f64; 2]> {
        let mut found = Vec::new();
        let mut start = 0.0;
        for chord in line {
            let near = self.boxes.near(Extent::between(chord.from, chord.to)).map(|i| &self.edges[i]);
            let of_piece = near.filter(|edge| edge.piece == piece);
            let on = of_piece.filter_map(|edge| lies_on([chord.from, chord.to], edge.ends));
            found.extend(on.map(|ends| ends.map(|station| start + station)));
            start += chord.length();
        }
        found.sort_by(|a: &[f64; 2], b| a[0].total_cmp(&b[0]));
        found
    }
}
