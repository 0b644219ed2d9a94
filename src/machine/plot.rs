//! Plots (HPGL): the unit of their numbers, and which of their lines are cut.

use std::collections::BTreeMap;

use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::selection::Numbers;
use super::word::{Off, OrWord};
use crate::units::MM_PER_INCH;

/// How plots are read.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Hpgl {
    /// Unit of the numbers.
    pub unit: PlotUnit,
    /// Largest closed square or circle that is a hole to drill, mm; `None` = none is.
    #[serde(with = "OrWord::<Off>")]
    pub drill_max_mm: Option<f64>,
    /// Which closed lines inside parts are cut.
    pub inner: Inner,
    /// Whether a frame is drawn around the parts.
    pub frame: Frame,
    /// What a pen stands for, by its number.
    pub pens: BTreeMap<String, PenUse>,
}

impl Hpgl {
    /// What the pen of that name stands for; `None` when the profile does not say.
    pub fn pen(&self, name: &str) -> Option<PenUse> {
        self.pens.get(name).copied()
    }
}

/// What a pen stands for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum PenUse {
    /// The knife: its lines are cut.
    Knife,
    /// A pen: its lines are drawn, not cut.
    Pen,
    /// Its lines do not matter.
    Ignore,
}

/// Which closed lines inside the parts of a plot are cut.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Inner {
    /// None, but those of a pen that is a knife.
    #[default]
    Ignore,
    /// Those that are no seam lines, and take no more than half of their part.
    Cut,
    /// All of them, seam lines too.
    All,
}

/// Whether a plot draws a frame around its parts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Frame {
    /// A rectangle around several parts is one.
    #[default]
    Auto,
    /// There is none.
    None,
    /// The largest closed line is one, whatever its shape.
    Outermost,
}

/// The length of one unit of a plot: a number of mm, or a text such as `1/40 mm`, `1/1000 in`, `600 dpi`.
#[derive(Debug, Clone, PartialEq)]
pub struct PlotUnit {
    /// As it was written; `None` for a number.
    text: Option<String>,
    mm: f64,
}

/// Least and greatest unit, mm: from the finest printers to a slip of the comma.
pub(super) const LEAST_UNIT_MM: f64 = 0.001;
pub(super) const GREATEST_UNIT_MM: f64 = 10.0;

impl PlotUnit {
    /// A unit of so many mm.
    pub const fn of_mm(mm: f64) -> Self {
        Self { text: None, mm }
    }

    /// Its length, mm.
    pub fn mm(&self) -> f64 {
        self.mm
    }

    /// Reads `1/40 mm`, `1/1000 in`, `1/40` (mm) or `600 dpi`; `None` for anything else.
    pub fn parse(text: &str) -> Option<Self> {
        let (value, factor) = if let Some(dots) = text.trim().strip_suffix("dpi") {
            (1.0 / quotient(dots)?, MM_PER_INCH)
        } else if let Some(inches) = text.trim().strip_suffix("in") {
            (quotient(inches)?, MM_PER_INCH)
        } else {
            (quotient(text.trim().strip_suffix("mm").unwrap_or(text))?, 1.0)
        };
        let mm = value * factor;
        mm.is_finite().then(|| Self { text: Some(text.to_owned()), mm })
    }
}

/// A number, or a quotient of two.
fn quotient(text: &str) -> Option<f64> {
    let number = |part: &str| part.trim().parse::<f64>().ok().filter(|value| *value > 0.0);
    match text.split_once('/') {
        Some((above, below)) => Some(number(above)? / number(below)?),
        None => number(text),
    }
}

/// 1/40 mm: the unit of plotters (HP-GL/2 and ASTM D6959).
impl Default for PlotUnit {
    fn default() -> Self {
        Self { text: Some("1/40 mm".to_owned()), mm: 1.0 / 40.0 }
    }
}

impl<'de> Deserialize<'de> for PlotUnit {
    fn deserialize<D: Deserializer<'de>>(input: D) -> Result<Self, D::Error> {
        #[derive(Deserialize)]
        #[serde(untagged)]
        enum Typed {
            Number(f64),
            Text(String),
        }
        let expected = || serde::de::Error::custom("expected mm, or a text such as \"1/40 mm\"");
        match Typed::deserialize(input).map_err(|_| expected())? {
            Typed::Number(mm) => Ok(Self::of_mm(mm)),
            Typed::Text(text) => Self::parse(&text).ok_or_else(expected),
        }
    }
}

impl Serialize for PlotUnit {
    fn serialize<S: Serializer>(&self, output: S) -> Result<S::Ok, S::Error> {
        match &self.text {
            Some(text) => output.serialize_str(text),
            None => output.serialize_f64(self.mm),
        }
    }
}

/// Which lines of a plot one compile cuts, where its user says something of them.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Lines {
    /// Only those of these pens; `None` = as the profile and the shapes say.
    pub pens: Option<Numbers>,
    /// Which closed lines inside parts; `None` = as the profile says.
    pub inner: Option<Inner>,
    /// Every line, whatever it is taken for.
    pub all: bool,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_are_read_as_people_write_them() {
        let check = |text: &str, mm: Option<f64>| assert_eq!(PlotUnit::parse(text).map(|unit| unit.mm()), mm, "{text}");
        check("1/40 mm", Some(0.025));
        check("1/40", Some(0.025));
        check("0.1 mm", Some(0.1));
        check("1/1000 in", Some(0.001 * 25.4));
        check("1016 dpi", Some(25.4 / 1016.0));
        check("40", Some(40.0));
        check("mm", None);
        check("1/0", None);
        check("-1/40 mm", None);
        check("1/40 km", None);
    }
}
