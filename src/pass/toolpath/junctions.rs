//! Junctions of a marker, searchable by chord.

use crate::geom::boxes::Boxes;
use crate::geom::{Extent, Point, Vector, polyline};
use crate::ir::Marker;
use crate::machine::MachineProfile;

/// Greatest distance of a chord from a junction that it passes, mm: the greatest merge tolerance.
const REACH: f64 = 1.0;
/// Longest stretch of a cut straight on past the corner of its own outline, in multiples of the merge tolerance. A longer one
/// leads a cut of another part over to an edge, and may begin at the same place.
const PAST: f64 = 4.0;
/// Distance within which two places are the same, mm: rounding.
const SAME_PLACE: f64 = 1e-6;
/// Least cosine of the angle between two directions that are the same: rounding.
const SAME_WAY: f64 = 1.0 - 1e-9;

/// Spatial index of the junctions of a marker.
#[derive(Debug)]
pub(super) struct Junctions<'a> {
    ways: &'a [[Point; 2]],
    boxes: Boxes,
    /// Longest stretch past a corner, mm.
    past: f64,
}

impl<'a> Junctions<'a> {
    /// Indexes the junctions of a marker.
    pub(super) fn new(marker: &'a Marker, profile: &MachineProfile) -> Self {
        let extents = marker.junctions.iter().map(|[from, to]| Extent::between(*from, *to).grown(REACH));
        let past = PAST * profile.common(marker.unit).unwrap_or(0.0);
        Self { ways: &marker.junctions, boxes: Boxes::new(extents.collect()), past }
    }

    /// True if a junction may lie near a chord of a polyline; a quick test by bounding boxes.
    pub(super) fn may_be_by(&self, points: &[Point]) -> bool {
        self.boxes.near(Extent::of(points)).next().is_some()
    }

    /// True if a junction lies near a chord.
    pub(super) fn is_by(&self, from: Point, to: Point) -> bool {
        let mut near = self.boxes.near(Extent::between(from, to)).map(|i| self.ways[i]);
        near.any(|way| polyline::distance_of_segments(way, [from, to]) <= REACH)
    }

    /// Distance that a cut goes on along a unit vector from a place where it leaves its own outline, to cross the cut of
    /// another part, mm; 0 if there is no such cut.
    pub(super) fn beyond(&self, from: Point, along: Vector) -> f64 {
        let near = self.boxes.near(Extent::between(from, from)).map(|i| self.ways[i]);
        let here = near.filter(|[start, _]| (start - from).norm() <= SAME_PLACE).map(|[start, end]| end - start);
        let ahead = here.filter(|way| way.dot(&along) >= SAME_WAY * way.norm()).map(|way| way.norm());
        ahead.filter(|&way| way <= self.past).fold(0.0, f64::max)
    }
}
