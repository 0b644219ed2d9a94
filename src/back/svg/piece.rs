//! The layer of pieces: their areas in calm colours, their notches, and their numbers.

use std::fmt::Write;

use super::markup::{PathData, blocks, escape, mm};
use super::sheet::Sheet;
use super::spot::{self, Spot};
use crate::geom::{Extent, Point};
use crate::ir::Marker;
use crate::ir::marker::{self, NotchForm, NotchKind, Piece};
use crate::source::Span;
use crate::units::number::fixed;

/// Colours of pieces, of similar weight, away from the signal colours (magenta, red, amber) and the grey of travels.
pub(super) const PALETTE: [&str; 10] =
    ["#3f6fa3", "#4f8f46", "#8a6bb0", "#8d6546", "#2f8c8c", "#8a8a2e", "#5b63c4", "#b0705a", "#4a7c63", "#6d86ad"];
/// Distance below which pieces are neighbours, mm.
const NEIGHBOUR_GAP: f64 = 40.0;
/// Number of previous pieces searched for neighbours: a marker is cut from one end to the other.
const NEIGHBOUR_WINDOW: usize = 200;
/// Maximum height of a number, nominal pixels.
const NUMBER_MAX_PX: f64 = 26.0;
/// Width of a digit and height of a number, as fractions of the font size.
const DIGIT_WIDTH: f64 = 0.64;
const DIGIT_HEIGHT: f64 = 0.73;
/// Margin around the view of one piece, as a fraction of its larger side.
const VIEW_MARGIN: f64 = 0.06;

/// A piece as drawn.
#[derive(Debug)]
pub(super) struct Shape {
    /// Number in the file.
    number: u32,
    /// Number in the file, with its copy if there are several.
    name: String,
    /// Index of its conveyor window, from 0; `None` where the cloth does not advance.
    bite: Option<usize>,
    /// Contours.
    pub(super) contours: Vec<Contour>,
    /// Places that its number avoids: its drills and labels.
    taken: Vec<Point>,
    notches: Vec<Notch>,
    extent: Extent,
    /// Title, shown by browsers under the pointer.
    title: String,
}

/// A contour as drawn.
#[derive(Debug)]
pub(super) struct Contour {
    /// Vertices; a closed contour ends with its first point.
    pub(super) points: Vec<Point>,
    /// True if it ends where it starts.
    pub(super) closed: bool,
}

/// A notch as drawn: a slit has two points, a notch of an outline three.
#[derive(Debug)]
struct Notch {
    points: Vec<Point>,
    title: String,
}

impl Shape {
    /// Adds a text without a place to the title of the piece.
    pub(super) fn say(&mut self, text: &str) {
        let _infallible = write!(self.title, ", label: {text}");
    }

    /// Adds places that the number avoids.
    pub(super) fn keep_off(&mut self, places: impl IntoIterator<Item = Point>) {
        self.taken.extend(places);
    }

    /// Place of a text to which the file gives none: the spot of the number, inside the piece.
    pub(super) fn middle(&self) -> Option<Point> {
        let Extent { min, max } = self.extent;
        let middle = || (!self.extent.is_empty()).then(|| min + (max - min) / 2.0);
        spot::find(&self.rings(), &self.taken).map(|spot| spot.at).or_else(middle)
    }

    /// The closed contours.
    pub(super) fn rings(&self) -> Vec<&[Point]> {
        self.contours.iter().filter(|c| c.closed).map(|c| c.points.as_slice()).collect()
    }
}

/// The shapes of all pieces, in cut order.
pub(super) fn shapes(marker: &Marker) -> Vec<Shape> {
    let mut shapes = Vec::with_capacity(marker.pieces.len());
    let windows = marker.windows();
    let has_bites = windows.iter().any(|&(station, _)| station > 0);
    let bites = windows.into_iter().enumerate().flat_map(|(bite, (_, pieces))| pieces.map(move |_| bite));
    for (piece, bite) in marker.pieces.iter().zip(bites) {
        let contours: Vec<Contour> =
            piece.contours.iter().map(|c| Contour { points: marker.points(c), closed: c.closed }).collect();
        let drills: Vec<Point> = piece.drills.iter().map(|drill| drill.at).collect();
        let mut extent = Extent::EMPTY;
        contours.iter().flat_map(|c| &c.points).chain(&drills).for_each(|&point| extent.add(point));
        piece
            .notches
            .iter()
            .flat_map(marker::Notch::strokes)
            .flat_map(|cut| [cut.from, cut.to])
            .for_each(|point| extent.add(point));
        let cut = piece.contours.iter().flat_map(|c| marker.list.walk(c.range)).map(|(_, segment)| segment.span);
        let marked = piece
            .drills
            .iter()
            .map(|d| d.span)
            .chain(piece.notches.iter().flat_map(marker::Notch::strokes).map(|cut| cut.span));
        let spans = std::iter::once::<Span>(piece.span).chain(cut).chain(marked);
        let (number, name) = (piece.number, piece.name());
        let place = shapes.len() + 1;
        let bite = Some(bite).filter(|_| has_bites);
        let window = bite.map_or_else(String::new, |bite| format!(", bite {}", bite + 1));
        let title = format!("piece {name}{window}, {place} of {} in cut order{}", marker.pieces.len(), blocks(spans));
        shapes.push(Shape { number, name, bite, extent, title, contours, taken: drills, notches: notches(piece) });
    }
    shapes
}

