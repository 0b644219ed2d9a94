//! The layer of findings: a ring around the worst place under each rule, and the table that explains the rings.

use std::fmt::Write;

use super::knife::symbol_width;
use super::mark::Mark;
use super::markup::{PathData, escape, mm};
use super::sheet::Sheet;
use crate::geom::{Point, Vector};
use crate::machine::Knife;
use crate::units::number::fixed;

/// Radii of rings, nominal pixels.
const FAILS_RADIUS_PX: f64 = 13.0;
const HOLDS_RADIUS_PX: f64 = 8.0;
/// Height of a ring's letter, nominal pixels.
const LETTER_PX: f64 = 13.0;
/// Radius of the cross at the place itself, in blade widths.
const CROSS_RADIUS: f64 = 0.15;

/// Letter of the n-th finding, to distinguish it from piece numbers: A to Z, then AA to AZ, and so on.
fn letter(n: usize) -> String {
    let last = char::from(b'A' + (n % 26) as u8);
    if n < 26 { last.to_string() } else { letter(n / 26 - 1) + &last.to_string() }
}

/// The layer, in the coordinates of the sheet (Y down).
pub(super) fn layer(marks: &[Mark], sheet: &Sheet, knife: &Knife) -> String {
    if marks.is_empty() {
        return String::new();
    }
    let mut text = String::from("<g id=\"findings\" inkscape:groupmode=\"layer\" inkscape:label=\"findings\">\n");
    let mut lettered: Vec<Point> = Vec::new();
    // Draw the rules that hold first, so that failures lie on top.
    for fails in [false, true] {
        for (n, mark) in marks.iter().enumerate().filter(|(_, mark)| mark.holds != fails) {
            let Some(sighting) = mark.place else { continue };
            let at = Point::new(sighting.point.x, -sighting.point.y);
            if !(at.x.is_finite() && at.y.is_finite()) {
                continue;
            }
            let radius = sheet.px * if fails { FAILS_RADIUS_PX } else { HOLDS_RADIUS_PX };
            let class = if fails { "fails" } else { "holds" };
            let mut data = PathData::default();
            data.circle(at, radius);
            let arm = CROSS_RADIUS * symbol_width(knife);
            for arm in [Vector::new(arm, arm), Vector::new(arm, -arm)] {
                data.line([at - arm, at + arm]);
            }
            // Letters at one place are set side by side.
            let beside = lettered.iter().filter(|other| (**other - at).norm() < 2.0 * radius).count();
            lettered.push(at);
            let shift = radius + sheet.px * (2.0 + LETTER_PX * beside as f64);
            let _infallible = write!(
                text,
                "<g><title>{}</title>\n{}<text class=\"{class}-text\" x=\"{}\" y=\"{}\" font-size=\"{}\">{}</text></g>\n",
                escape(&sentence(n, mark)),
                data.element(class),
                mm(at.x + shift),
                mm(at.y - radius / 2.0),
                mm(LETTER_PX * sheet.px),
                letter(n)
            );
        }
    }
    text.push_str("</g>\n");
    text
}

/// A finding in one line: letter, rule, values, place.
pub(super) fn sentence(n: usize, mark: &Mark) -> String {
    let mut text = format!("{}  {}  {}", letter(n), mark.name, mark.verdict);
    if let Some(place) = mark.place {
        let _infallible = write!(text, ", at X {} Y {} mm", fixed(place.point.x, 2), fixed(place.point.y, 2));
        if let Some(time) = place.time {
            let _infallible = write!(text, ", {} s", fixed(time, 3));
        }
        if place.block > 0 {
            let _infallible = write!(text, ", block {}", place.block);
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_finding_has_a_letter_of_its_own() {
        let letters: Vec<String> = [0, 25, 26, 51, 52, 701, 702].into_iter().map(letter).collect();
        assert_eq!(letters, ["A", "Z", "AA", "AZ", "BA", "ZZ", "AAA"]);
    }
}
