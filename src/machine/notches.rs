//! Cutting of notches: the keys `notch.*`.

use serde::{Deserialize, Serialize};

use super::key::{Key, Takes, Within, from};
use super::word::{AsDrawn, OrWord, Word as _, words};

/// Depths of notches, mm: deeper ones would cut into the part.
const DEPTH: Within = from(0.5, 15.0);

/// The keys `notch.*`.
#[rustfmt::skip] // a table: one row a key
pub(super) const KEYS: &[Key] = &[
    Key { name: "notch.style", takes: Takes::Word(words::<NotchStyle>), about: "How notches of all kinds, inwards and outwards, are cut: \"as-drawn\"; \"slit\" = each by one\nstraight cut into the part, as deep as the notch is high; \"skip\" = none. The outline then runs\nstraight over their mouths." },
    Key { name: "notch.t", takes: Takes::Word(words::<TNotch>), about: "How T notches are cut while `notch.style` is \"as-drawn\": \"as-drawn\", with their crossbar; \"slit\" =\nby their stem alone, as a slit." },
    Key { name: "notch.depth_mm", takes: Takes::NumberOr(DEPTH, AsDrawn::WORD), about: "How deep slits go into the part, also those that notches of another kind become; V, castle and U\nnotches that are cut as drawn keep their depth." },
    Key { name: "notch.box_max_mm", takes: Takes::Number(from(0.0, 2.0)), about: "A notch that the outline draws as a box or needle up to so wide is a slit along its middle." },
];

/// Cutting of notches, whatever the file draws.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Notches {
    /// Shape.
    pub style: NotchStyle,
    /// Treatment of the crossbars of T notches.
    pub t: TNotch,
    /// Depth of slits; `None` = as drawn.
    #[serde(with = "OrWord::<AsDrawn>")]
    pub depth_mm: Option<f64>,
    /// Greatest width of a box that is cut as a slit.
    pub box_max_mm: f64,
}

impl Default for Notches {
    fn default() -> Self {
        Self { style: NotchStyle::AsDrawn, t: TNotch::AsDrawn, depth_mm: None, box_max_mm: 0.6 }
    }
}

impl Notches {
    /// True if the crossbars of T notches are cut.
    pub fn cuts_crossbars(&self) -> bool {
        self.style == NotchStyle::AsDrawn && self.t == TNotch::AsDrawn
    }
}

/// Shape of T notches.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum TNotch {
    /// Stem and crossbar.
    #[default]
    AsDrawn,
    /// Stem only.
    Slit,
}

/// Shape of notches.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum NotchStyle {
    /// As drawn in the file.
    #[default]
    AsDrawn,
    /// As slits.
    Slit,
    /// None is cut.
    Skip,
}
