//! Doubts about pieces that are cut and about outlines that are not: a band along the outlines of each, wide enough to be seen
//! in a view of the whole marker, and the table that explains the bands.

use std::fmt::Write;

use super::markup::{PathData, escape, mm};
use super::sheet::{LINE_PX, Sheet};
use crate::back::target::Context;
use crate::diagnostic::Diagnostic;
use crate::geom::{Extent, Point};
use crate::ir::drawing::{BROKEN_OUTLINE, OPEN_LINE, OPEN_OUTLINE, Vertex};
use crate::ir::marker::Piece;

/// Height of the sign of a doubt, nominal pixels.
const SIGN_PX: f64 = 22.0;
/// Distance from the middle of a piece up to its sign, nominal pixels; the sign is above the number.
const RISE_PX: f64 = 24.0;

/// Sign of the n-th doubt.
fn sign(n: usize) -> String {
    format!("?{}", n + 1)
}

/// The pieces of a doubt.
fn pieces<'a>(doubt: &'a Diagnostic, context: &'a Context) -> impl Iterator<Item = &'a Piece> {
    context.marker.pieces.iter().filter(|piece| doubt.pieces.contains(&piece.number))
}

/// Band of a doubt at one place of the cloth.
struct Band {
    outlines: Vec<Vec<Point>>,
    /// Place below its sign.
    middle: Point,
}

impl Band {
    /// The band along outlines; its sign is above the middle of the box of `anchor`.
    fn new(outlines: Vec<Vec<Point>>, anchor: &[Point]) -> Self {
        let Extent { min, max } = Extent::of(anchor);
        Self { outlines, middle: min + (max - min) / 2.0 }
    }

    /// The band along the outlines of a piece, and along open contours where it has no others; `None` without any.
    fn of_piece(piece: &Piece, context: &Context) -> Option<Self> {
        let has_outline = piece.contours.iter().any(|contour| contour.closed);
        let contours = piece.contours.iter().filter(|contour| contour.closed || !has_outline);
        let outlines: Vec<Vec<Point>> = contours.map(|contour| context.marker.points(contour)).collect();
        let points = outlines.concat();
        (!points.is_empty()).then(|| Self::new(outlines, &points))
    }
}

/// Classes of lines that are not parts but may be outlines.
const UNCUT: [&str; 3] = [OPEN_LINE, OPEN_OUTLINE, BROKEN_OUTLINE];

/// Bands along uncut lines of the class that a doubt is about. Each open line has a band; all broken outlines share one, with
/// its sign at the outline that the doubt names.
fn uncut(doubt: &Diagnostic, context: &Context) -> Vec<Band> {
    let aside = context.marker.drawing.iter().flat_map(|account| account.aside.each());
    let outlines: Vec<(&str, &[Vertex])> =
        aside.filter_map(|(class, line)| Some((class.filter(|class| UNCUT.contains(class))?, line))).collect();
    let is_at = |line: &[Vertex]| doubt.span.is_some_and(|span| line.iter().any(|vertex| vertex.span == span));
    let Some(&(class, first)) = outlines.iter().find(|(_, line)| doubt.pieces.is_empty() && is_at(line)) else {
        return Vec::new();
    };
    let points = |line: &[Vertex]| line.iter().map(|vertex| vertex.at).collect::<Vec<Point>>();
    let alike = outlines.iter().filter(|(other, _)| *other == class).map(|(_, line)| points(line));
    if class == BROKEN_OUTLINE {
        vec![Band::new(alike.collect(), &points(first))]
    } else {
        alike.map(|line| Band::new(vec![line.clone()], &line)).collect()
    }
}

/// The bands and signs, in the coordinates of the sheet (Y down).
pub(super) fn layer(doubts: &[&Diagnostic], sheet: &Sheet, context: &Context) -> String {
    if doubts.is_empty() {
        return String::new();
    }
    let mut text = String::from("<g id=\"doubts\" inkscape:groupmode=\"layer\" inkscape:label=\"doubts\">\n");
    for (n, doubt) in doubts.iter().enumerate() {
        let of_pieces = pieces(doubt, context).filter_map(|piece| Band::of_piece(piece, context));
        for Band { outlines, middle } in of_pieces.chain(uncut(doubt, context)) {
            let mut data = PathData::default();
            for outline in &outlines {
                data.line(outline.iter().map(|point| Point::new(point.x, -point.y)));
            }
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

/// The table, with its first line at a point.
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
