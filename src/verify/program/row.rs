//! Row of a program in any format: position of the axes at a tick and commanded outputs.

use crate::geom::{Point, Vector};
use crate::ir::verdict::Sighting;

/// Line number of the first row of a text: lines count from 1, and line 1 is the header.
pub(in crate::verify) const FIRST_LINE: u64 = 2;
/// Half of the last decimal of positions, mm and degrees: the greatest difference from the intended value.
pub(in crate::verify) const ROUNDING: f64 = 0.5e-6;
/// Rounding error of a place computed from a row, mm.
pub(in crate::verify) const PLACE_ROUNDING: f64 = 4.0 * ROUNDING;
/// Half of the last decimal of the time, s.
pub(in crate::verify) const TIME_ROUNDING: f64 = 0.5e-6;
/// Greatest distance of a straight step from the arc that it approximates, mm: a tenth of the smallest path tolerance.
pub(in crate::verify) const SAGITTA: f64 = 5e-3;

/// Setpoint.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::verify) struct Row {
    /// Index of the row, from 0.
    pub(in crate::verify) tick: u64,
    /// Time, s.
    pub(in crate::verify) t: f64,
    /// C axis over the table, mm.
    pub(in crate::verify) centre: Point,
    /// Position of C, degrees.
    pub(in crate::verify) c_deg: f64,
    /// True if the knife is commanded down.
    pub(in crate::verify) knife: bool,
    /// Commanded drill, 0 = none.
    pub(in crate::verify) drill: u8,
    /// Event, 0 = none.
    pub(in crate::verify) event: u8,
    /// Source block, 0 = none.
    pub(in crate::verify) block: u32,
    /// Advance of the cloth so far, mm.
    pub(in crate::verify) station: u32,
    /// Line in the program, from 1, or record, from 0, in formats without lines.
    pub(in crate::verify) line: u64,
}

impl Row {
    /// Row with its place in cloth coordinates instead of table coordinates.
    pub(in crate::verify) fn on_cloth(mut self) -> Self {
        self.centre += self.moved_on();
        self.station = 0;
        self
    }

    /// Advance of the cloth so far, mm.
    pub(in crate::verify) fn moved_on(&self) -> Vector {
        Vector::new(f64::from(self.station), 0.0)
    }

    /// Unit vector from heel to tip.
    pub(in crate::verify) fn along(&self) -> Vector {
        let (sin, cos) = self.c_deg.to_radians().sin_cos();
        Vector::new(cos, sin)
    }

    /// Sighting of a point at the row.
    pub(in crate::verify) fn seen_at(&self, point: Point) -> Sighting {
        Sighting { line: Some(self.line), ..Sighting::at(self.t, point, self.block) }
    }

    /// Sighting of the row itself, in cloth coordinates.
    pub(in crate::verify) fn sighting(&self) -> Sighting {
        self.seen_at(self.centre + self.moved_on())
    }
}

/// Motion of the axes at a row as F commands it; zero where the format has none.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(in crate::verify) struct Going {
    /// Velocity of the C axis over the table, mm/s.
    pub(in crate::verify) way: Vector,
    /// Angular velocity of C, rad/s.
    pub(in crate::verify) turn: f64,
    /// Greatest share of an axis limit that the motion uses.
    pub(in crate::verify) used: f64,
}

/// Greatest difference between the numbers of rows and the intended values.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::verify) struct Rounding {
    /// Rounding of X, Y (mm) and C (degrees).
    pub(in crate::verify) axes: [f64; 3],
}

impl Rounding {
    /// Rounding of the coarsest axis.
    pub(in crate::verify) fn axis(self) -> f64 {
        self.axes.into_iter().fold(0.0, f64::max)
    }

    /// Rounding of a place computed from a row, mm: the tip, from the axes and the direction of the blade.
    pub(in crate::verify) fn place(self) -> f64 {
        4.0 * self.axis()
    }
}
