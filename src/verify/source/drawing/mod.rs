//! Second readings of drawings, one per dialect, and the check that the right lines are cut.
//!
//! The census does not know which lines are cut: the marker of a drawing keeps account of the lines left aside, and both
//! together must equal the drawing. Holes are deduced from shapes, so their number is not in the bytes. `outermost` verifies
//! from the same strokes that the right lines are cut: `around` checks that no others surround them, `cloth` that the edge of
//! the cloth is not cut, `rectangle` finds such edges, and `slits` checks that no slits are lost.

mod around;
mod cloth;
pub(super) mod drawn;
mod outermost;
mod rectangle;
mod slits;

use self::drawn::Drawn;
pub use self::outermost::{DrawingCuts, drawing_audit};
use super::census::{Census, Slack};
use super::dxf::plain;
use super::{hpgl, svg};
use crate::machine::MachineProfile;

/// Second reading of a dialect, by other means than the reader's.
pub(super) struct Second {
    /// Name of the dialect.
    dialect: &'static str,
    /// Computes statistics of the drawing.
    pub(super) census: fn(&[u8], &MachineProfile) -> (Census, Slack),
    /// Collects the strokes of the drawing.
    pub(super) strokes: fn(&[u8], &MachineProfile) -> Drawn,
}

const SECONDS: &[Second] = &[
    Second { dialect: "hpgl", census: hpgl::scan, strokes: hpgl::drawn },
    Second { dialect: "dxf", census: plain::scan, strokes: plain::drawn },
    Second { dialect: "svg", census: svg::scan, strokes: svg::drawn },
];

/// Second reading of a dialect; `None` for a dialect that states what is cut.
pub(super) fn second(dialect: &str) -> Option<&'static Second> {
    SECONDS.iter().find(|second| second.dialect == dialect)
}
