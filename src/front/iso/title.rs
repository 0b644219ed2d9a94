//! The title of a marker, the text behind M20: `NAME/L=<length>[unit]/W=<width>[unit]`.

use crate::source::Span;
use crate::units::{MM_PER_INCH, MM_PER_M};

/// The size stated by a title, mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Title {
    /// Length along the table.
    pub(super) length: Option<f64>,
    /// Width across the table.
    pub(super) width: Option<f64>,
    /// Location in the source.
    pub(super) span: Span,
}

impl Title {
    /// Reads the sizes of a title; `None` if none is stated with a unit.
    pub(super) fn read(text: &[u8], span: Span) -> Option<Self> {
        let text = String::from_utf8_lossy(text);
        let field = |key: &str| {
            text.split('/').find_map(|field| field.trim().strip_prefix(key)).and_then(|value| millimetres(value.trim()))
        };
        let (length, width) = (field("L="), field("W="));
        (length.is_some() || width.is_some()).then_some(Self { length, width, span })
    }
}

/// A positive number with its unit, converted to mm. Titles are often cut off, so `c` stands for `cm`.
fn millimetres(value: &str) -> Option<f64> {
    let end = value.find(|c: char| !c.is_ascii_digit() && c != '.').unwrap_or(value.len());
    let (number, unit) = value.split_at(end);
    let factor = match unit.trim().to_ascii_lowercase().as_str() {
        "mm" => 1.0,
        "c" | "cm" => 10.0,
        "m" => MM_PER_M,
        "in" | "inch" | "i" | "\"" => MM_PER_INCH,
        _ => return None,
    };
    number.parse::<f64>().ok().map(|number| number * factor).filter(|&size| size > 0.0 && size.is_finite())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_title_states_sizes_in_any_unit() {
        let read = |text: &str| Title::read(text.as_bytes(), Span::default()).map(|t| (t.length, t.width));
        assert_eq!(read("LADIES-PANT/L=23.00cm/W=90.00c"), Some((Some(230.0), Some(900.0))));
        assert_eq!(read("MADE-1/W=150cm"), Some((None, Some(1500.0))));
        assert_eq!(read("A/L=2m/W=60in"), Some((Some(2000.0), Some(1524.0))));
        assert_eq!(read("JOB-1"), None);
        assert_eq!(read("A/L=12"), None);
    }
}
