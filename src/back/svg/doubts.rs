//! Doubts about pieces that are cut and about outlines that are not: a band along the outlines of each, wide enough for the
//! whole marker, and the table that explains the bands.

use std::fmt::Write;

use super::markup::{PathData, escape, mm};
use super::sheet::{LINE_PX, Sheet};
use crate::back::target::Context;
use crate::diagnostic::Diagnostic;
use crate::geom::{Extent, Point};
use crate::ir::drawing::{OPEN_OUTLINES, Vertex};
use crate::ir::marker::Piece;

/// Height of the sign of a doubt, nominal pixels.
const SIGN_PX: f64 = 22.0;
/// From the middle of a piece up to its sign, nominal pixels: above the number.
const RISE_PX: f64 = 24.0;

/// The name of the n-th doubt.
fn sign(n: usize) -> String {
    format!("?{}", n + 1)
}

/// The pieces that a doubt is about.
fn pieces<'a>(doubt: &'a Diagnostic, context: &'a Context) -> impl Iterator<Item = &'a Piece> {
    context.marker.pieces.iter().filter(|piece| doubt.pieces.contains(&piece.number))
}

/// The outlines that are not cut and that a doubt is about: all that were taken for the same.
fn uncut(doubt: &Diagnostic, context: &Context) -> Vec<Vec<Point>> {
    let aside = context.marker.drawing.iter().flat_map(|account| account.aside.each());
    let outlines: Vec<(&str, &[Vertex])> =
        aside.filter_map(|(class, line)| Some((class.filter(|class| OPEN_OUTLINES.contains(class))?, line))).collect();
    let is_at = |line: &[Vertex]| doubt.span.is_some_and(|span| line.iter().any(|vertex| vertex.span == span));
    let first = outlines.iter().find(|(_, line)| doubt.pieces.is_empty() && is_at(line));
    let alike = outlines.iter().filter(|(class, _)| first.is_some_and(|(first, _)| first == class));
    alike.map(|(_, line)| line.iter().map(|vertex| vertex.at).collect()).collect()
}

/// The bands and signs, in the coordinates of the sheet (Y down).
pub(super) fn layer(doubts: &[&Diagnostic], sheet: &Sheet, context: &Context) -> String {
    if doubts.is_empty() {
        return String::new();
    }
    let mut text = String::from("<g id=\"doubts\" inkscape:groupmode=\"layer\" inkscape:label=\"doubts\">\n");
    for (n, doubt) in doubts.iter().enumerate() {
        let of_pieces = pieces(doubt, context).map(|piece| {
            let closed = piece.contours.iter().filter(|c| c.closed);
            closed.map(|c| context.marker.points(c)).collect()
        });
        let outlines: Vec<Vec<Vec<Point>>> = of_pieces.chain([uncut(doubt, context)]).collect();
        for outlines in outlines.into_iter().filter(|outlines| !outlines.is_empty()) {
            let mut data = PathData::default();
            for outline in &outlines {
                data.line(outline.iter().map(|point| Point::new(point.x, -point.y)));
            }
            let Extent { min, max } = Extent::of(&outlines.concat());
            let middle = min + (max - min) / 2.0;
            let _infallible = write!(
                text,
                "<g><title>{} {}</title>\n{}<text class=\"doubt-sign\" x=\"{}\" y=\"{}\" font-size=\"{}\">{}</text></g>\n",
                sign(n),
                escape(&doubt.message),
                data.element("doubt"),
                mm(middle.x),
                mm(-middle.y - RISE_PX * sheet.px),
                mm(SIGN_PX * sheet.px),
                sign(n)
            );
        }
    }
    text.push_str("</g>\n");
    text
}

/// The table, from its first line on.
pub(super) fn table(doubts: &[&Diagnostic], sheet: &Sheet, mut at: Point) -> String {
    if doubts.is_empty() {
        return String::new();
    }
    let mut text = sheet.text("doubt-text", at, "doubtful, to be checked before cutting:");
    for (n, doubt) in doubts.iter().enumerate() {
        at.y += LINE_PX * sheet.px;
        text.push_str(&sheet.text("doubt-text", at, &format!("{}  {}", sign(n), doubt.message)));
    }
    text
}
