//! Near lines of a marker, searchable by run.

use crate::geom::boxes::Boxes;
use crate::geom::{Extent, Point, polyline};
use crate::ir::Marker;
use crate::ir::marker::NearEdge;

/// Distance of a run from the edge it lies on, and length of a negligible stretch, mm: rounding.
const SAME: f64 = 1e-6;

/// Spatial index of the edges beside which another part's edge runs.
#[derive(Debug)]
pub(super) struct NearLines<'a> {
    edges: &'a [NearEdge],
    boxes: Boxes,
}

impl<'a> NearLines<'a> {
    /// Indexes the near lines of a marker.
    pub(super) fn new(marker: &'a Marker) -> Self {
        let extents = marker.near.iter().map(|edge| Extent::between(edge.ends[0], edge.ends[1]).grown(SAME));
        Self { edges: &marker.near, boxes: Boxes::new(extents.collect()) }
    }

    /// Stretches of a run of a piece that lie on near lines of that piece: pairs of stations, merged, mm.
    pub(super) fn along(&self, piece: u32, points: &[Point]) -> Vec<[f64; 2]> {
        let mut found: Vec<[f64; 2]> = Vec::new();
        for (chord, start) in points.windows(2).zip(polyline::stations(points)) {
            let near = self.boxes.near(Extent::between(chord[0], chord[1])).map(|i| self.edges[i]);
            let of_piece = near.filter(|edge| edge.piece == piece);
            let mut on: Vec<[f64; 2]> = of_piece.filter_map(|edge| stretch([chord[0], chord[1]], edge.ends)).collect();
            on.sort_by(|a, b| a[0].total_cmp(&b[0]));
            for [from, to] in on.into_iter().map(|stretch| stretch.map(|station| start + station)) {
                match found.last_mut().filter(|last| from <= last[1] + SAME) {
                    Some(last) => last[1] = last[1].max(to),
                    None => found.push([from, to]),
                }
            }
        }
        found
    }
}

/// Stretch of a chord that lies on an edge, as two distances from its start, mm.
fn stretch([from, to]: [Point; 2], ends: [Point; 2]) -> Option<[f64; 2]> {
    let along = polyline::direction(from, to)?;
    if ends.iter().any(|end| polyline::distance_to_line(*end, from, along) > SAME) {
        return None;
    }
    let [a, b] = ends.map(|end| (end - from).dot(&along).clamp(0.0, (to - from).norm()));
    let stretch = [a.min(b), a.max(b)];
    (stretch[1] - stretch[0] > SAME).then_some(stretch)
}
