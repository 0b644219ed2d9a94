//! Lengths: a number and a unit.

use super::scan::Scan;
use crate::units::MM_PER_INCH;

/// A length as written.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Length {
    /// Length in mm.
    Mm(f64),
    /// Number without a unit, or in pixels.
    Px(f64),
    /// Percentage of a reference length.
    Percent(f64),
}

impl Length {
    /// Parses a length; `None` if it is malformed or relative to the font size.
    pub(super) fn read(text: &str) -> Option<Self> {
        let mut scan = Scan::of(text.trim());
        let number = scan.number()?;
        Some(match scan.rest().trim().to_ascii_lowercase().as_str() {
            "" | "px" => Self::Px(number),
            "%" => Self::Percent(number),
            "mm" => Self::Mm(number),
            "cm" => Self::Mm(number * 10.0),
            "q" => Self::Mm(number / 4.0),
            "in" => Self::Mm(number * MM_PER_INCH),
            "pt" => Self::Mm(number / 72.0 * MM_PER_INCH),
            "pc" => Self::Mm(number / 6.0 * MM_PER_INCH),
            _ => return None,
        })
    }

    /// Length in units of the file, for a pixel of `pixel` mm; `whole` is the reference of percentages.
    pub(super) fn units(self, pixel: f64, whole: f64) -> f64 {
        match self {
            Self::Mm(mm) => mm / pixel,
            Self::Px(px) => px,
            Self::Percent(percent) => percent / 100.0 * whole,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_have_units() {
        let check = |text: &str, expected| assert_eq!(Length::read(text), expected, "{text}");
        check("12.5", Some(Length::Px(12.5)));
        check(" 12px ", Some(Length::Px(12.0)));
        check("1e1mm", Some(Length::Mm(10.0)));
        check("1CM", Some(Length::Mm(10.0)));
        check("4q", Some(Length::Mm(1.0)));
        check("2in", Some(Length::Mm(50.8)));
        check("72 pt", Some(Length::Mm(25.4)));
        check("6pc", Some(Length::Mm(25.4)));
        check("50%", Some(Length::Percent(50.0)));
        for text in ["", "mm", "1em", "1 2", "1furlong", "auto", "1e999"] {
            check(text, None);
        }
        assert_eq!(Length::Mm(25.4).units(MM_PER_INCH / 96.0, 0.0), 96.0);
        assert_eq!(Length::Percent(25.0).units(1.0, 400.0), 100.0);
    }
}
