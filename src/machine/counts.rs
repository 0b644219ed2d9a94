//! The encoders of the drives, which the target `counts` addresses: the keys `counts.*`.

use serde::{Deserialize, Serialize};

/// The encoders of the drives, for the target `counts`.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Counts {
    /// Along the table.
    pub x: LinearCounts,
    /// Across the table.
    pub y: LinearCounts,
    /// The blade's turn.
    pub c: RotaryCounts,
}

/// The encoder of a linear axis.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct LinearCounts {
    /// Counts per mm.
    pub per_mm: f64,
    /// Counts at 0 mm.
    pub offset: f64,
}

/// The encoder of the rotary axis.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct RotaryCounts {
    /// Counts per degree.
    pub per_deg: f64,
    /// Counts at 0 degrees of the controller.
    pub offset: f64,
}

impl Default for LinearCounts {
    fn default() -> Self {
        Self { per_mm: 10_000.0, offset: 0.0 }
    }
}

impl Default for RotaryCounts {
    fn default() -> Self {
        Self { per_deg: 10_000.0, offset: 0.0 }
    }
}
