//! Drawings of every dialect: the keys `drawing.*`.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::key::{Key, Takes, from};
use super::pen::PenUse;
use super::word::words;

/// Widest gap that `drawing.close_mm` may close, mm: gaps of outlines are narrower, those of other lines wider.
pub const CLOSE_MOST_MM: f64 = 10.0;

/// The keys `drawing.*`.
#[rustfmt::skip] // a table: one row a key
pub(super) const KEYS: &[Key] = &[
    Key { name: "drawing.close_mm", takes: Takes::Number(from(0.0, CLOSE_MOST_MM)), about: "Outlines of a plot whose ends are this far apart at the most are closed, and so are those\nwhose ends lie this near to the edge of the frame. 0 = only rounding is closed." },
    Key { name: "drawing.beside", takes: Takes::Word(words::<Beside>), about: "What open lines stand for that run beside or around a closed line from outside: \"outline\" =\nwhat is left of its outline, so that it may be a line inside and is refused; \"guide\" = lines for\na worker." },
    Key { name: "drawing.layers.<layer>", takes: Takes::Word(words::<PenUse>), about: "What a layer of a drawing (DXF, SVG) stands for, by its name or a pattern: its lines are cut\n(\"knife\"), drawn only, but for notches on cut edges (\"pen\"), or do not matter (\"ignore\"). Where\none is a knife, layers without a key are pens; words of their names may say otherwise." },
];

/// Options for reading drawings.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Drawings {
    /// Widest gap of an outline that is closed, mm.
    pub close_mm: f64,
    /// Open lines beside closed ones.
    pub beside: Beside,
    /// Layers by their names, or by patterns of them.
    pub layers: BTreeMap<String, PenUse>,
}

impl Default for Drawings {
    fn default() -> Self {
        Self { close_mm: 1.5, beside: Beside::Outline, layers: BTreeMap::new() }
    }
}

/// Meaning of open lines that run beside some of a closed line from outside.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Beside {
    /// They are the rest of an outline, and the closed line may be its seam line.
    Outline,
    /// They guide a worker, and the closed line is a part.
    Guide,
}