fn notches(piece: &Piece) -> Vec<Notch> {
    let slits = piece.notches.iter().map(|notch| {
        let kind = match notch.kind {
            NotchKind::Slit => "slit",
            NotchKind::T(_) => "T notch",
        };
        let title = format!("{kind}, {} mm deep{}", fixed(notch.depth(), 1), blocks([notch.span]));
        let bar = match notch.kind {
            NotchKind::Slit => vec![],
            NotchKind::T(bar) => vec![bar.from, bar.to, notch.tip],
        };
        Notch { points: [vec![notch.root, notch.tip], bar].concat(), title }
    });
    let of_outlines = piece.outline_notches.iter().map(|notch| {
        let (depth, width) = (fixed(notch.depth(), 1), fixed(notch.width(), 1));
        let kind = match notch.form {
            NotchForm::V => "V notch",
            NotchForm::Castle => "castle notch",
            NotchForm::U => "U notch",
        };
        let way = if notch.outwards { " outwards" } else { "" };
        let title = format!("{kind}{way}, {depth} mm deep, {width} mm wide{}", blocks([notch.span]));
        Notch { points: vec![notch.mouth[0], notch.tip, notch.mouth[1]], title }
    });
    slits.chain(of_outlines).collect()
}

/// Style rules that give each piece number its colour.
pub(super) fn colour_rules(shapes: &[Shape]) -> String {
    let colours = colours(shapes);
    let mut rules = String::new();
    for (i, colour) in PALETTE.iter().enumerate() {
        let mut separator = "";
        for (shape, _) in shapes.iter().zip(&colours).filter(|&(_, &c)| c == i) {
            let _infallible = write!(rules, "{separator}.n{}", shape.number);
            separator = ",";
        }
        if !separator.is_empty() {
            let _infallible = writeln!(rules, "{{color:{colour}}}");
        }
    }
    rules
}

/// An index into the palette for each piece: that of its conveyor window, otherwise the next one not used by a neighbour.
fn colours(shapes: &[Shape]) -> Vec<usize> {
    let mut colours: Vec<usize> = Vec::with_capacity(shapes.len());
    for (i, shape) in shapes.iter().enumerate() {
        if let Some(bite) = shape.bite {
            colours.push(bite % PALETTE.len());
            continue;
        }
        let mut taken = [false; PALETTE.len()];
        for k in i.saturating_sub(NEIGHBOUR_WINDOW)..i {
            taken[colours[k]] |= are_near(&shape.extent, &shapes[k].extent);
        }
        let next = i % PALETTE.len();
        let free = (0..PALETTE.len()).map(|step| (next + step) % PALETTE.len()).find(|&colour| !taken[colour]);
        colours.push(free.unwrap_or(next));
    }
    colours
}

fn are_near(a: &Extent, b: &Extent) -> bool {
    let apart = (a.min.x - b.max.x).max(b.min.x - a.max.x).max(a.min.y - b.max.y).max(b.min.y - a.max.y);
    apart < NEIGHBOUR_GAP
}

/// The layer: a group for each piece, and a view of each.
pub(super) fn layer(shapes: &[Shape], sheet: &Sheet) -> String {
    let mut text = String::new();
    for (shape, order) in shapes.iter().zip(1..).filter(|(shape, _)| !shape.extent.is_empty()) {
        let (width, height) = shape.extent.size();
        let margin = width.max(height).max(sheet.px) * VIEW_MARGIN;
        let _infallible = writeln!(
            text,
            "<view id=\"view-{order}\" viewBox=\"{} {} {} {}\"/>",
            mm(shape.extent.min.x - margin),
            mm(-shape.extent.max.y - margin),
            mm(width + 2.0 * margin),
            mm(height + 2.0 * margin)
        );
    }
    text.push_str(
        "<g id=\"pieces\" inkscape:groupmode=\"layer\" inkscape:label=\"pieces\" transform=\"scale(1,-1)\">\n",
    );
    for (shape, order) in shapes.iter().zip(1..) {
        group(shape, order, sheet, &mut text);
    }
    text.push_str("</g>\n");
    text
}

fn group(shape: &Shape, order: u32, sheet: &Sheet, text: &mut String) {
    let Shape { number, name, .. } = shape;
    let _infallible = writeln!(
        text,
        "<g id=\"piece-{order}\" class=\"n{number}\" inkscape:label=\"piece {name}\"><title>{}</title>",
        escape(&shape.title)
    );
    let rings = shape.rings();
    let mut area = PathData::default();
    for ring in &rings {
        area.polygon(ring[..ring.len() - 1].iter().copied());
    }
    text.push_str(&area.element("area"));
    for notch in &shape.notches {
        let mut data = PathData::default();
        data.line(notch.points.iter().copied());
        text.push_str(&data.titled("notch", &notch.title));
    }
    if !shape.extent.is_empty() {
        let middle = shape.extent.min + (shape.extent.max - shape.extent.min) / 2.0;
        let spot = spot::find(&rings, &shape.taken).unwrap_or(Spot { at: middle, clear: 0.0 });
        text.push_str(&label(name, order, spot, sheet));
    }
    text.push_str("</g>\n");
}

/// The number of a piece, as large as its spot allows, as a link to the view of the piece.
fn label(name: &str, order: u32, spot: Spot, sheet: &Sheet) -> String {
    let digits = name.len() as f64;
    let largest = NUMBER_MAX_PX * sheet.px;
    let fitting = spot.clear / (digits * DIGIT_WIDTH / 2.0).hypot(DIGIT_HEIGHT / 2.0);
    // A piece without an interior has a small number on its lines.
    let size = if spot.clear > 0.0 { fitting.min(largest) } else { largest / 2.0 };
    format!(
        "<a href=\"#view-{order}\"><text class=\"number\" transform=\"scale(1,-1)\" x=\"{}\" y=\"{}\" font-size=\"{}\">{name}</text></a>\n",
        mm(spot.at.x),
        mm(-spot.at.y + size * DIGIT_HEIGHT / 2.0),
        mm(size)
    )
}
