//! Plots (HPGL): the unit of their numbers, and the choice of lines to cut. The keys `hpgl.*`.

pub(super) mod unit;

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

pub use self::unit::PlotUnit;
use self::unit::{GREATEST_UNIT_MM, LEAST_UNIT_MM};
use super::key::{Family, Key, Takes, from};
use super::layers::LayerUses;
pub use super::pen::PenUse;
use super::selection::Numbers;
use super::word::{Off, OrWord, Word as _, words};

/// The keys `hpgl.*`.
#[rustfmt::skip] // a table: one row a key
pub(super) const KEYS: &[Key] = &[
    Key { name: "hpgl.unit", takes: Takes::Length(from(LEAST_UNIT_MM, GREATEST_UNIT_MM)), about: "Unit of the numbers in plots, mm. Plotters count 1/40 mm; other programs write 0.0254, 0.1, 0.01\nor the dots of a printer. The extent is always printed: compare it with the cloth." },
    Key { name: "hpgl.drill_max_mm", takes: Takes::NumberOr(from(0.0, 1000.0), Off::WORD), about: "Closed squares and circles of a plot up to this size are holes to drill; \"off\" = none is." },
    Key { name: "hpgl.inner", takes: Takes::Word(words::<Inner>), about: "Which closed lines inside parts are cut: \"ignore\" = none, but those of a pen that is a knife;\n\"cut\" = all that are no seam lines and take no more than half of their part;\n\"all\" = seam lines, too." },
    Key { name: "hpgl.frame", takes: Takes::Word(words::<Frame>), about: "Whether a frame is drawn around the parts: \"auto\" = a rectangle around two parts or more is one;\n\"none\" = there is none; \"outermost\" = the largest closed line is one, and so is each\nrectangle beside it around two lines or more." },
    Key { name: "hpgl.pens.<pen>", takes: Takes::Word(words::<PenUse>), about: "What a pen of a plot stands for: its outermost and inner lines are cut (\"knife\"), its lines are\ndrawn only, but for notches on cut edges (\"pen\"), or do not matter (\"ignore\"). Of pens without a\nkey shapes decide." },
];

/// Name mistaken for a key of a pen: with pen 0 plotters draw nothing.
pub(super) const NO_PEN: &str = "hpgl.pens.0";

/// Family with one key per pen.
pub(super) const PENS: Family =
    Family { start: "hpgl.pens", has: is_pen, pattern: || "[1-9][0-9]{0,2}".to_owned(), example: "1 = \"knife\"" };

/// True if a word is the number of a pen: up to three digits without leading zeros. Pen 0 does not exist.
fn is_pen(word: &str) -> bool {
    let is_number = !word.is_empty() && word.len() <= 3 && word.bytes().all(|byte| byte.is_ascii_digit());
    is_number && !word.starts_with('0')
}

/// Reading of plots.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Hpgl {
    /// Length of a unit.
    pub unit: PlotUnit,
    /// Greatest size of a hole to drill.
    #[serde(with = "OrWord::<Off>")]
    pub drill_max_mm: Option<f64>,
    /// Closed lines inside parts that are cut.
    pub inner: Inner,
    /// Frame around the parts.
    pub frame: Frame,
    /// Uses of pens, by their numbers.
    pub pens: BTreeMap<String, PenUse>,
}

impl Hpgl {
    /// Use of a pen; `None` if the profile does not give it.
    pub fn pen(&self, name: &str) -> Option<PenUse> {
        self.pens.get(name).copied()
    }
}

/// Closed lines inside the parts of a plot that are cut.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Inner {
    /// None, except those of a pen that is a knife.
    #[default]
    Ignore,
    /// All that are not seam lines and take up at most half of their part.
    Cut,
    /// All, including seam lines.
    All,
}

/// Frame of a plot around its parts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Frame {
    /// A rectangle around several parts.
    #[default]
    Auto,
    /// No frame.
    None,
    /// The largest closed line of any shape, and each rectangle beside it around at least two lines.
    Outermost,
}

/// Choice of lines of a plot for one compile, where its user makes one.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Lines {
    /// Pens to cut exclusively; `None` = by the profile and the shapes.
    pub pens: Option<Numbers>,
    /// Uses of layers; `None` = by the profile and their names.
    pub layers: Option<LayerUses>,
    /// Closed lines inside parts; `None` = by the profile.
    pub inner: Option<Inner>,
    /// True if every line is cut, whatever it is taken for.
    pub all: bool,
}
