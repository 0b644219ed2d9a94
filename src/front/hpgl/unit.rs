//! Plausibility of the unit: plots do not state it, and some programs use unusual ones.

use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::geom::Extent;
use crate::ir::marker::Label;
use crate::machine::plot::PlotUnit;
use crate::source::Source;
use crate::units::MM_PER_INCH;
use crate::units::number::{fixed, short};

/// Maximum width of a plot on a table, mm, and minimum size of a part, mm.
const WIDEST: f64 = 3500.0;
const SMALLEST: f64 = 5.0;
/// Minimum stated length of a marker, mm; shorter lengths in texts are ignored.
const SHORTEST_STATED: f64 = 500.0;
/// Relative differences between the extent and a stated length. Below the first they agree, which still distinguishes 1/40 mm
/// from 1/1000 inch (1.6 % larger). Above the second the unit is doubted.
const AGREES: f64 = 0.005;
const DIFFERS: f64 = 0.012;
/// Units of plots, mm, with the values of the profile key.
const CANDIDATES: [(f64, &str); 5] = [
    (0.025, "\"1/40 mm\""),
    (0.0254, "\"1/1000 in\""),
    (0.1, "0.1"),
    (0.01, "0.01"),
    (MM_PER_INCH / 300.0, "\"300 dpi\""),
];
/// Units of a size stated without one, mm: centimetres, millimetres, inches.
const UNITS_OF_SIZES: [f64; 3] = [10.0, 1.0, MM_PER_INCH];
/// Minimum of the larger of two numbers that state a size.
const SHORTEST_SIZE: f64 = 50.0;
/// Number of digits in a group of thousands.
const GROUP: usize = 3;
/// Number of bytes of a text that are searched for a length.
const LONGEST_TITLE: usize = 200;
/// Lengths of a yard and a foot, mm.
const MM_PER_YARD: f64 = 36.0 * MM_PER_INCH;
const MM_PER_FOOT: f64 = 12.0 * MM_PER_INCH;

/// Input of the plausibility check.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sized<'a> {
    pub(super) unit: &'a PlotUnit,
    /// The bounding box of all lines.
    pub(super) extent: &'a Extent,
    pub(super) source: &'a Source,
    pub(super) labels: &'a [Label],
}

/// Warns if the drawing contradicts a length in its texts or fits no table, and names the units that would fit.
pub(super) fn check_plausible(sized: Sized, out: &mut Diagnostics) {
    let Sized { unit, extent, source, labels } = sized;
    if extent.is_empty() {
        return;
    }
    let (width, height) = extent.size();
    let (long, wide) = (width.max(height), width.min(height));
    let scale = |mm: f64| mm / unit.mm();
    let drawn =
        format!("with a unit of {} mm the drawing is {} x {} mm", short(unit.mm()), fixed(width, 1), fixed(height, 1));
    let fits_table = |mm: f64| wide * scale(mm) <= WIDEST && long * scale(mm) >= SMALLEST;
    let hint = |mut finding: Diagnostic, fits: &dyn Fn(f64) -> bool| {
        for (mm, key) in CANDIDATES {
            if fits(mm) && (mm - unit.mm()).abs() > f64::EPSILON {
                finding = finding.hint(format!("`hpgl.unit = {key}` in the profile would fit"));
            }
        }
        finding
    };
    if !fits_table(unit.mm()) {
        let what = if wide > WIDEST { "wider than any table" } else { "smaller than any part" };
        let finding = Diagnostic::new(&code::HPGL_UNIT_DOUBTFUL, format!("{drawn}: {what}"));
        out.push(hint(finding, &fits_table));
        return;
    }
    for label in labels {
        for stated in lengths(source.slice(label.span)).filter(|&stated| stated >= SHORTEST_STATED) {
            let miss = |mm: f64| (long * scale(mm) / stated - 1.0).abs();
            let fits = |mm: f64| miss(mm) <= AGREES;
            if miss(unit.mm()) > DIFFERS && CANDIDATES.iter().any(|&(mm, _)| fits(mm)) {
                let message = format!("{drawn}, but a text in it says {} mm", fixed(stated, 1));
                let finding = Diagnostic::new(&code::HPGL_UNIT_DOUBTFUL, message).at(label.span);
                out.push(hint(finding, &fits));
                return;
            }
        }
        for stated in sizes(source.slice(label.span)) {
            let fits = |mm: f64| {
                let is_near = |drawn: f64, stated: f64| (drawn * scale(mm) / stated - 1.0).abs() <= AGREES;
                UNITS_OF_SIZES.iter().any(|unit| is_near(wide, stated[0] * unit) && is_near(long, stated[1] * unit))
            };
            if !fits(unit.mm()) && CANDIDATES.iter().any(|&(mm, _)| fits(mm)) {
                let [less, greater] = stated.map(short);
                let message = format!("{drawn}, but a text in it says {less} x {greater}");
                let finding = Diagnostic::new(&code::HPGL_UNIT_DOUBTFUL, message).at(label.span);
                out.push(hint(finding, &fits));
                return;
            }
        }
    }
}

