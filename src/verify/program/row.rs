//! A row: where the axes stand at a tick and what is commanded, whatever the program is written as.

use crate::geom::{Point, Vector};
use crate::ir::verdict::Sighting;

/// The line of the first row of a text: lines count from 1, the first is the header.
pub(in crate::verify) const FIRST_LINE: u64 = 2;
/// Half of the last decimal of positions, mm and degrees: by so much a value may differ from what was meant.
pub(in crate::verify) const ROUNDING: f64 = 0.5e-6;
/// Rounding of a place that is computed from a row, mm.
pub(in crate::verify) const PLACE_ROUNDING: f64 = 4.0 * ROUNDING;
/// Half of the last decimal of the time, s.
pub(in crate::verify) const TIME_ROUNDING: f64 = 0.5e-6;
/// Farthest that a straight step may leave an arc that is walked in steps, mm: a tenth of the least tolerance of a path.
pub(in crate::verify) const SAGITTA: f64 = 5e-3;

/// One setpoint.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::verify) struct Row {
    /// Its place among the rows, from 0.
    pub(in crate::verify) tick: u64,
    /// Time, s.
    pub(in crate::verify) t: f64,
    /// The C axis over the table, mm.
    pub(in crate::verify) centre: Point,
    /// Position of C, degrees.
    pub(in crate::verify) c_deg: f64,
    /// Whether the knife is commanded down.
    pub(in crate::verify) knife: bool,
    /// The drill that is commanded, 0 = none.
    pub(in crate::verify) drill: u8,
    /// The event that is told, 0 = none.
    pub(in crate::verify) event: u8,
    /// The source block, 0 = none.
    pub(in crate::verify) block: u32,
    /// Way of the cloth so far, mm.
    pub(in crate::verify) station: u32,
    /// Its line in the program, the first being 1, or its record, from 0, where there are no lines.
    pub(in crate::verify) line: u64,
}

impl Row {
    /// The row with its place on the cloth instead of the table.
    pub(in crate::verify) fn on_cloth(&self) -> Self {
        Self { centre: self.centre + self.moved_on(), station: 0, ..*self }
    }

    /// The way of the cloth so far, mm.
    pub(in crate::verify) fn moved_on(&self) -> Vector {
        Vector::new(f64::from(self.station), 0.0)
    }

    /// Unit vector from heel to tip.
    pub(in crate::verify) fn along(&self) -> Vector {
        let (sin, cos) = self.c_deg.to_radians().sin_cos();
        Vector::new(cos, sin)
    }

    /// A place that is seen at the row.
    pub(in crate::verify) fn seen_at(&self, point: Point) -> Sighting {
        Sighting { line: Some(self.line), ..Sighting::at(self.t, point, self.block) }
    }

    /// The row as a place of the cloth.
    pub(in crate::verify) fn sighting(&self) -> Sighting {
        self.seen_at(self.centre + self.moved_on())
    }
}

/// How the axes move at a row, where that is told: what F asks for.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(in crate::verify) struct Going {
    /// Of the C axis over the table, mm/s.
    pub(in crate::verify) way: Vector,
    /// Of C itself, rad/s.
    pub(in crate::verify) turn: f64,
    /// The greatest share of a limit of the axes that this uses.
    pub(in crate::verify) used: f64,
}

/// By how much the numbers of rows may differ from what was meant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::verify) struct Rounding {
    /// Of X, Y (mm) and C (degrees).
    pub(in crate::verify) axes: [f64; 3],
}

impl Rounding {
    /// Of an axis, whichever is coarsest.
    pub(in crate::verify) fn axis(self) -> f64 {
        self.axes.into_iter().fold(0.0, f64::max)
    }

    /// Of a place that is computed from a row, mm: the tip's, from the axes and the turn of the blade.
    pub(in crate::verify) fn place(self) -> f64 {
        4.0 * self.axis()
    }
}
