//! Table of the cutter: the keys `table.*`.

use serde::{Deserialize, Serialize};

use super::key::{Key, Takes};
use super::word::{OrWord, Unlimited, Word as _};

/// The keys `table.*`.
#[rustfmt::skip] // a table: one row a key
pub(super) const KEYS: &[Key] = &[
    Key { name: "table.x_mm", takes: Takes::RangeOr(Unlimited::WORD), about: "Where the table begins and ends along X." },
    Key { name: "table.y_mm", takes: Takes::RangeOr(Unlimited::WORD), about: "Where the table begins and ends along Y." },
];

/// Table of the cutter.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Table {
    /// Ends along X; `None` = unlimited.
    #[serde(with = "OrWord::<Unlimited>")]
    pub x_mm: Option<[f64; 2]>,
    /// Ends along Y; `None` = unlimited.
    #[serde(with = "OrWord::<Unlimited>")]
    pub y_mm: Option<[f64; 2]>,
}

impl Table {
    /// Distance by which a program may leave the table, mm: a marker is placed by hand with no better accuracy.
    pub const EDGE_MM: f64 = 1.0;

    /// Distance of a place from the table, mm; zero or negative on it.
    pub fn off(&self, place: [f64; 2]) -> f64 {
        let beyond = |value: f64, range: Option<[f64; 2]>| {
            range.map_or(f64::NEG_INFINITY, |[least, most]| (least - value).max(value - most))
        };
        beyond(place[0], self.x_mm).max(beyond(place[1], self.y_mm))
    }
}
