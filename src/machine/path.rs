//! Tracking of the line, and its splitting at corners: the keys `corner.*`, `slow.*` and `path.*`.

use serde::{Deserialize, Serialize};

use super::key::{Key, PERCENT, Takes, between, from};
use super::word::{Auto, Off, OrWord, Word as _, words};
use crate::units::rad;

/// The keys `corner.*`, `slow.*`, `path.*`.
#[rustfmt::skip] // a table: one row a key
pub(super) const KEYS: &[Key] = &[
    Key { name: "corner.angle_deg", takes: Takes::Number(between(0.0, 75.0)), about: "Lift and plunge corner angle: where the line turns by more than this the knife is lifted and\nturned in the air; a blade in the cloth cannot follow sharper ones." },
    Key { name: "slow.before_corner_mm", takes: Takes::NumberOr(from(0.1, 1000.0), Off::WORD), about: "How far before a corner the knife slows down." },
    Key { name: "slow.before_corner_percent", takes: Takes::Number(PERCENT), about: "Speed of the knife there, a part of what it would be." },
    Key { name: "path.tolerance_mm", takes: Takes::NumberOr(from(0.001, 100.0), Auto::WORD), about: "How far the tip, or a head, may leave its line; \"auto\" = 0.05 mm, or what the unit of the file\nresolves if that is more." },
    Key { name: "path.fit", takes: Takes::Word(words::<Fit>), about: "What the straight pieces of a file stand for: \"curve\" = a curve that the CAD system cut into\npieces, \"polygon\" = exactly what they are." },
    Key { name: "path.chord_sag_max_mm", takes: Takes::Number(from(0.0, 10.0)), about: "With fit = \"curve\": how far the curve may bulge beyond a straight piece." },
];

/// Criterion for a corner.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Corner {
    /// Least turn of a corner.
    pub angle_deg: f64,
}

impl Corner {
    /// `angle_deg`, rad.
    pub(super) fn angle(&self) -> f64 {
        rad(self.angle_deg)
    }
}

impl Default for Corner {
    fn default() -> Self {
        Self { angle_deg: 45.0 }
    }
}

/// Slowdown before corners.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Slow {
    /// Length of line before a corner; `None` = no slowdown.
    #[serde(with = "OrWord::<Off>")]
    pub before_corner_mm: Option<f64>,
    /// Speed there, relative to the speed without a slowdown.
    pub before_corner_percent: f64,
}

impl Default for Slow {
    fn default() -> Self {
        Self { before_corner_mm: None, before_corner_percent: 50.0 }
    }
}

/// Accuracy with which the line is followed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Path {
    /// Tolerance as given; [`MachineProfile::tolerance`](super::MachineProfile::tolerance) is the effective one.
    #[serde(with = "OrWord::<Auto>")]
    pub tolerance_mm: Option<f64>,
    /// Meaning of a polyline.
    pub fit: Fit,
    /// Greatest bulge of the curve beyond a chord.
    pub chord_sag_max_mm: f64,
}

/// Meaning of a polyline in the file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Fit {
    /// Flattened curve: chords cut its corners, so the tolerance band is wider on the outside.
    Curve,
    /// The polygon itself.
    Polygon,
}

impl Default for Path {
    fn default() -> Self {
        Self { tolerance_mm: None, fit: Fit::Curve, chord_sag_max_mm: 0.15 }
    }
}
