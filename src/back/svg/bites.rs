//! Windows of a conveyor: the stretch of cloth that is cut in each, and the borders at which they split pieces.

use std::ops::Range;

use super::markup::PathData;
use crate::back::target::Context;
use crate::geom::{Extent, Point};
use crate::ir::Marker;
use crate::units::number::fixed;

/// Style class of the borders.
pub(super) const BORDER: &str = "border";
/// Width of a letter, as a fraction of the font size, at the most.
const LETTER_WIDTH: f64 = 0.62;
/// Distance of the words from the end of their bar, as a multiple of the font size.
const INDENT: f64 = 0.4;

/// A window as drawn below the marker: a bar and its text.
pub(super) struct Window {
    /// Its place among all windows, from 0: that of its colour.
    pub(super) index: usize,
    /// Stretch of the cloth along X that is cut in it, mm.
    pub(super) ends: [f64; 2],
    /// Line of the legend, from 0.
    pub(super) row: usize,
    pub(super) words: String,
    /// Left end of the words, mm.
    pub(super) words_at: f64,
}

/// The windows of a marker in which anything is cut, in order, with a font of `size` mm; empty where the cloth lies still. Words
/// end within `right`. Bars and words of a row are free of each other.
pub(super) fn windows(marker: &Marker, size: f64, right: f64) -> Vec<Window> {
    let windows = marker.windows();
    if windows.iter().all(|&(station, _)| station == 0) {
        return Vec::new();
    }
    let mut rows: Vec<f64> = Vec::new();
    let place = |(index, (station, pieces)): (usize, (u32, Range<usize>))| {
        let all = pieces.filter_map(|piece| marker.cut_ends(piece));
        let ends = all.reduce(|[from, to], [start, end]| [from.min(start), to.max(end)])?;
        let words = format!("bite {}, cloth moved {station} mm", index + 1);
        let length = words.len() as f64 * LETTER_WIDTH * size;
        let words_at = (ends[0] + INDENT * size).min(right - length);
        let row = rows.iter().position(|&last| last < ends[0].min(words_at)).unwrap_or(rows.len());
        rows.resize(rows.len().max(row + 1), 0.0);
        rows[row] = ends[1].max(words_at + length);
        Some(Window { index, ends, row, words, words_at })
    };
    windows.into_iter().enumerate().filter_map(place).collect()
}

/// Lines that the bars take in the legend, with a font of `size` mm and words that end within `right`.
pub(super) fn lines(context: &Context, size: f64, right: f64) -> usize {
    windows(context.marker, size, right).iter().map(|window| window.row + 1).max().unwrap_or(0)
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
        let title = format!("piece {} is split at X {} mm", marker.pieces[owner].name(), fixed(x, 1));
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
