//! Laying: positions of the pieces on the cloth. A set of patterns is not a marker: pieces are laid in a row unless the file
//! places its blocks.

use std::ops::Range;

use super::chain::REACH;
use super::piece::Piece;
use super::shape::Insert;
use crate::geom::{Extent, Heading, Point, Vector};

/// Relative error of scales and axes by rounding: that of an angle with four decimals.
pub(super) const AXIS_EPSILON: f64 = 1e-5;

/// Map from the drawn piece to the cloth.
#[derive(Debug, Clone, Copy)]
pub(super) struct Motion {
    /// Images of the unit vectors of X and Y.
    x: Vector,
    y: Vector,
    offset: Vector,
}

/// A piece on the cloth.
#[derive(Debug, Clone, Copy)]
pub(super) struct Laid<'p> {
    pub(super) piece: &'p Piece,
    pub(super) motion: Motion,
}

/// Content of a block, or the content outside all blocks.
#[derive(Debug, Clone)]
pub(super) struct Drawn {
    /// Indices of its pieces in the set; most blocks have one.
    pub(super) pieces: Range<usize>,
    /// Number of copies as drawn and mirrored, if the file gives it.
    pub(super) quantity: Option<[u32; 2]>,
}

impl Drawn {
    /// Number of copies as drawn and mirrored; one as drawn by default.
    fn wanted(&self) -> [u32; 2] {
        self.quantity.unwrap_or([1, 0])
    }

    /// Total number of copies.
    pub(super) fn times(&self) -> usize {
        self.wanted().iter().map(|&count| count as usize).sum()
    }
}

impl Motion {
    /// Axes as drawn, and mirrored left to right.
    const DRAWN: [Vector; 2] = [Vector::new(1.0, 0.0), Vector::new(0.0, 1.0)];
    const MIRRORED: [Vector; 2] = [Vector::new(-1.0, 0.0), Vector::new(0.0, 1.0)];

    /// The identity.
    pub(super) const STILL: Self = Self { x: Self::DRAWN[0], y: Self::DRAWN[1], offset: Vector::new(0.0, 0.0) };

    /// Map of an insertion for a block with a base point: scale, rotation, translation (DXF reference, INSERT).
    pub(super) fn of_insert(insert: &Insert, base: Point) -> Self {
        let along = Heading::new(insert.turn).unit();
        let [x, y] = [along * insert.scale[0], Vector::new(-along.y, along.x) * insert.scale[1]];
        let offset = insert.at.coords - x * base.x - y * base.y;
        Self { x, y, offset }
    }

    /// True for the identity, within rounding.
    pub(super) fn is_still(&self) -> bool {
        let is_axis = |[found, drawn]: [Vector; 2]| (found - drawn).norm() <= AXIS_EPSILON;
        is_axis([self.x, Self::DRAWN[0]]) && is_axis([self.y, Self::DRAWN[1]]) && self.offset.norm() <= REACH
    }

    pub(super) fn place(&self, at: Point) -> Point {
        // Adding zero turns -0.0 into 0.0: both are the same position but have different bit patterns.
        Point::from(self.x * at.x + self.y * at.y + self.offset).map(|value| value + 0.0)
    }

    /// Maps a point of the cloth back to the drawn piece; valid for maps without scale.
    pub(super) fn back(&self, at: Point) -> Point {
        let way = at.coords - self.offset;
        Point::new(self.x.dot(&way), self.y.dot(&way))
    }

    pub(super) fn heading(&self, heading: Heading) -> Heading {
        let way = heading.unit();
        Heading::of(self.x * way.x + self.y * way.y)
    }
}

/// The bounding box of the cuts of some pieces, without notches, before translation.
fn extent(pieces: &[Piece], [x, y]: [Vector; 2]) -> Extent {
    let motion = Motion { x, y, offset: Vector::zeros() };
    let mut extent = Extent::EMPTY;
    let lines = pieces.iter().flat_map(|piece| std::iter::once(&piece.plain).chain(&piece.inner));
    lines.flat_map(|line| &line.vertices).for_each(|vertex| extent.add(motion.place(vertex.at)));
    extent
}

/// Lays the contents of blocks in a row along X with their lower edges on Y = 0, each as often as required, `gap` mm apart.
pub(super) fn in_a_row<'p>(pieces: &'p [Piece], drawn: &[Drawn], gap: f64) -> Vec<Laid<'p>> {
    let mut laid = Vec::new();
    let mut x = 0.0;
    for drawn in drawn.iter().filter(|drawn| !drawn.pieces.is_empty()) {
        let pieces = &pieces[drawn.pieces.clone()];
        for (axes, count) in [Motion::DRAWN, Motion::MIRRORED].into_iter().zip(drawn.wanted()) {
            let extent = extent(pieces, axes);
            for _ in 0..count {
                if extent.is_empty() {
                    laid.extend(pieces.iter().map(|piece| Laid { piece, motion: Motion::STILL })); // it is not cut
                    continue;
                }
                let offset = Vector::new(x, 0.0) - extent.min.coords;
                let motion = Motion { x: axes[0], y: axes[1], offset };
                laid.extend(pieces.iter().map(|piece| Laid { piece, motion }));
                x += extent.size().0 + gap;
            }
        }
    }
    laid
}
