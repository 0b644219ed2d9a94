//! Order in which pieces are cut: the keys `order.*`.

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

/// Order in which pieces are cut.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Order {
    /// Criterion.
    pub policy: OrderPolicy,
    /// Greatest distance that a steady order goes back in X.
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
    /// Effective criterion for pieces from a drawing, which has no order of its own, or from a cut file.
    pub fn policy(&self, is_drawing: bool) -> OrderPolicy {
        match self.policy {
            OrderPolicy::Auto if is_drawing => OrderPolicy::Steady,
            OrderPolicy::Auto => OrderPolicy::File,
            policy @ (OrderPolicy::File | OrderPolicy::Fastest | OrderPolicy::Steady) => policy,
        }
    }
}

/// Criterion for the order of pieces.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum OrderPolicy {
    /// Depends on the input: drawing or cut file.
    Auto,
    /// Order of the file.
    File,
    /// Least time with the knife up.
    Fastest,
    /// Least time with the knife up while the work moves along X.
    Steady,
}