fn is_number(c: char) -> bool {
    c.is_ascii_digit() || c == '.' || c == ','
}

/// Value of a number with a decimal point or a decimal comma. Three digits after a comma may be thousands: `None`.
fn value(number: &str) -> Option<f64> {
    let number = number.trim_end_matches('.');
    match number.split_once(',') {
        None => number.parse().ok(),
        Some((_, decimals)) if decimals.len() == GROUP => None,
        Some((whole, decimals)) => format!("{whole}.{decimals}").parse().ok(),
    }
}

/// Sizes stated as two numbers without a unit, the smaller first: `140.0 x 450.0`.
fn sizes(text: &[u8]) -> Vec<[f64; 2]> {
    let text = String::from_utf8_lossy(&text[..text.len().min(LONGEST_TITLE)]).to_ascii_lowercase();
    let pair = |(at, _): (usize, &str)| {
        let (before, after) = (text[..at].trim_end(), text[at + 1..].trim_start());
        let (_, first) = before.split_at(before.trim_end_matches(is_number).len());
        let (second, behind) = after.split_at(after.find(|c| !is_number(c)).unwrap_or(after.len()));
        // A number with a unit is a length of its own.
        let has_unit = behind.trim_start().starts_with(|c: char| c.is_ascii_alphabetic());
        let (a, b) = value(first).zip(value(second)).filter(|_| !has_unit)?;
        (a.max(b) >= SHORTEST_SIZE).then_some([a.min(b), a.max(b)])
    };
    text.match_indices('x').filter_map(pair).collect()
}

/// Lengths stated in a text, mm: `7 yd 3.18 in`, `6.48 m`, `6,48 m`, `6481.6mm`.
fn lengths(text: &[u8]) -> impl Iterator<Item = f64> {
    let text = String::from_utf8_lossy(&text[..text.len().min(LONGEST_TITLE)]).to_ascii_lowercase();
    // Each number, the word after it, and whether it directly follows the previous word.
    let mut parts: Vec<(f64, String, bool)> = Vec::new();
    let mut rest = text.as_str();
    while let Some(start) = rest.find(|c: char| c.is_ascii_digit()) {
        let follows = rest[..start].trim().is_empty();
        rest = &rest[start..];
        let end = rest.find(|c| !is_number(c)).unwrap_or(rest.len());
        let (number, behind) = rest.split_at(rest[..end].trim_end_matches(',').len());
        let word: String = behind.trim_start().chars().take_while(char::is_ascii_alphabetic).collect();
        rest = behind.trim_start().strip_prefix(word.as_str()).unwrap_or(behind);
        if let Some(number) = value(number) {
            parts.push((number, word, follows));
        }
    }
    let factor = |word: &str| match word {
        "yd" | "yds" | "yard" | "yards" => Some(MM_PER_YARD),
        "ft" | "feet" => Some(MM_PER_FOOT),
        "in" | "inch" | "inches" => Some(MM_PER_INCH),
        "mm" => Some(1.0),
        "cm" | "cms" => Some(10.0),
        "m" | "mt" | "mts" => Some(1000.0),
        _ => None,
    };
    let mut lengths: Vec<f64> = Vec::new();
    // A smaller unit directly after a larger one adds to it.
    let mut before: Option<f64> = None;
    for (number, word, follows) in parts {
        let unit = factor(&word);
        if let Some(unit) = unit {
            match (before.filter(|_| follows), lengths.last_mut()) {
                (Some(larger), Some(last)) if unit < larger => *last += number * unit,
                _ => lengths.push(number * unit),
            }
        }
        before = unit;
    }
    lengths.into_iter()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_are_found_in_titles() {
        let check = |text: &str, expected: &[f64]| {
            let found: Vec<f64> = lengths(text.as_bytes()).map(|mm| (mm * 100.0).round() / 100.0).collect();
            assert_eq!(found, expected, "{text}");
        };
        check("LENGTH 7 yd 3.18 in  WIDTH 66.93 in", &[6481.57, 1700.02]);
        check("L=6.48m W=1700 mm 83.2%", &[6480.0, 1700.0]);
        check("SIZE 12 FRONT x2", &[]);
        check("2 m 35 cm", &[2350.0]);
        check("L 4,50 m, B 140,5 cm", &[4500.0, 1405.0]);
        check("1,700 mm", &[]);
    }

    #[test]
    fn sizes_are_found_in_titles() {
        let check = |text: &str, expected: &[[f64; 2]]| assert_eq!(sizes(text.as_bytes()), expected, "{text}");
        check("140.0 x 450.0", &[[140.0, 450.0]]);
        check("Marker 450,5X140 pieces", &[]);
        check("Marker 450,5X140, 12 pieces x2", &[[140.0, 450.5]]);
        check("FRONT x2, SIZE 38 x 40, 1,400 x 4,500, 140 x 450 cm, x", &[]);
    }
}
