//! Second readings of drawings, a row a dialect, and whether the right lines of one are cut.
//!
//! The census knows nothing of what is cut: a marker of a drawing keeps account of what it leaves aside, and both together
//! must be what is drawn. Holes are deduced from shapes, so their number is not in the bytes. `outermost` judges by the same
//! strokes whether the right lines are cut: `around` whether others go around these, `cloth` whether the edge of the cloth is
//! cut, whose rectangles `rectangle` finds, `slits` whether slits are lost.

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

/// Second reading of a dialect that says what is drawn, by other means than the reader's.
pub(super) struct Second {
    /// Name of the dialect.
    dialect: &'static str,
    /// Counts what is drawn.
    pub(super) census: fn(&[u8], &MachineProfile) -> (Census, Slack),
    /// Gathers what is drawn.
    pub(super) strokes: fn(&[u8], &MachineProfile) -> Drawn,
}

const SECONDS: &[Second] = &[
    Second { dialect: "hpgl", census: hpgl::scan, strokes: hpgl::drawn },
    Second { dialect: "dxf", census: plain::scan, strokes: plain::drawn },
    Second { dialect: "svg", census: svg::scan, strokes: svg::drawn },
];

/// The second reading of the dialect of that name; `None` of one that says what is cut.
pub(super) fn second(dialect: &str) -> Option<&'static Second> {
    SECONDS.iter().find(|second| second.dialect == dialect)
}
