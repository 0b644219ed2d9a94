//! Laying: where the pieces lie on the cloth. A set of patterns is no marker: they lie in a row, unless the file itself
//! puts its blocks somewhere.

use std::ops::Range;

use super::chain::REACH;
use super::piece::Piece;
use super::shape::Insert;
use crate::geom::{Extent, Heading, Point, Vector};

/// How much rounding turns or scales, as a part: of an angle that is written with four decimals.
pub(super) const AXIS_EPSILON: f64 = 1e-5;

/// How a piece is moved from where its block draws it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Motion {
    /// Where the unit vectors of X and Y go.
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

/// What a block draws, or what stands in none.
#[derive(Debug, Clone)]
pub(super) struct Drawn {
    /// Its pieces among those of the set; most blocks have one.
    pub(super) pieces: Range<usize>,
    /// How often they are cut as they are drawn, and how often mirrored, where the file says so.
    pub(super) quantity: Option<[u32; 2]>,
}

impl Drawn {
    /// How often they are wanted as they are drawn, and how often mirrored: once where the file says nothing.
    fn wanted(&self) -> [u32; 2] {
        self.quantity.unwrap_or([1, 0])
    }

    /// How often they are wanted in all.
    pub(super) fn times(&self) -> usize {
        self.wanted().iter().map(|&count| count as usize).sum()
    }
}

impl Motion {
    /// As drawn, or mirrored from right to left.
    const DRAWN: [Vector; 2] = [Vector::new(1.0, 0.0), Vector::new(0.0, 1.0)];
    const MIRRORED: [Vector; 2] = [Vector::new(-1.0, 0.0), Vector::new(0.0, 1.0)];

    /// Where it is drawn.
    pub(super) const STILL: Self = Self { x: Self::DRAWN[0], y: Self::DRAWN[1], offset: Vector::new(0.0, 0.0) };

    /// Where an insertion puts a block that is drawn about its base point: scaled, turned, moved (DXF reference, INSERT).
    pub(super) fn of_insert(insert: &Insert, base: Point) -> Self {
        let along = Heading::new(insert.turn).unit();
        let [x, y] = [along * insert.scale[0], Vector::new(-along.y, along.x) * insert.scale[1]];
        let offset = insert.at.coords - x * base.x - y * base.y;
        Self { x, y, offset }
    }

    /// Whether it leaves everything where it is drawn, but for rounding.
    pub(super) fn is_still(&self) -> bool {
        let is_axis = |[found, drawn]: [Vector; 2]| (found - drawn).norm() <= AXIS_EPSILON;
        is_axis([self.x, Self::DRAWN[0]]) && is_axis([self.y, Self::DRAWN[1]]) && self.offset.norm() <= REACH
    }

    pub(super) fn place(&self, at: Point) -> Point {
        // The negative of zero is another bit pattern than zero, though the same place.
        Point::from(self.x * at.x + self.y * at.y + self.offset).map(|value| value + 0.0)
    }

    /// Where a place of the cloth is as the piece is drawn; nothing is scaled.
    pub(super) fn back(&self, at: Point) -> Point {
        let way = at.coords - self.offset;
        Point::new(self.x.dot(&way), self.y.dot(&way))
    }

    pub(super) fn heading(&self, heading: Heading) -> Heading {
        let way = heading.unit();
        Heading::of(self.x * way.x + self.y * way.y)
    }
}

/// The box around all that is cut of some pieces, but for notches, before it lies anywhere.
fn extent(pieces: &[Piece], [x, y]: [Vector; 2]) -> Extent {
    let motion = Motion { x, y, offset: Vector::zeros() };
    let mut extent = Extent::EMPTY;
    let lines = pieces.iter().flat_map(|piece| std::iter::once(&piece.plain).chain(&piece.inner));
    lines.flat_map(|line| &line.vertices).for_each(|vertex| extent.add(motion.place(vertex.at)));
    extent
}

/// Lays what blocks draw in a row along X, the lower edges on Y = 0, as often as each is wanted, so much room between them,
/// mm.
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
