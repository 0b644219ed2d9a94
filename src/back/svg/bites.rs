//! Windows of a conveyor: a bar for each below the drawing, as long as the stretch of cloth that is cut in it, and the borders
//! at which they split pieces.

use super::markup::PathData;
use super::piece::PALETTE;
use super::sheet::{LINE_PX, Sheet, TEXT_PX};
use crate::back::target::Context;
use crate::geom::{Extent, Point, Vector};
use crate::ir::Marker;
use crate::units::number::fixed;

/// Style class of the borders.
pub(super) const BORDER: &str = "border";
/// Width of a letter, as a fraction of the font size, at the most.
const LETTER_WIDTH: f64 = 0.62;
/// Height of the ends of a bar, and the distance of its text from it, pixels.
const END_PX: f64 = 5.0;
const TEXT_BELOW_PX: f64 = 9.0;

/// A window as drawn.
struct Window {
    /// Stretch of the cloth along X that is cut in it, mm.
    ends: [f64; 2],
    /// Line of the legend, from 0.
    row: usize,
    words: String,
}

/// The windows of a marker, in order; empty where the cloth lies still. Bars and texts of a row are free of each other.
fn windows(marker: &Marker, px: f64) -> Vec<Window> {
    let stations = marker.stations();
    if stations.iter().all(|&station| station == 0) {
        return Vec::new();
    }
    let mut found: Vec<(u32, [f64; 2])> = Vec::new();
    for (piece, &station) in stations.iter().enumerate() {
        let Some(ends) = marker.cut_ends(piece) else { continue };
        match found.last_mut().filter(|last| last.0 == station) {
            Some((_, [from, to])) => (*from, *to) = (from.min(ends[0]), to.max(ends[1])),
            None => found.push((station, ends)),
        }
    }
    let mut rows: Vec<f64> = Vec::new();
    let place = |(number, (station, ends)): (usize, (u32, [f64; 2]))| {
        let words = format!("bite {number}, cloth moved {station} mm");
        let end = ends[1].max(ends[0] + length(&words, px));
        let row = rows.iter().position(|&last| last < ends[0]).unwrap_or(rows.len());
        rows.resize(rows.len().max(row + 1), end);
        rows[row] = end;
        Window { ends, row, words }
    };
    (1..).zip(found).map(place).collect()
}

/// Length of a text at the most, mm.
fn length(words: &str, px: f64) -> f64 {
    words.len() as f64 * LETTER_WIDTH * TEXT_PX * px
}

/// Lines that the bars take in the legend, with the size of a nominal pixel, mm.
pub(super) fn lines(context: &Context, px: f64) -> usize {
    windows(context.marker, px).iter().map(|window| window.row + 1).max().unwrap_or(0)
}

/// The bars, at their places along X, with the top of the first line.
pub(super) fn bars(context: &Context, sheet: &Sheet, top: f64) -> String {
    let mut text = String::new();
    for (i, Window { ends: [from, to], row, words }) in windows(context.marker, sheet.px).into_iter().enumerate() {
        let y = top + LINE_PX * sheet.px * row as f64;
        let down = Vector::new(0.0, END_PX * sheet.px);
        let [start, end] = [from, to].map(|x| Point::new(x, y));
        let mut data = PathData::default();
        data.line([start + down, start, end, end + down]);
        text.push_str(&format!("<g color=\"{}\">{}", PALETTE[i % PALETTE.len()], data.element("run").trim_end()));
        let most = sheet.left + sheet.width - length(&words, sheet.px);
        let at = Point::new((start.x + END_PX * sheet.px).min(most), y + TEXT_BELOW_PX * sheet.px);
        text.push_str(&sheet.text("", at, &words));
        text.push_str("</g>\n");
    }
    text
}

/// Borders at which windows split pieces: the stretch of cloth within each piece.
fn borders(marker: &Marker) -> Vec<([Point; 2], String)> {
    let owners = marker.owners();
    let early = owners.iter().enumerate().filter(|(i, owner)| i != *owner);
    let border = |(i, &owner): (usize, &usize)| {
        let [_, x] = marker.pieces[i].section?;
        let mut across = Extent::EMPTY;
        for contour in &marker.pieces[owner].contours {
            for [from, to] in marker.list.lines(contour.range).filter(|[from, to]| (from.x < x) != (to.x < x)) {
                across.add(from + (to - from) * ((x - from.x) / (to.x - from.x)));
            }
        }
        let title = format!("piece {} is split at X {}", marker.pieces[owner].name(), fixed(x, 1));
        (!across.is_empty()).then_some(([across.min, across.max], title))
    };
    early.filter_map(border).collect()
}

/// Text of the legend about the borders; `None` where no piece is split.
pub(super) fn meaning(context: &Context) -> Option<String> {
    let count = borders(context.marker).len();
    (count > 0).then(|| format!("split between bites: {count}"))
}

/// The layer of the borders.
pub(super) fn layer(context: &Context) -> String {
    let borders = borders(context.marker);
    if borders.is_empty() {
        return String::new();
    }
    let name = "inkscape:groupmode=\"layer\" inkscape:label=\"splits between bites\"";
    let mut text = format!("<g id=\"bites\" {name} transform=\"scale(1,-1)\">\n");
    for (ends, title) in borders {
        let mut data = PathData::default();
        data.line(ends);
        text.push_str(&data.titled(BORDER, &title));
    }
    text.push_str("</g>\n");
    text
}
