//! Pattern DXF: settings that the file leaves open, and the choice of its pieces. The keys `dxf.*`.

use std::fmt;

use serde::{Deserialize, Serialize};

use super::key::{Key, Takes, from};
use super::word::words;
use crate::units::MM_PER_INCH;

/// The keys `dxf.*`.
#[rustfmt::skip] // a table: one row a key
pub(super) const KEYS: &[Key] = &[
    Key { name: "dxf.unit", takes: Takes::Word(words::<PatternUnit>), about: "Unit of pattern DXF. \"auto\" believes the text UNITS: METRIC (mm), CM or ENGLISH (inch);\nwithout one it is mm, with a warning." },
    Key { name: "dxf.quantity", takes: Takes::Word(words::<Quantity>), about: "How often a piece of a pattern DXF is cut: \"file\" = as the text QUANTITY says, 1,1 = once as it is\ndrawn and once mirrored; \"one\" = once as it is drawn." },
    Key { name: "dxf.curves", takes: Takes::Word(words::<Curves>), about: "Curves of a pattern DXF whose outlines have a few points of them: \"auto\" = as layers 84 to 87 draw\nthem, else as the CAD system lays them; \"points\" = straight from point to point." },
    Key { name: "dxf.gap_mm", takes: Takes::Number(from(0.0, 1000.0)), about: "Room between the pieces of a pattern DXF, which lie in a row unless the file places them." },
    Key { name: "dxf.notch_mm", takes: Takes::Number(from(1.0, 15.0)), about: "Depth of the notches for which a pattern DXF gives none." },
];

/// Reading of pattern DXF.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Dxf {
    /// Unit of its numbers.
    pub unit: PatternUnit,
    /// Number of times that a piece is cut.
    pub quantity: Quantity,
    /// Course of its outlines between their points.
    pub curves: Curves,
    /// Space between pieces.
    pub gap_mm: f64,
    /// Depth of notches for which the file gives none.
    pub notch_mm: f64,
}

/// Accuracy of reading pattern DXF: guaranteed for every file, and checked.
impl Dxf {
    /// Greatest distance of the chords of a curve from it, as a share of the tolerance.
    pub const CHORDS_OFF: f64 = 0.25;
    /// Greatest distance between ends of lines that are joined, mm: covers rounding to a hundredth of an inch. Files of garment
    /// CAD have no gap at all.
    pub const ENDS_MEET: f64 = 0.2;
    /// Greatest distance of a curve through points from the chord between two of them, as a share of the chord: a half circle.
    /// Curves that pass from chord to chord at even speed stay well within that.
    pub const CURVE_OFF: f64 = 0.5;
    /// Greatest distance of the point of a notch from the outline into which it is cut, mm: others mark seam lines.
    pub const NOTCH_OFF: f64 = 1.0;
    /// Greatest distance of a turn point or a curve point from the vertex that it marks, mm: covers rounding to a hundredth of
    /// a millimetre or a thousandth of an inch. A twentieth, plus its own rounding.
    pub const POINT_OFF: f64 = 0.051;
    /// Greatest length of a stretch that goes straight on at a turn of an outline, mm: the overcut of another cutter.
    pub const PAST_CORNER: f64 = 10.0;
    /// Greatest distance of such a stretch, of one along the outline, or of another round from the first round, mm.
    pub const RETRACE_OFF: f64 = 0.2;
}

impl Default for Dxf {
    fn default() -> Self {
        Self { unit: PatternUnit::Auto, quantity: Quantity::File, curves: Curves::Auto, gap_mm: 20.0, notch_mm: 5.0 }
    }
}

/// Unit of the numbers of a pattern DXF.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum PatternUnit {
    /// Unit stated in the file.
    #[default]
    Auto,
    /// Millimetres.
    Mm,
    /// Centimetres.
    Cm,
    /// Inches.
    Inch,
}

impl PatternUnit {
    /// Length of the unit, mm; `None` if the file decides.
    pub fn mm(self) -> Option<f64> {
        match self {
            Self::Auto => None,
            Self::Mm => Some(1.0),
            Self::Cm => Some(10.0),
            Self::Inch => Some(MM_PER_INCH),
        }
    }
}

/// Number of times that a piece is cut.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Quantity {
    /// As often as the file says, right and left.
    #[default]
    File,
    /// Once, as drawn.
    One,
}

/// Course of outlines that contain only a few points of their curves.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Curves {
    /// Along the curves in the file, or those of its CAD system.
    #[default]
    Auto,
    /// Straight from point to point.
    Points,
}

/// Sizes of a set of patterns to cut.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Sizes {
    /// All sizes.
    All,
    /// Sizes with these names.
    Named(Vec<String>),
}

impl Sizes {
    /// Word for all sizes.
    const ALL: &'static str = "all";

    /// Reads `M`, `S,M,L` or `all`; `None` if a name is missing.
    pub fn parse(text: &str) -> Option<Self> {
        if text.trim().eq_ignore_ascii_case(Self::ALL) {
            return Some(Self::All);
        }
        let names: Vec<String> = text.split(',').map(|name| name.trim().to_owned()).collect();
        names.iter().all(|name| !name.is_empty()).then_some(Self::Named(names))
    }
}

/// Text as typed, in quotes if a shell would split it.
impl fmt::Display for Sizes {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let names = match self {
            Self::All => return out.write_str(Self::ALL),
            Self::Named(names) => names.join(","),
        };
        let is_plain = |letter: char| letter.is_alphanumeric() || ",./-_".contains(letter);
        if names.chars().all(is_plain) {
            out.write_str(&names)
        } else {
            write!(out, "'{}'", names.replace('\'', "'\\''"))
        }
    }
}

/// Choice of patterns for one compile, where its user makes one.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Patterns {
    /// Sizes; `None` = the sample size.
    pub sizes: Option<Sizes>,
    /// Number of times; `None` = as in the profile.
    pub quantity: Option<Quantity>,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_are_read_as_people_write_them() {
        let named = |names: &[&str]| Some(Sizes::Named(names.iter().map(|&name| name.to_owned()).collect()));
        assert_eq!(Sizes::parse("M"), named(&["M"]));
        assert_eq!(Sizes::parse("S, 44/46"), named(&["S", "44/46"]));
        assert_eq!(Sizes::parse("ALL"), Some(Sizes::All));
        assert_eq!(Sizes::parse("S,"), None);
        let typed = |text: &str| Sizes::parse(text).map(|sizes| sizes.to_string());
        assert_eq!(["S,M", "2 XL", "6'"].map(typed), ["S,M", "'2 XL'", "'6'\\'''"].map(|text| Some(text.to_owned())));
    }
}
