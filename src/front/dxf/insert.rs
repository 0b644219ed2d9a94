//! Insertions: position, rotation and repetition of blocks.

use super::entity::{Block, Entity, X, Y, place};
use crate::diagnostic::Diagnostic;
use crate::geom::affine::Affine;
use crate::geom::{Point, Vector};
use crate::units::rad;

/// Codes of the scale along each axis, the rotation, the numbers of columns and rows, and their spacings.
const SCALE: [i32; 2] = [41, 42];
const ANGLE: i32 = 50;
const COUNTS: [i32; 2] = [70, 71];
const STEPS: [i32; 2] = [44, 45];

/// Base point of a block; the origin if the file gives none.
pub(super) fn base(block: &Block) -> Result<Point, Diagnostic> {
    let is_named = [X, Y].iter().any(|&code| block.head.value(code).is_some());
    if is_named { place(&block.head, [X, Y]) } else { Ok(Point::origin()) }
}

/// Placement of the block of an insertion.
#[derive(Debug)]
pub(super) struct Placing {
    at: Point,
    scale: [f64; 2],
    /// Rotation, rad.
    turn: f64,
    /// Numbers of columns and rows, and their spacings.
    pub(super) counts: [usize; 2],
    steps: [f64; 2],
}

impl Placing {
    pub(super) fn of(entity: &Entity) -> Result<Self, Diagnostic> {
        let number = |code, usual: f64| Ok::<f64, Diagnostic>(entity.number(code)?.unwrap_or(usual));
        let count = |code| {
            let count = entity.whole(code)?.unwrap_or(1).max(1);
            Ok::<usize, Diagnostic>(usize::try_from(count).unwrap_or(usize::MAX))
        };
        Ok(Self {
            at: place(entity, [X, Y])?,
            scale: [number(SCALE[0], 1.0)?, number(SCALE[1], 1.0)?],
            turn: rad(number(ANGLE, 0.0)?),
            counts: [count(COUNTS[0])?, count(COUNTS[1])?],
            steps: [number(STEPS[0], 0.0)?, number(STEPS[1], 0.0)?],
        })
    }

    /// Map of the block to the plane of the insertion, for a base point, a column and a row.
    pub(super) fn map(&self, base: Point, [column, row]: [f64; 2]) -> Affine {
        let step = Vector::new(column * self.steps[0], row * self.steps[1]);
        Affine::shift(-base.coords)
            .then(&Affine::scale(self.scale[0], self.scale[1]))
            .then(&Affine::shift(step))
            .then(&Affine::turn(self.turn))
            .then(&Affine::shift(self.at.coords))
    }
}
