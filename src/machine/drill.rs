//! Drill beside the knife: the keys `drill.*`.

use serde::{Deserialize, Serialize};

use super::key::{Key, REST, Takes};
use crate::units::MS_PER_S;

/// The keys `drill.*`.
#[rustfmt::skip] // a table: one row a key
pub(super) const KEYS: &[Key] = &[
    Key { name: "drill.dwell_ms", takes: Takes::Number(REST), about: "Time for one drill hole; the axes rest." },
    Key { name: "drill.offset_mm", takes: Takes::Point, about: "Where the drill stands, seen from the C axis." },
];

/// Drill beside the knife.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Drill {
    /// Time per hole.
    pub dwell_ms: f64,
    /// Position relative to the C axis.
    pub offset_mm: [f64; 2],
}

impl Drill {
    /// Time per hole, s.
    pub fn dwell(&self) -> f64 {
        self.dwell_ms / MS_PER_S
    }
}

impl Default for Drill {
    fn default() -> Self {
        Self { dwell_ms: 300.0, offset_mm: [0.0, 0.0] }
    }
}
