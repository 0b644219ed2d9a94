//! Encoders of the drives, which the target `counts` addresses: the keys `counts.*`.

use serde::{Deserialize, Serialize};

use super::key::{Key, Takes, Within, from};

/// Encoder counts per mm or degree.
const COUNTS: Within = from(1.0, 1.0e7);
/// Range of a 32-bit register, counts.
const REGISTER: Within = from(i32::MIN as f64, i32::MAX as f64);

/// The keys `counts.*`.
#[rustfmt::skip] // a table: one row a key
pub(super) const KEYS: &[Key] = &[
    Key { name: "counts.x.per_mm", takes: Takes::Number(COUNTS), about: "Target counts: encoder counts of a millimetre along the table." },
    Key { name: "counts.x.offset", takes: Takes::Number(REGISTER), about: "Target counts: what the encoder shows at X 0." },
    Key { name: "counts.y.per_mm", takes: Takes::Number(COUNTS), about: "Target counts: encoder counts of a millimetre across the table." },
    Key { name: "counts.y.offset", takes: Takes::Number(REGISTER), about: "Target counts: what the encoder shows at Y 0." },
    Key { name: "counts.c.per_deg", takes: Takes::Number(COUNTS), about: "Target counts: encoder counts of a degree of the blade's turn." },
    Key { name: "counts.c.offset", takes: Takes::Number(REGISTER), about: "Target counts: what the encoder shows at C 0 of the controller." },
];

/// Encoders of the drives, for the target `counts`.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Counts {
    /// Axis along the table.
    pub x: LinearCounts,
    /// Axis across the table.
    pub y: LinearCounts,
    /// Axis that turns the blade.
    pub c: RotaryCounts,
}

/// Encoder of a linear axis.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct LinearCounts {
    /// Counts per mm.
    pub per_mm: f64,
    /// Counts at position 0.
    pub offset: f64,
}

/// Encoder of the rotary axis.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct RotaryCounts {
    /// Counts per degree.
    pub per_deg: f64,
    /// Counts at position 0 of the controller.
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
