//! The table: the keys `table.*`.

use serde::{Deserialize, Serialize};

use super::key::{Key, Takes};
use super::word::{OrWord, Unlimited, Word as _};

/// The keys `table.*`.
#[rustfmt::skip] // a table: one row a key
pub(super) const KEYS: &[Key] = &[
    Key { name: "table.x_mm", takes: Takes::RangeOr(Unlimited::WORD), about: "Where the table begins and ends along X." },
    Key { name: "table.y_mm", takes: Takes::RangeOr(Unlimited::WORD), about: "Where the table begins and ends along Y." },
];

/// The table.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Table {
    /// Its ends along X.
    #[serde(with = "OrWord::<Unlimited>")]
    pub x_mm: Option<[f64; 2]>,
    /// Its ends along Y.
    #[serde(with = "OrWord::<Unlimited>")]
    pub y_mm: Option<[f64; 2]>,
}

impl Table {
    /// A program that leaves the table by more is refused, mm: a hand puts a marker down no better than that.
    pub const EDGE_MM: f64 = 1.0;

    /// How far a place lies off the table, mm; not above 0 on it.
    pub fn off(&self, place: [f64; 2]) -> f64 {
        let beyond = |value: f64, range: Option<[f64; 2]>| {
            range.map_or(f64::NEG_INFINITY, |[least, most]| (least - value).max(value - most))
        };
        beyond(place[0], self.x_mm).max(beyond(place[1], self.y_mm))
    }
}
