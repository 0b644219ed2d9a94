//! Basic shapes as path steps (SVG 2, 10).

use std::ops::Range;

use roxmltree::Node;

use super::length::Length;
use super::path::{self, Arc, Fault, Step};
use super::scan::Scan;
use super::transform::Pair;

/// A fault of an attribute: its name and a description.
pub(super) type BadValue = (&'static str, &'static str);

/// Reference sizes for the lengths of an element.
#[derive(Debug, Clone, Copy)]
pub(super) struct Measure {
    /// Size of a pixel, mm.
    pub(super) pixel: f64,
    /// Reference width and height of percentages, in units of the file.
    pub(super) whole: Pair,
}

/// Reference of a percentage.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Of {
    Width,
    Height,
    Both,
}

impl Measure {
    /// An attribute as a length in units of the file; `None` if it is missing or `auto`.
    pub(super) fn length(self, node: Node, name: &'static str, of: Of) -> Result<Option<f64>, BadValue> {
        let text = node.attribute(name).map(str::trim).filter(|text| !text.is_empty() && *text != "auto");
        let Some(text) = text else { return Ok(None) };
        let length = Length::read(text).ok_or((name, "this is no length that can be read"))?;
        let [width, height] = self.whole;
        let whole = match of {
            Of::Width => width,
            Of::Height => height,
            Of::Both => width.hypot(height) / std::f64::consts::SQRT_2,
        };
        Ok(Some(length.units(self.pixel, whole)))
    }

    /// An attribute as a length, by default 0.
    pub(super) fn place(self, node: Node, name: &'static str, of: Of) -> Result<f64, BadValue> {
        Ok(self.length(node, name, of)?.unwrap_or(0.0))
    }

    /// An attribute as a length; an error if negative.
    pub(super) fn size(self, node: Node, name: &'static str, of: Of) -> Result<Option<f64>, BadValue> {
        match self.length(node, name, of)? {
            Some(size) if size < 0.0 => Err((name, "a size must not be negative")),
            size => Ok(size),
        }
    }
}

/// Attributes with the measures of each shape. Those with more than one letter may be misspelt.
#[rustfmt::skip] // a table: one row a shape
const MEASURES: &[(&str, &[&str])] = &[
    ("rect", &["width", "height"]),
    ("circle", &["cx", "cy"]),
    ("ellipse", &["cx", "cy", "rx", "ry"]),
    ("line", &["x1", "y1", "x2", "y2"]),
    ("polyline", &["points"]),
    ("polygon", &["points"]),
];
/// Attributes without which a shape is empty.
const NEEDED: &[(&str, &str)] = &[("rect", "width"), ("rect", "height"), ("circle", "r")];

/// Checks that no measure of a shape is lost, by a letter in its name or altogether.
pub(super) fn check(node: Node) -> Result<(), BadValue> {
    let shape = node.tag_name().name();
    let plain = || node.attributes().filter(|attribute| attribute.namespace().is_none());
    let of = |rows: &'static [(&str, &[&str])]| rows.iter().find(|row| row.0 == shape).map_or(&[][..], |row| row.1);
    let measures = of(MEASURES);
    for name in measures.iter().filter(|name| !node.has_attribute(**name)) {
        let is_like = |other: &str| !measures.contains(&other) && strsim::damerau_levenshtein(other, name) == 1;
        if plain().any(|attribute| is_like(attribute.name())) {
            return Err((name, "it is missing, and another is spelt nearly like it"));
        }
    }
    if shape == "path" && !node.has_attribute("d") {
        let is_data = |text: &str| path::read(text).is_ok_and(|steps| steps.len() > 1);
        if plain().any(|attribute| is_data(attribute.value())) {
            return Err(("d", "it is missing, and another holds such data"));
        }
    }
    match NEEDED.iter().find(|(of, name)| *of == shape && !node.has_attribute(*name)) {
        Some((_, name)) => Err((name, "without it nothing would be drawn")),
        None => Ok(()),
    }
}

/// A rectangle with optional rounded corners; empty if a side is zero.
pub(super) fn rectangle(node: Node, by: Measure) -> Result<Vec<Step>, BadValue> {
    let (x, y) = (by.place(node, "x", Of::Width)?, by.place(node, "y", Of::Height)?);
    let width = by.size(node, "width", Of::Width)?.unwrap_or(0.0);
    let height = by.size(node, "height", Of::Height)?.unwrap_or(0.0);
    let radii = [by.size(node, "rx", Of::Width)?, by.size(node, "ry", Of::Height)?];
    if width == 0.0 || height == 0.0 {
        return Ok(Vec::new());
    }
    let rx = radii[0].or(radii[1]).unwrap_or(0.0).min(width / 2.0);
    let ry = radii[1].or(radii[0]).unwrap_or(0.0).min(height / 2.0);
    let (right, bottom) = (x + width, y + height);
    if rx == 0.0 || ry == 0.0 {
        let corners = [[right, y], [right, bottom], [x, bottom]].map(Step::Line);
        return Ok([Step::Move([x, y])].into_iter().chain(corners).chain([Step::Close]).collect());
    }
    let corner = |to| Step::Arc(Arc { radii: [rx, ry], turn: 0.0, is_large: false, is_growing: true, to });
    Ok(vec![
        Step::Move([x + rx, y]),
        Step::Line([right - rx, y]),
        corner([right, y + ry]),
        Step::Line([right, bottom - ry]),
        corner([right - rx, bottom]),
        Step::Line([x + rx, bottom]),
        corner([x, bottom - ry]),
        Step::Line([x, y + ry]),
        corner([x + rx, y]),
        Step::Close,
    ])
}

/// Centre and semi-axes of a circle or an ellipse; `None` if a semi-axis is zero.
pub(super) fn ellipse(node: Node, by: Measure) -> Result<Option<[Pair; 2]>, BadValue> {
    let centre = [by.place(node, "cx", Of::Width)?, by.place(node, "cy", Of::Height)?];
    let radii = if node.tag_name().name() == "circle" {
        [by.size(node, "r", Of::Both)?; 2]
    } else {
        let [rx, ry] = [by.size(node, "rx", Of::Width)?, by.size(node, "ry", Of::Height)?];
        [rx.or(ry), ry.or(rx)]
    };
    let radii = radii.map(|radius| radius.unwrap_or(0.0));
    Ok(radii.iter().all(|&radius| radius > 0.0).then_some([centre, radii]))
}

/// A line.
pub(super) fn line(node: Node, by: Measure) -> Result<Vec<Step>, BadValue> {
    let from = [by.place(node, "x1", Of::Width)?, by.place(node, "y1", Of::Height)?];
    let to = [by.place(node, "x2", Of::Width)?, by.place(node, "y2", Of::Height)?];
    Ok(vec![Step::Move(from), Step::Line(to)])
}

/// The points of a polyline or polygon, each with its byte range.
pub(super) fn points(text: &str) -> Result<Vec<(Step, Range<usize>)>, Fault> {
    let mut scan = Scan::of(text);
    let mut steps = Vec::new();
    scan.pass_blanks();
    while !scan.is_at_end() {
        let from = scan.byte();
        let mut number = || {
            let number = scan.number();
            let found = number.ok_or(Fault { at: scan.byte(), what: "a number of a pair is missing" });
            scan.pass_separator();
            found
        };
        let at = [number()?, number()?];
        let step = if steps.is_empty() { Step::Move(at) } else { Step::Line(at) };
        let end = from + text[from..scan.byte()].trim_end_matches([' ', ',', '\t', '\n', '\r']).len();
        steps.push((step, from..end));
    }
    Ok(steps)
}
