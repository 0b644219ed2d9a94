//! The conveyor under the table: the keys `bite.*`.

use serde::{Deserialize, Serialize};

use super::key::{Key, Takes, from};
use super::word::{Off, OrWord, Word as _};

/// The keys `bite.*`.
#[rustfmt::skip] // a table: one row a key
pub(super) const KEYS: &[Key] = &[
    Key { name: "bite.length_mm", takes: Takes::NumberOr(from(50.0, 1.0e5), Off::WORD), about: "Bite of a conveyor: length along X of the window in which the knife cuts. A longer marker is\ncut in several, and the cloth is moved on between them; \"off\" = it lies still." },
    Key { name: "bite.overlap_mm", takes: Takes::Number(from(0.0, 100.0)), about: "Where a piece is longer than a bite: how far both halves of a split cut run past the border." },
    Key { name: "bite.match_mm", takes: Takes::Number(from(0.0, 5.0)), about: "How far an advance of the conveyor may be off, in X and in Y: the halves of a split cut cross all\nthe same." },
    Key { name: "bite.veer_mm", takes: Takes::Number(from(0.0, 50.0)), about: "How far both halves of a split cut leave the line at their ends, into the waste: at least as far\nas they must to cross (bite.match_mm)." },
];

/// Least deviation of a half of a split cut in addition, in tolerances of the tip: both halves may be off their lines.
const TOLERANCES: f64 = 4.0;

/// The conveyor under the table.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Bite {
    /// Length of a window, mm; `None` where the cloth lies still.
    #[serde(with = "OrWord::<Off>")]
    pub length_mm: Option<f64>,
    /// Length by which both halves of a split cut run past the border, mm.
    pub overlap_mm: f64,
    /// Tolerance of an advance in X and in Y, mm.
    pub match_mm: f64,
    /// Distance by which both halves leave the line at their ends, into the waste, mm.
    pub veer_mm: f64,
}

impl Bite {
    /// Greatest number of advances between the halves of a split cut: each of them may be off.
    pub const MOST_ADVANCES: u32 = 2;

    /// Greatest distance by which [`Bite::MOST_ADVANCES`] move the halves of a split cut apart, in tolerances of the conveyor:
    /// more than the diagonal of both axes.
    pub const MATCHES: f64 = 3.0;

    /// Distance by which both halves of a split cut leave their line, mm, for the given tolerance of the tip.
    pub fn veer(&self, tolerance: f64) -> f64 {
        self.veer_mm.max(Self::MATCHES * self.match_mm + TOLERANCES * tolerance)
    }
}

impl Default for Bite {
    fn default() -> Self {
        Self { length_mm: None, overlap_mm: 6.3, match_mm: 0.5, veer_mm: 1.5 }
    }
}
