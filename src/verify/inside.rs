//! Which parts a point lies in: even-odd containment in the closed contours of each piece.

use std::borrow::Cow;

use rayon::prelude::*;

use crate::geom::nest::{self, Shape};
use crate::geom::{Extent, Point};
use crate::ir::Marker;
use crate::ir::marker::Piece;

/// Edges that a band of a part holds on average, at the least.
const EDGES_A_BAND: usize = 8;
/// Parts that a cell holds on average, at the least; and the most cells along a side.
const PARTS_A_CELL: usize = 2;
const CELLS_MAX: usize = 1024;

/// The parts, each by the cells that its box touches.
#[derive(Debug)]
pub(super) struct Inside<'a> {
    extent: Extent,
    /// Size of a cell along X and Y, mm.
    cell: [f64; 2],
    columns: usize,
    cells: Vec<Vec<u32>>,
    parts: Vec<Part<'a>>,
    /// The part to which each piece belongs.
    part_of: Vec<usize>,
}

/// The edges of a piece's closed contours, in bands along Y.
#[derive(Debug)]
struct Part<'a> {
    piece: usize,
    /// Its contours, each of which ends with its first point.
    rings: Box<[Cow<'a, [Point]>]>,
    /// How many points stand before those of each ring.
    firsts: Box<[u32]>,
    extent: Extent,
    height: f64,
    /// Where the edges of each band begin, and where those of the last one end.
    starts: Vec<u32>,
    /// The edges, one band after the other: the places where they start in all rings, one behind the other.
    edges: Vec<u32>,
}

impl<'a> Inside<'a> {
    /// The index of a marker.
    pub(super) fn new(marker: &'a Marker) -> Self {
        let part = |(i, piece)| Part::new(i, (piece, marker));
        let parts: Vec<Part> = marker.pieces.par_iter().enumerate().filter_map(part).collect();
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
        // What lies in a piece is a cut-out of it, whoever it belongs to.
        let holders = |point| inside.rings_at(point).map(|piece| piece as u32).collect();
        let shape = |piece: &Piece| {
            let closed = piece.contours.iter().filter(|contour| contour.closed);
            Shape::new(&closed.map(|contour| marker.list.points(contour.range)).collect::<Vec<_>>())
        };
        let shapes: Vec<Shape> = marker.pieces.par_iter().map(shape).collect();
        inside.part_of = nest::regions(&shapes, holders).into_iter().map(|part| part as usize).collect();
        inside
    }

    /// The part to which a piece belongs: itself, or the one of which it is a cut-out.
    pub(super) fn part_of(&self, piece: usize) -> usize {
        self.part_of[piece]
    }

    /// Column and row of a point; what lies outside belongs to the outermost.
    fn place(&self, point: Point) -> [usize; 2] {
        let away = point - self.extent.min;
        let counts = [self.columns, self.cells.len() / self.columns];
        std::array::from_fn(|i| ((away[i] / self.cell[i]).max(0.0) as usize).min(counts[i] - 1))
    }

    /// The parts whose cloth lies at a point: inside their outline, not inside a cut-out.
    pub(super) fn pieces_at(&self, point: Point) -> Vec<usize> {
        let mut odd: Vec<usize> = Vec::new();
        for part in self.rings_at(point).map(|piece| self.part_of[piece]) {
            match odd.iter().position(|&other| other == part) {
                Some(place) => drop(odd.swap_remove(place)),
                None => odd.push(part),
            }
        }
        odd.sort_unstable();
        odd
    }

    /// The pieces in whose own rings a point lies.
    fn rings_at(&self, point: Point) -> impl Iterator<Item = usize> + '_ {
        let [column, row] = self.place(point);
        let near = self.cells[row * self.columns + column].iter().map(|&part| &self.parts[part as usize]);
        near.filter(move |part| part.holds(point)).map(|part| part.piece)
    }
}

impl<'a> Part<'a> {
    /// The part that a piece is; `None` when it bounds nothing.
    fn new(index: usize, (piece, marker): (&Piece, &'a Marker)) -> Option<Self> {
        let closed = piece.contours.iter().filter(|contour| contour.closed);
        let rings: Box<[Cow<[Point]>]> = closed.map(|contour| marker.list.points(contour.range)).collect();
        let mut extent = Extent::EMPTY;
        rings.iter().flat_map(|ring| ring.iter()).for_each(|&point| extent.add(point));
        let count: usize = rings.iter().map(|ring| ring.len() - 1).sum();
        if count == 0 {
            return None;
        }
        let bands = (count / EDGES_A_BAND).max(1);
        let height = (extent.size().1 / bands as f64).max(f64::MIN_POSITIVE);
        let before = |sum: &mut u32, ring: &Cow<[Point]>| Some(std::mem::replace(sum, *sum + ring.len() as u32));
        let firsts = rings.iter().scan(0, before).collect();
        let mut starts = vec![0; bands + 1];
        let mut part = Self { piece: index, rings, firsts, extent, height, starts: Vec::new(), edges: Vec::new() };
        // How many each band has, then where it ends, and, as they are filled in from behind, where it begins.
        part.each(bands, |_, band| starts[band] += 1);
        for band in 1..=bands {
            starts[band] += starts[band - 1];
        }
        let mut edges = vec![0; starts[bands] as usize];
        part.each(bands, |edge, band| {
            starts[band] -= 1;
            edges[starts[band] as usize] = edge;
        });
        (part.starts, part.edges) = (starts, edges);
        Some(part)
    }

    /// Calls `see` for each edge with each band, of so many, that it reaches into.
    fn each(&self, bands: usize, mut see: impl FnMut(u32, usize)) {
        for (ring, &first) in self.rings.iter().zip(&self.firsts) {
            let mut before = self.band(ring[0].y, bands);
            for (edge, end) in (first..).zip(&ring[1..]) {
                let band = self.band(end.y, bands);
                (before.min(band)..=before.max(band)).for_each(|band| see(edge, band));
                before = band;
            }
        }
    }

    fn band(&self, y: f64, bands: usize) -> usize {
        (((y - self.extent.min.y) / self.height).max(0.0) as usize).min(bands - 1)
    }

    /// The ends of an edge.
    fn ends(&self, edge: u32) -> [Point; 2] {
        let ring = self.firsts.partition_point(|&first| first <= edge) - 1;
        let place = (edge - self.firsts[ring]) as usize;
        let [from, to] = self.rings[ring][place..place + 2] else { unreachable!("an edge has two ends") };
        [from, to]
    }

    /// Whether a ray to the right of a point crosses the edges an odd number of times.
    fn holds(&self, point: Point) -> bool {
        let Extent { min, max } = self.extent;
        if point.y < min.y || point.y > max.y || point.x < min.x || point.x > max.x {
            return false;
        }
        let is_crossed = |&&edge: &&u32| {
            let [from, to] = self.ends(edge);
            (from.y > point.y) != (to.y > point.y)
                && from.x + (to.x - from.x) * (point.y - from.y) / (to.y - from.y) > point.x
        };
        let band = self.band(point.y, self.starts.len() - 1);
        let edges = &self.edges[self.starts[band] as usize..self.starts[band + 1] as usize];
        edges.iter().filter(is_crossed).count() % 2 == 1
    }
}
