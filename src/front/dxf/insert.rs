//! Insertions: a block is drawn wherever it is put, and what it inserts itself there, too.

use super::entity::{Block, Entity, NAME};
use super::lower::{Lowering, Within, X, Y, on_plane, place};
use crate::diagnostic::{Diagnostic, code};
use crate::geom::affine::Affine;
use crate::geom::{Point, Vector};
use crate::units::rad;

/// Codes of the scale along each axis, the turn, the counts of columns and rows, and their distances.
const SCALE: [i32; 2] = [41, 42];
const ANGLE: i32 = 50;
const COUNTS: [i32; 2] = [70, 71];
const STEPS: [i32; 2] = [44, 45];

/// Insertions around an insertion: CAD systems nest a few, and one that holds itself has no end.
const DEEPEST: usize = 32;
/// Insertions that are followed, those of rows and columns each.
pub(super) const MOST_INSERTS: usize = 1_000_000;

impl<'a> Lowering<'a, '_> {
    /// Draws the block that an insertion names, once for each of its columns and rows.
    pub(super) fn insert(&mut self, entity: &Entity<'a>, within: &Within<'a>) -> Result<(), Diagnostic> {
        let name = entity.bytes(NAME).to_ascii_uppercase();
        let Some(&block) = self.blocks.get(&name) else {
            self.told.unnamed(entity);
            return Ok(());
        };
        if within.depth == DEEPEST {
            self.is_full = true;
            let shown = name.escape_ascii();
            let message = format!("the block `{shown}` is inserted {DEEPEST} blocks deep: it may hold itself");
            let finding = Diagnostic::new(&code::DXF_RECURSION, message).at(entity.span());
            return Err(finding.hint("explode its insertions in the CAD system"));
        }
        let placing = Placing::of(entity)?;
        let plane = on_plane(entity, within)?;
        let base = base(block)?;
        let layer = Some(self.layer_of(entity, within));
        for row in 0..placing.counts[1] {
            for column in 0..placing.counts[0] {
                let Some(left) = self.inserts_left.checked_sub(1) else {
                    return Err(self.full(entity.span()));
                };
                self.inserts_left = left;
                let map = placing.map(base, [column as f64, row as f64]).then(&plane);
                self.entities(&block.entities, &Within { map, layer, depth: within.depth + 1 });
                if self.is_full {
                    return Ok(());
                }
            }
        }
        Ok(())
    }
}

/// The base point of a block; the origin where the file names none.
fn base(block: &Block) -> Result<Point, Diagnostic> {
    let is_named = [X, Y].iter().any(|&code| block.head.value(code).is_some());
    if is_named { place(&block.head, [X, Y]) } else { Ok(Point::origin()) }
}

/// Where an insertion puts its block.
struct Placing {
    at: Point,
    scale: [f64; 2],
    /// rad.
    turn: f64,
    /// Columns and rows, and their distances.
    counts: [usize; 2],
    steps: [f64; 2],
}

impl Placing {
    fn of(entity: &Entity) -> Result<Self, Diagnostic> {
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

    /// The map of a block with that base point to the plane of the insertion, in a column and a row.
    fn map(&self, base: Point, [column, row]: [f64; 2]) -> Affine {
        let step = Vector::new(column * self.steps[0], row * self.steps[1]);
        Affine::shift(-base.coords)
            .then(&Affine::scale(self.scale[0], self.scale[1]))
            .then(&Affine::shift(step))
            .then(&Affine::turn(self.turn))
            .then(&Affine::shift(self.at.coords))
    }
}
