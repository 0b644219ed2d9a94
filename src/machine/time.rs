//! Clock of the controller: the keys `time.*`.

use serde::{Deserialize, Serialize};

use super::key::{Key, Takes, from};
use crate::units::MS_PER_S;

/// The keys `time.*`.
#[rustfmt::skip] // a table: one row a key
pub(super) const KEYS: &[Key] = &[
    Key { name: "time.period_ms", takes: Takes::Number(from(0.1, 100.0)), about: "Time between two setpoints: the cycle of the controller." },
];

/// Clock of the controller.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Time {
    /// Time between two setpoints.
    pub period_ms: f64,
}

impl Time {
    /// Time between two setpoints, s.
    pub fn period(&self) -> f64 {
        self.period_ms / MS_PER_S
    }
}

impl Default for Time {
    fn default() -> Self {
        Self { period_ms: 1.0 }
    }
}
