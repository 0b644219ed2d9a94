//! Second readings of drawings, a row a dialect, and whether the right lines of one are cut.
//!
//! The census knows nothing of what is cut: a marker of a drawing keeps account of what it leaves aside, and both together
//! must be what is drawn. Holes are deduced from shapes, so their number is not in the bytes. `outermost` judges by the same
//! strokes whether the right lines are cut: `around` whether others go around these, `cloth` whether the edge of the cloth is
//! cut, whose rectangles `rectangle` finds, `slits` whether slits are lost.

mod around;
mod cloth;
mod outermost;
mod rectangle;
mod slits;

use std::collections::BTreeSet;

pub use self::outermost::{DrawingCuts, drawing_audit};
use super::census::{Census, Slack};
use super::dxf::plain;
use super::hpgl;
use crate::geom::Point;
use crate::machine::{Job, MachineProfile, layers};

/// Second reading of a dialect that says what is drawn, by other means than the reader's.
pub(super) struct Second {
    /// Name of the dialect.
    dialect: &'static str,
    /// Counts what is drawn.
    pub(super) census: fn(&[u8], &MachineProfile) -> (Census, Slack),
    /// Gathers what is drawn.
    pub(super) strokes: fn(&[u8], &MachineProfile) -> Drawn,
}

/// Strokes of a drawing.
pub(super) struct Drawn {
    /// Places between two lifts, mm.
    pub(super) strokes: Vec<Vec<Point>>,
    /// What the numbers of the file are multiples of, mm; 0 when they are not rounded.
    pub(super) unit: f64,
    /// Names of the layers that draw; none of a plot, which has pens.
    pub(super) layers: BTreeSet<String>,
}

impl Drawn {
    /// Whether anybody says of pens or layers what their lines are: then shapes do not tell what is cut.
    pub(super) fn is_said(&self, job: &Job) -> bool {
        let layers: Vec<&str> = self.layers.iter().map(String::as_str).collect();
        let uses = layers::uses(&layers, job.lines.layers.as_ref(), &job.profile.drawing.layers);
        job.lines.pens.is_some() || !job.profile.hpgl.pens.is_empty() || uses.iter().any(Option::is_some)
    }
}

const SECONDS: &[Second] = &[
    Second { dialect: "hpgl", census: hpgl::scan, strokes: hpgl::drawn },
    Second { dialect: "dxf", census: plain::scan, strokes: plain::drawn },
];

/// The second reading of the dialect of that name; `None` of one that says what is cut.
pub(super) fn second(dialect: &str) -> Option<&'static Second> {
    SECONDS.iter().find(|second| second.dialect == dialect)
}
