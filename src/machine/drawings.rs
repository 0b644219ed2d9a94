//! Drawings, whatever their dialect: the keys `drawing.*`.

use serde::{Deserialize, Serialize};

use super::key::{Key, Takes, from};

/// Widest gap that `drawing.close_mm` may close, mm: outlines stop before their start by less, other lines by more.
pub const CLOSE_MOST_MM: f64 = 10.0;

/// The keys `drawing.*`.
#[rustfmt::skip] // a table: one row a key
pub(super) const KEYS: &[Key] = &[
    Key { name: "drawing.close_mm", takes: Takes::Number(from(0.0, CLOSE_MOST_MM)), about: "Outlines of a plot whose ends are this far apart at the most are closed, and so are those\nwhose ends lie this near to the edge of the frame. 0 = only rounding is closed." },
];

/// How drawings are read.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Drawings {
    /// Widest gap of an outline that is closed, mm.
    pub close_mm: f64,
}

impl Default for Drawings {
    fn default() -> Self {
        Self { close_mm: 1.5 }
    }
}
