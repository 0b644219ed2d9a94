//! Unit of a plot's numbers, as people write it.

use serde::{Deserialize, Deserializer, Serialize, Serializer};

use crate::units::MM_PER_INCH;

/// Length of one unit of a plot: a number of mm, or a text such as `1/40 mm`, `1/1000 in`, `600 dpi`.
#[derive(Debug, Clone, PartialEq)]
pub struct PlotUnit {
    /// Text as written; `None` for a number.
    text: Option<String>,
    mm: f64,
}

/// Least and greatest unit, mm: from the finest printers to a misplaced decimal point.
pub(in crate::machine) const LEAST_UNIT_MM: f64 = 0.001;
pub(in crate::machine) const GREATEST_UNIT_MM: f64 = 10.0;

impl PlotUnit {
    /// Unit of a length in mm.
    pub const fn of_mm(mm: f64) -> Self {
        Self { text: None, mm }
    }

    /// Length, mm.
    pub fn mm(&self) -> f64 {
        self.mm
    }

    /// Regular expression for the whole of a text that [`parse`](Self::parse) accepts.
    pub(in crate::machine) fn pattern() -> String {
        const NUMBER: &str = r"\+?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?";
        format!(r"^\s*{NUMBER}(?:\s*/\s*{NUMBER})?\s*(?:mm|in|dpi)?\s*$")
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

/// Number, or quotient of two.
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
