//! The conveyor under the table: the keys `bite.*`.

use serde::{Deserialize, Serialize};

use super::key::{Key, Takes, from};
use super::word::{Off, OrWord, Word as _};

/// The keys `bite.*`.
#[rustfmt::skip] // a table: one row a key
pub(super) const KEYS: &[Key] = &[
    Key { name: "bite.length_mm", takes: Takes::NumberOr(from(50.0, 1.0e5), Off::WORD), about: "Bite of a conveyor: length along X of the window in which the knife cuts. A longer marker is\ncut in several, and the cloth is moved on between them; \"off\" = it lies still." },
];

/// The conveyor under the table.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Bite {
    /// Length of a window; `None` where the cloth lies still.
    #[serde(with = "OrWord::<Off>")]
    pub length_mm: Option<f64>,
}
