//! Which parts a point lies in: even-odd containment in the closed contours of each piece.

use crate::geom::nest::{self, Shape};
use crate::geom::{Extent, Point};
use crate::ir::Marker;

/// Edges that a band of a part holds on average, at the least.
const EDGES_A_BAND: usize = 8;
/// Parts that a cell holds on average, at the least; and the most cells along a side.
const PARTS_A_CELL: usize = 2;
const CELLS_MAX: usize = 1024;

/// The parts, each by the cells that its box touches.
#[derive(Debug)]
pub(super) struct Inside {
    extent: Extent,
    /// Size of a cell along X and Y, mm.
    cell: [f64; 2],
    columns: usize,
    cells: Vec<Vec<u32>>,
    parts: Vec<Part>,
    /// Of each piece the part to which it belongs.
    part_of: Vec<u32>,
}

/// The edges of a piece's closed contours, in bands along Y.
#[derive(Debug)]
struct Part {
    piece: usize,
    extent: Extent,
    height: f64,
    bands: Vec<Vec<[Point; 2]>>,
}

impl Inside {
    /// The index of a marker.
    pub(super) fn new(marker: &Marker) -> Self {
        let mut edges: Vec<Vec<[Point; 2]>> = vec![Vec::new(); marker.pieces.len()];
        let mut shapes = vec![Shape::default(); marker.pieces.len()];
        for (piece, contour) in marker.contours().filter(|(_, contour)| contour.closed) {
            let points = marker.points(contour);
            edges[piece].extend(points.windows(2).map(|w| [w[0], w[1]]));
            shapes[piece].add(points);
        }
        let pieces = Self::of(&edges);
        let part_of = nest::regions(&shapes, |point| pieces.pieces_at(point).iter().map(|&p| p as u32).collect());
        // What lies in a piece is a cut-out of it, whoever it belongs to.
        let mut parts: Vec<Vec<[Point; 2]>> = vec![Vec::new(); edges.len()];
        for (edges, &part) in edges.into_iter().zip(&part_of) {
            parts[part as usize].extend(edges);
        }
        Self { part_of, ..Self::of(&parts) }
    }

    /// The index of parts, each by its edges.
    fn of(edges: &[Vec<[Point; 2]>]) -> Self {
        let there = edges.iter().enumerate().filter(|(_, edges)| !edges.is_empty());
        let parts: Vec<Part> = there.map(|(piece, edges)| Part::new(piece, edges)).collect();
        let mut extent = Extent::EMPTY;
        for part in &parts {
            extent.add(part.extent.min);
            extent.add(part.extent.max);
        }
        if extent.is_empty() {
            extent.add(Point::origin());
        }
        let (width, height) = extent.size();
        let count = (parts.len() / PARTS_A_CELL).max(1) as f64;
        // As many cells as that, about as high as wide.
        let side = (width * height / count).sqrt().max(f64::MIN_POSITIVE);
        let along = |length: f64| ((length / side) as usize).clamp(1, CELLS_MAX);
        let (columns, rows) = (along(width), along(height));
        let cell = [width / columns as f64, height / rows as f64].map(|size| size.max(f64::MIN_POSITIVE));
        let cells = vec![Vec::new(); columns * rows];
        let mut inside = Self { extent, cell, columns, cells, parts, part_of: Vec::new() };
        for i in 0..inside.parts.len() {
            let [low, high] = [inside.parts[i].extent.min, inside.parts[i].extent.max].map(|at| inside.place(at));
            for row in low[1]..=high[1] {
                for column in low[0]..=high[0] {
                    inside.cells[row * columns + column].push(i as u32);
                }
            }
        }
        inside
    }

    /// Column and row of a point; what lies outside belongs to the outermost.
    fn place(&self, point: Point) -> [usize; 2] {
        let away = point - self.extent.min;
        let counts = [self.columns, self.cells.len() / self.columns];
        std::array::from_fn(|i| ((away[i] / self.cell[i]).max(0.0) as usize).min(counts[i] - 1))
    }

    /// The part to which a piece belongs: itself, or the one of which it is a cut-out.
    pub(super) fn part_of(&self, piece: usize) -> usize {
        self.part_of[piece] as usize
    }

    /// The parts whose cloth lies at a point: inside their outline, not inside a cut-out.
    pub(super) fn pieces_at(&self, point: Point) -> Vec<usize> {
        let [column, row] = self.place(point);
        let near = self.cells[row * self.columns + column].iter().map(|&part| &self.parts[part as usize]);
        let mut pieces: Vec<usize> = near.filter(|part| part.holds(point)).map(|part| part.piece).collect();
        pieces.sort_unstable();
        pieces
    }
}

impl Part {
    fn new(piece: usize, edges: &[[Point; 2]]) -> Self {
        let mut extent = Extent::EMPTY;
        for edge in edges {
            extent.add(edge[0]);
        }
        let count = (edges.len() / EDGES_A_BAND).max(1);
        let height = (extent.size().1 / count as f64).max(f64::MIN_POSITIVE);
        let mut part = Self { piece, extent, height, bands: vec![Vec::new(); count] };
        for &edge in edges {
            let [a, b] = edge.map(|end| part.band(end.y));
            for band in &mut part.bands[a.min(b)..=a.max(b)] {
                band.push(edge);
            }
        }
        part
    }

    fn band(&self, y: f64) -> usize {
        (((y - self.extent.min.y) / self.height).max(0.0) as usize).min(self.bands.len() - 1)
    }

    /// Whether a ray to the right of a point crosses the edges an odd number of times.
    fn holds(&self, point: Point) -> bool {
        let Extent { min, max } = self.extent;
        if point.y < min.y || point.y > max.y || point.x < min.x || point.x > max.x {
            return false;
        }
        let is_crossed = |[from, to]: &&[Point; 2]| {
            (from.y > point.y) != (to.y > point.y)
                && from.x + (to.x - from.x) * (point.y - from.y) / (to.y - from.y) > point.x
        };
        self.bands[self.band(point.y)].iter().filter(is_crossed).count() % 2 == 1
    }
}
