//! Windows of a conveyor: the stretch of cloth that is cut in each, and the borders at which they split pieces.

use super::markup::PathData;
use crate::back::target::Context;
use crate::geom::{Extent, Point};
use crate::ir::Marker;
use crate::units::number::fixed;

/// Style class of the borders.
pub(super) const BORDER: &str = "border";
/// Width of a letter, as a fraction of the font size, at the most.
const LETTER_WIDTH: f64 = 0.62;

/// A window as drawn below the marker: a bar and its text.
pub(super) struct Window {
    /// Stretch of the cloth along X that is cut in it, mm.
    pub(super) ends: [f64; 2],
    /// Line of the legend, from 0.
    pub(super) row: usize,
    pub(super) words: String,
    /// Length of the words at the most, mm.
    pub(super) length: f64,
}

/// The windows of a marker, in order, with a font of `size` mm; empty where the cloth lies still. Bars and texts of a row are
/// free of each other.
pub(super) fn windows(marker: &Marker, size: f64) -> Vec<Window> {
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
        let length = words.len() as f64 * LETTER_WIDTH * size;
        let row = rows.iter().position(|&last| last < ends[0]).unwrap_or(rows.len());
        rows.resize(rows.len().max(row + 1), 0.0);
        rows[row] = ends[1].max(ends[0] + length);
        Window { ends, row, words, length }
    };
    (1..).zip(found).map(place).collect()
}

/// Lines that the bars take in the legend, with a font of `size` mm.
pub(super) fn lines(context: &Context, size: f64) -> usize {
    windows(context.marker, size).iter().map(|window| window.row + 1).max().unwrap_or(0)
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
