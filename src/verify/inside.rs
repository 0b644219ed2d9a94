//! Which parts a point lies in: even-odd containment in the closed contours of each piece.

use crate::geom::{Extent, Point};
use crate::ir::Marker;

/// Edges a band holds on average, at the least; and the most bands.
const EDGES_A_BAND: usize = 8;
const BANDS_MAX: usize = 65_536;

/// The edges of all closed contours, in bands along Y.
#[derive(Debug)]
pub(super) struct Inside {
    bottom: f64,
    height: f64,
    bands: Vec<Vec<Edge>>,
}

#[derive(Debug, Clone, Copy)]
struct Edge {
    from: Point,
    to: Point,
    piece: u32,
}

impl Inside {
    /// The index of a marker.
    pub(super) fn new(marker: &Marker) -> Self {
        let mut edges = Vec::new();
        let mut extent = Extent::EMPTY;
        for (piece, contour) in marker.contours().filter(|(_, contour)| contour.closed) {
            for (_, segment) in marker.list.walk(contour.range) {
                extent.add(segment.from);
                edges.push(Edge { from: segment.from, to: segment.to, piece: piece as u32 });
            }
        }
        if edges.is_empty() {
            extent.add(Point::origin());
        }
        let count = (edges.len() / EDGES_A_BAND).clamp(1, BANDS_MAX);
        let height = (extent.size().1 / count as f64).max(f64::MIN_POSITIVE);
        let mut inside = Self { bottom: extent.min.y, height, bands: vec![Vec::new(); count] };
        for edge in edges {
            let (low, high) = (inside.band(edge.from.y.min(edge.to.y)), inside.band(edge.from.y.max(edge.to.y)));
            for band in &mut inside.bands[low..=high] {
                band.push(edge);
            }
        }
        inside
    }

    fn band(&self, y: f64) -> usize {
        (((y - self.bottom) / self.height).max(0.0) as usize).min(self.bands.len() - 1)
    }

    /// The pieces whose cloth lies at a point: inside their outline, not inside a cut-out.
    pub(super) fn pieces_at(&self, point: Point) -> Vec<usize> {
        let mut odd: Vec<usize> = Vec::new();
        for edge in &self.bands[self.band(point.y)] {
            let Edge { from, to, piece } = *edge;
            if (from.y > point.y) == (to.y > point.y) {
                continue;
            }
            let x = from.x + (to.x - from.x) * (point.y - from.y) / (to.y - from.y);
            if x > point.x {
                match odd.iter().position(|&p| p == piece as usize) {
                    Some(i) => drop(odd.swap_remove(i)),
                    None => odd.push(piece as usize),
                }
            }
        }
        odd.sort_unstable();
        odd
    }
}
