//! Limits for the verifier besides the tolerance of the path: the keys `verify.*`.

use serde::{Deserialize, Serialize};

use super::key::{Key, Takes, Within, from};
use super::word::{Off, OrWord, Word as _};

/// Deviations of the blade, mm: greater ones are a wrong unit.
const ASTRAY: Within = from(0.0, 1000.0);

/// The keys `verify.*`.
#[rustfmt::skip] // a table: one row a key
pub(super) const KEYS: &[Key] = &[
    Key { name: "verify.max_uncut_mm", takes: Takes::Number(from(0.0, 10.0)), about: "Longest stretch that may be left uncut: what the rounding of setpoints can leave." },
    Key { name: "verify.max_heading_deg", takes: Takes::Number(from(0.01, 45.0)), about: "Greatest angle between the blade and the direction that knife.follow asks for while it cuts." },
    Key { name: "verify.max_body_mm", takes: Takes::NumberOr(ASTRAY, Off::WORD), about: "Farthest that the blade's body may leave the path on curves." },
    Key { name: "verify.max_overcut_part_mm", takes: Takes::NumberOr(ASTRAY, Off::WORD), about: "Deepest overcut into the part itself, beside the tolerance: half a seam allowance." },
    Key { name: "verify.max_overcut_neighbour_mm", takes: Takes::NumberOr(ASTRAY, Off::WORD), about: "Deepest overcut into another part, beside the tolerance." },
    Key { name: "verify.max_overcut_waste_mm", takes: Takes::NumberOr(ASTRAY, Off::WORD), about: "Farthest overcut into waste." },
];

/// Limits of the verifier.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Verify {
    /// Greatest length left uncut.
    pub max_uncut_mm: f64,
    /// Greatest angle between the blade and its orientation mode.
    pub max_heading_deg: f64,
    /// Greatest distance of the blade's body from a curve.
    #[serde(with = "OrWord::<Off>")]
    pub max_body_mm: Option<f64>,
    /// Greatest overcut into the part itself.
    #[serde(with = "OrWord::<Off>")]
    pub max_overcut_part_mm: Option<f64>,
    /// Greatest overcut into another part.
    #[serde(with = "OrWord::<Off>")]
    pub max_overcut_neighbour_mm: Option<f64>,
    /// Greatest overcut into waste.
    #[serde(with = "OrWord::<Off>")]
    pub max_overcut_waste_mm: Option<f64>,
}

impl Default for Verify {
    fn default() -> Self {
        Self {
            max_uncut_mm: 0.01,
            max_heading_deg: 0.5,
            max_body_mm: None,
            max_overcut_part_mm: Some(5.0),
            max_overcut_neighbour_mm: Some(5.0),
            max_overcut_waste_mm: None,
        }
    }
}
