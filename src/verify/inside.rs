//! Which parts a point lies in: even-odd containment in the closed contours of each piece.

use crate::geom::nest::{self, Shape};
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
    part_of: Vec<u32>,
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
        let mut shapes = vec![Shape::default(); marker.pieces.len()];
        for (piece, contour) in marker.contours().filter(|(_, contour)| contour.closed) {
            let points = marker.points(contour);
            edges.extend(points.windows(2).map(|w| Edge { from: w[0], to: w[1], piece: piece as u32 }));
            shapes[piece].add(points);
        }
        let mut inside = Self::of(edges);
        inside.part_of = nest::regions(&shapes, |point| inside.pieces_at(point).iter().map(|&p| p as u32).collect());
        // What lies in a piece is a cut-out of it, whoever it belongs to.
        for edge in inside.bands.iter_mut().flatten() {
            edge.piece = inside.part_of[edge.piece as usize];
        }
        inside
    }

    fn of(edges: Vec<Edge>) -> Self {
        let mut extent = Extent::EMPTY;
        for edge in &edges {
            extent.add(edge.from);
        }
        if edges.is_empty() {
            extent.add(Point::origin());
        }
        let count = (edges.len() / EDGES_A_BAND).clamp(1, BANDS_MAX);
        let height = (extent.size().1 / count as f64).max(f64::MIN_POSITIVE);
        let bands = vec![Vec::new(); count];
        let mut inside = Self { bottom: extent.min.y, height, bands, part_of: Vec::new() };
        for edge in edges {
            let (low, high) = (inside.band(edge.from.y.min(edge.to.y)), inside.band(edge.from.y.max(edge.to.y)));
            for band in &mut inside.bands[low..=high] {
                band.push(edge);
            }
        }
        inside
    }

    /// The part to which a piece belongs: itself, or the one of which it is a cut-out.
    pub(super) fn part_of(&self, piece: usize) -> usize {
        self.part_of[piece] as usize
    }

    fn band(&self, y: f64) -> usize {
        (((y - self.bottom) / self.height).max(0.0) as usize).min(self.bands.len() - 1)
    }

    /// The parts whose cloth lies at a point: inside their outline, not inside a cut-out.
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
