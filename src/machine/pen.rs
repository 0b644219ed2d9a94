//! Pens of plotters and layers of drawings: uses of their lines.

use serde::{Deserialize, Serialize};

/// Use of a pen or a layer.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum PenUse {
    /// Knife: its lines are cut.
    Knife,
    /// Pen: its lines are drawn, not cut.
    Pen,
    /// Ignored lines.
    Ignore,
}
