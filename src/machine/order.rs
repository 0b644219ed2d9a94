//! In which order pieces are cut: the keys `order.*`.

use serde::{Deserialize, Serialize};

use super::key::{Key, Takes, from};
use super::word::words;

/// The keys `order.*`.
#[rustfmt::skip] // a table: one row a key
pub(super) const KEYS: &[Key] = &[
    Key { name: "order.policy", takes: Takes::Word(words::<OrderPolicy>), about: "In which order pieces are cut: \"file\" = as in the file, what lies within a part before it;\n\"fastest\" = on the shortest way with the knife up, notches on the way round, each line from the\ncorner and in the direction that suit; \"steady\" = the same, the work moving along X\n(order.window_mm), small pieces before what holds them (order.small_mm2), each piece ending at its\nside towards the cloth that is still uncut; \"auto\" = \"file\" for cut files, whose CAD chose it,\n\"steady\" for drawings." },
    Key { name: "order.window_mm", takes: Takes::Number(from(10.0, 1.0e6)), about: "How far \"steady\" goes back in X at the most, from the left edge of one piece to that of another." },
    Key { name: "order.small_mm2", takes: Takes::Number(from(0.0, 1.0e7)), about: "Pieces of less area are small: \"steady\" cuts them before the larger ones next to them, which hold\nthe cloth around them still; 0 = none are." },
];

/// In which order pieces are cut.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Order {
    /// By what it is chosen.
    pub policy: OrderPolicy,
    /// How far the work goes back in X at the most when it is to be steady.
    pub window_mm: f64,
    /// Area below which a piece is small.
    pub small_mm2: f64,
}

impl Default for Order {
    fn default() -> Self {
        Self { policy: OrderPolicy::Auto, window_mm: 600.0, small_mm2: 2500.0 }
    }
}

impl Order {
    /// By what the order of pieces is chosen that were read from a drawing, which has none of its own, or from a cut file.
    pub fn policy(&self, is_drawing: bool) -> OrderPolicy {
        match self.policy {
            OrderPolicy::Auto if is_drawing => OrderPolicy::Steady,
            OrderPolicy::Auto => OrderPolicy::File,
            policy @ (OrderPolicy::File | OrderPolicy::Fastest | OrderPolicy::Steady) => policy,
        }
    }
}

/// By what the order of pieces is chosen.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum OrderPolicy {
    /// As suits what is read.
    Auto,
    /// The file.
    File,
    /// The least time with the knife up.
    Fastest,
    /// The same, with the work moving along X.
    Steady,
}
