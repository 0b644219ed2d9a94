//! Junctions of a marker, to be asked which of them a chord comes by.

use crate::geom::boxes::Boxes;
use crate::geom::{Extent, Point, polyline};
use crate::ir::Marker;

/// A chord passes a junction that is no farther than this, mm: the widest that two edges of a band may be apart.
const REACH: f64 = 1.0;

/// The junctions of a marker, by place.
#[derive(Debug)]
pub(super) struct Junctions<'a> {
    ways: &'a [[Point; 2]],
    boxes: Boxes,
}

impl<'a> Junctions<'a> {
    /// Those of a marker.
    pub(super) fn new(marker: &'a Marker) -> Self {
        let extents = marker.junctions.iter().map(|[from, to]| Extent::between(*from, *to).grown(REACH));
        Self { ways: &marker.junctions, boxes: Boxes::new(extents.collect()) }
    }

    /// Whether one lies by a chord.
    pub(super) fn is_by(&self, from: Point, to: Point) -> bool {
        let mut near = self.boxes.near(Extent::between(from, to)).map(|i| self.ways[i]);
        near.any(|way| polyline::distance_of_segments(way, [from, to]) <= REACH)
    }
}
