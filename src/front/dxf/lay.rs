//! Laying: where the pieces lie on the cloth. A set of patterns is no marker: they lie in a row, unless the file itself
//! puts its blocks somewhere.

use super::piece::Piece;
use super::shape::Insert;
use crate::geom::{Extent, Heading, Point, Vector};

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

    pub(super) fn place(&self, at: Point) -> Point {
        // The negative of zero is another bit pattern than zero, though the same place.
        Point::from(self.x * at.x + self.y * at.y + self.offset).map(|value| value + 0.0)
    }

    pub(super) fn heading(&self, heading: Heading) -> Heading {
        let way = heading.unit();
        Heading::of(self.x * way.x + self.y * way.y)
    }
}

/// The box around all that is cut of a piece, before it lies anywhere.
fn extent(piece: &Piece, [x, y]: [Vector; 2]) -> Extent {
    let motion = Motion { x, y, offset: Vector::zeros() };
    let mut extent = Extent::EMPTY;
    let lines = std::iter::once(&piece.outline).chain(&piece.inner);
    lines.flat_map(|line| &line.vertices).for_each(|vertex| extent.add(motion.place(vertex.at)));
    extent
}

/// Lays pieces in a row along X, as often as each is wanted, so much room between them, mm.
pub(super) fn in_a_row(pieces: &[Piece], gap: f64) -> Vec<Laid<'_>> {
    let mut laid = Vec::new();
    let mut x = 0.0;
    for piece in pieces {
        let ways = [Motion::DRAWN, Motion::MIRRORED];
        for (axes, count) in ways.into_iter().zip(piece.quantity) {
            let extent = extent(piece, axes);
            for _ in 0..count {
                let offset = Vector::new(x, 0.0) - extent.min.coords;
                laid.push(Laid { piece, motion: Motion { x: axes[0], y: axes[1], offset } });
                x += extent.size().0 + gap;
            }
        }
    }
    laid
}
