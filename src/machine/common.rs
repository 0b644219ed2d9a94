//! Edges that two parts have in common: the keys `common.*`.

use serde::{Deserialize, Serialize};

use super::key::{Key, Takes, from};
use super::word::words;

/// The keys `common.*`.
#[rustfmt::skip] // a table: one row a key
pub(super) const KEYS: &[Key] = &[
    Key { name: "common.lines", takes: Takes::NumberOrWord(from(0.01, 1.0), words::<CommonLines>), about: "Edges of two parts that run this near to each other are cut once, along the part that is cut\nfirst; \"auto\" = the band (nest.band_mm), \"off\" = each part is cut all round." },
    Key { name: "common.min_mm", takes: Takes::Number(from(1.0, 1000.0)), about: "Shorter edges are not cut once for two parts; where one goes on from the end of another they\ncount together." },
    Key { name: "common.near_mm", takes: Takes::Number(from(0.0, 10.0)), about: "Edges that run this near to another part's, and are not cut as one, count as near lines: a\nthin strip stands between two cuts. 0 = none; see knife.near_percent." },
];

/// Cutting of edges that two parts have in common.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Common {
    /// Greatest distance of two edges that are cut once.
    pub lines: Lines,
    /// Least length of an edge that is cut once, mm; consecutive edges count together.
    pub min_mm: f64,
    /// Greatest distance of a near line from another part's edge, mm; 0 = no near lines.
    pub near_mm: f64,
}

impl Default for Common {
    fn default() -> Self {
        Self { lines: Lines::Word(CommonLines::Auto), min_mm: 20.0, near_mm: 1.27 }
    }
}

/// Greatest distance of two edges that are cut once.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum Lines {
    /// Distance, mm.
    Within(f64),
    /// Word in place of a distance.
    Word(CommonLines),
}

/// Word in place of a distance in [`Lines`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum CommonLines {
    /// The band.
    Auto,
    /// Every edge is cut for each part.
    Off,
}
