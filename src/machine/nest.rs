//! Distances between parts in a nest: the keys `nest.*`.

use serde::{Deserialize, Serialize};

use super::key::{Key, Takes, from};
use super::word::{Auto, Off, OrWord, Word as _};

/// The keys `nest.*`.
#[rustfmt::skip] // a table: one row a key
pub(super) const KEYS: &[Key] = &[
    Key { name: "nest.band_mm", takes: Takes::NumberOr(from(0.01, 1.0), Auto::WORD), about: "Edges of two parts that are nearer to each other than this are one edge: a way along it\nenters neither. \"auto\" = 0.2 mm, or a diagonal of the unit of the file if that is more.\nIn a strip it is a quarter of its width at the most." },
    Key { name: "nest.overlap_mm", takes: Takes::NumberOr(from(0.0, 1000.0), Off::WORD), about: "How deep two parts may lie over each other; deeper, or where a quarter of the smaller one lies in\nthe other, the file is refused. \"off\" = both are cut all the same, with a warning." },
];

/// Distances between parts in a nest.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Nest {
    /// Band as given; [`MachineProfile::band`](super::MachineProfile::band) is the effective one.
    #[serde(with = "OrWord::<Auto>")]
    pub band_mm: Option<f64>,
    /// Greatest depth of an overlap of two parts, mm; `None` if any overlap is cut.
    #[serde(with = "OrWord::<Off>")]
    pub overlap_mm: Option<f64>,
}

impl Default for Nest {
    fn default() -> Self {
        Self { band_mm: None, overlap_mm: Some(5.0) }
    }
}
