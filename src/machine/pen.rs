//! Pens of plotters and layers of drawings: what their lines stand for.

use serde::{Deserialize, Serialize};

/// Use of a pen or a layer.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum PenUse {
    /// The knife: its lines are cut.
    Knife,
    /// A pen: its lines are drawn, not cut.
    Pen,
    /// Its lines do not matter.
    Ignore,
}
