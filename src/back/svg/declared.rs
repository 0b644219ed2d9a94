//! Declared deviations: a mark at the worst place of each kind, and the table that explains the marks.

use std::fmt::Write;

use super::markup::{PathData, mm};
use super::sheet::{LINE_PX, Sheet};
use crate::geom::{Point, Vector};
use crate::ir::declaration::Total;

/// Distance from the centre of a mark to its corners, and height of its letter, nominal pixels.
const MARK_PX: f64 = 5.0;
const LETTER_PX: f64 = 11.0;

/// Letter of the n-th kind: lower case, to distinguish it from findings.
fn letter(n: usize) -> char {
    char::from(b'a' + n as u8)
}

/// The marks, in the coordinates of the sheet (Y down).
pub(super) fn layer(declared: &[Total], sheet: &Sheet) -> String {
    if declared.is_empty() {
        return String::new();
    }
    let mut text = String::from("<g id=\"declared\" inkscape:groupmode=\"layer\" inkscape:label=\"declared\">\n");
    let arm = MARK_PX * sheet.px;
    let mut lettered: Vec<Point> = Vec::new();
    for (n, total) in declared.iter().enumerate() {
        let at = Point::new(total.at_mm[0], -total.at_mm[1]);
        let corners = [(arm, 0.0), (0.0, arm), (-arm, 0.0), (0.0, -arm), (arm, 0.0)];
        let mut data = PathData::default();
        data.line(corners.map(|(x, y)| at + Vector::new(x, y)));
        // Letters at one place are set side by side, to the left; those of findings are on the right.
        let beside = lettered.iter().filter(|other| (**other - at).norm() < 2.0 * arm).count();
        lettered.push(at);
        let shift = arm + sheet.px * LETTER_PX * (1 + beside) as f64;
        let _infallible = write!(
            text,
            "<g><title>{}  {total}</title>\n{}<text class=\"declared-text\" x=\"{}\" y=\"{}\" font-size=\"{}\">{}</text></g>\n",
            letter(n),
            data.element("declared"),
            mm(at.x - shift),
            mm(at.y + arm),
            mm(LETTER_PX * sheet.px),
            letter(n)
        );
    }
    text.push_str("</g>\n");
    text
}

/// The table, with its first line at a point.
pub(super) fn table(declared: &[Total], sheet: &Sheet, mut at: Point) -> String {
    if declared.is_empty() {
        return String::new();
    }
    let mut text = sheet.text("declared-text", at, "beside the drawing, as the program declares:");
    for (n, total) in declared.iter().enumerate() {
        at.y += LINE_PX * sheet.px;
        text.push_str(&sheet.text("", at, &format!("{}  {total}", letter(n))));
    }
    text
}
