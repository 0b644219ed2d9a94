//! Junctions of a marker, to be asked which of them a chord comes by.

use crate::geom::boxes::Boxes;
use crate::geom::{Extent, Point, Vector, polyline};
use crate::ir::Marker;
use crate::machine::MachineProfile;

/// A chord passes a junction that is no farther than this, mm: the widest that two edges of a band may be apart.
const REACH: f64 = 1.0;
/// Longest way on which a cut goes straight on past the corner of its own outline, in distances of two edges. A longer one leads
/// a cut of another part over to an edge, which may begin at the same place.
const PAST: f64 = 4.0;
/// Places that are nearer are one, mm: rounding.
const SAME_PLACE: f64 = 1e-6;
/// Cosine of the greatest angle between two ways that are one: rounding.
const SAME_WAY: f64 = 1.0 - 1e-9;

/// The junctions of a marker, by place.
#[derive(Debug)]
pub(super) struct Junctions<'a> {
    ways: &'a [[Point; 2]],
    boxes: Boxes,
    /// Longest way past a corner, mm.
    past: f64,
}

impl<'a> Junctions<'a> {
    /// Those of a marker.
    pub(super) fn new(marker: &'a Marker, profile: &MachineProfile) -> Self {
        let extents = marker.junctions.iter().map(|[from, to]| Extent::between(*from, *to).grown(REACH));
        let past = PAST * profile.common(marker.unit).unwrap_or(0.0);
        Self { ways: &marker.junctions, boxes: Boxes::new(extents.collect()), past }
    }

    /// Whether one may lie by a chord of a polyline.
    pub(super) fn may_be_by(&self, points: &[Point]) -> bool {
        self.boxes.near(Extent::of(points)).next().is_some()
    }

    /// Whether one lies by a chord.
    pub(super) fn is_by(&self, from: Point, to: Point) -> bool {
        let mut near = self.boxes.near(Extent::between(from, to)).map(|i| self.ways[i]);
        near.any(|way| polyline::distance_of_segments(way, [from, to]) <= REACH)
    }

    /// How far a cut goes on beyond a place where it leaves its own outline, along a unit vector, to be through the cut of another
    /// part, mm; 0 where none is to be crossed.
    pub(super) fn beyond(&self, from: Point, along: Vector) -> f64 {
        let near = self.boxes.near(Extent::between(from, from)).map(|i| self.ways[i]);
        let here = near.filter(|[start, _]| (start - from).norm() <= SAME_PLACE).map(|[start, end]| end - start);
        let ahead = here.filter(|way| way.dot(&along) >= SAME_WAY * way.norm()).map(|way| way.norm());
        ahead.filter(|&way| way <= self.past).fold(0.0, f64::max)
    }
}
