//! The layer of labels: texts at their places, in their directions, as large as their pieces allow.
//!
//! Files give no letter height. Labels have a readable height, reduced where the text would extend beyond its piece. Labels at
//! one place are stacked, where a cutter would print them on top of each other.

use std::collections::BTreeMap;
use std::fmt::Write;

use super::markup::{blocks, escape, mm};
use super::piece::Shape;
use super::sheet::Sheet;
use crate::back::target::Context;
use crate::geom::{Heading, Point, Vector, left, ring};
use crate::ir::marker::{Label, Piece};
use crate::source::Span;
use crate::units::deg;
use crate::units::number::fixed;

/// Maximum letter height, nominal pixels.
const MOST_PX: f64 = 13.0;
/// Minimum letter height, mm: a text without room is still readable in a view of the piece.
const LEAST: f64 = 1.5;
/// Width of a letter and of an ideograph, in heights: a generous average, since the viewer chooses the font.
const LETTER_WIDTH: f64 = 0.66;
const IDEOGRAPH_WIDTH: f64 = 1.02;
/// First character that is as wide as it is high: Hangul, kana, ideographs.
const IDEOGRAPHS_FROM: char = '\u{1100}';
/// Ascent and descent of letters, and distance between lines, in heights.
const ASCENT: f64 = 0.78;
const DESCENT: f64 = 0.24;
const LINE: f64 = 1.2;
/// Maximum number of labels per piece that are fitted; the others are small. It bounds the work on files of labels only.
const MEASURED: usize = 64;
/// Free space between a text and the lines around it, in heights.
const GAP: f64 = 0.3;
/// Tolerance for a point behind the place of a text, mm: far below the visible.
const AHEAD_EPSILON: f64 = 1e-9;

/// Texts at one place, stacked.
struct Block<'a> {
    at: Point,
    heading: Heading,
    labels: Vec<(&'a Label, String)>,
}

/// The layer. Adds the texts to the places that piece numbers avoid.
pub(super) fn layer(shapes: &mut [Shape], sheet: &Sheet, context: &Context) -> String {
    let mut text = String::new();
    for (shape, piece) in shapes.iter_mut().zip(&context.marker.pieces) {
        for label in piece.labels.iter().filter(|label| label.at.is_none()) {
            shape.say(&text_of(label.span, context));
        }
        let mut drawn = String::new();
        for (i, block) in blocks_of(piece, shape, context).iter().enumerate() {
            if i >= MEASURED {
                block.draw(LEAST, context, &mut drawn);
                continue;
            }
            let height = block.height(shape, sheet);
            block.draw(height, context, &mut drawn);
            shape.keep_off(block.edges(height));
        }
        if !drawn.is_empty() {
            let _infallible = writeln!(text, "<g inkscape:label=\"labels of piece {}\">\n{drawn}</g>", piece.name());
        }
    }
    if text.is_empty() {
        return text;
    }
    format!(
        "<g id=\"labels\" inkscape:groupmode=\"layer\" inkscape:label=\"labels\" transform=\"scale(1,-1)\">\n{text}</g>\n"
    )
}

fn text_of(span: Span, context: &Context) -> String {
    context.marker.letters(&context.job.profile.labels).text(context.source.slice(span))
}

/// The non-empty labels of a piece, grouped by place and direction. Labels without a place go to the middle of the piece.
fn blocks_of<'a>(piece: &'a Piece, shape: &Shape, context: &Context) -> Vec<Block<'a>> {
    let has_lost = piece.labels.iter().any(|label| label.at.is_none());
    let middle = if has_lost { shape.middle() } else { None };
    let mut found: Vec<Block> = Vec::new();
    let mut places: BTreeMap<[u64; 3], usize> = BTreeMap::new();
    for label in &piece.labels {
        let Some(at) = label.at.or(middle) else { continue };
        let text = text_of(label.span, context);
        if text.trim().is_empty() {
            continue;
        }
        let heading = label.heading.unwrap_or(Heading::new(0.0));
        let next = found.len();
        let index = *places.entry([at.x, at.y, heading.radians()].map(f64::to_bits)).or_insert(next);
        if index == next {
            found.push(Block { at, heading, labels: Vec::new() });
        }
        found[index].labels.push((label, text));
    }
    found
}

impl Block<'_> {
    /// Extent of the texts from their place along and across their direction, in heights: forward, up and down.
    fn reach(&self) -> [f64; 3] {
        let width = |text: &str| text.chars().map(width).sum::<f64>();
        let forward = self.labels.iter().map(|(_, text)| width(text)).fold(0.0, f64::max);
        let lines = self.labels.len() as f64;
        [forward + GAP, ASCENT + GAP, DESCENT + GAP + LINE * (lines - 1.0)]
    }

    /// Height of the letters, mm.
    fn height(&self, shape: &Shape, sheet: &Sheet) -> f64 {
        let inside = shape.rings().iter().filter(|ring| ring::contains(ring, self.at)).count() % 2 == 1;
        let edge = sheet.edge();
        let outlines: Vec<&[Point]> =
            if inside { shape.contours.iter().map(|c| c.points.as_slice()).collect() } else { vec![&edge] };
        let reach = self.reach();
        let chords = outlines.iter().flat_map(|outline| outline.windows(2));
        let free =
            chords.map(|ends| touch([self.seen(ends[0]), self.seen(ends[1])], reach)).fold(f64::INFINITY, f64::min);
        free.min(MOST_PX * sheet.px).max(LEAST)
    }

    /// A point relative to the place of the texts, along and across their direction.
    fn seen(&self, point: Point) -> Vector {
        let (along, from) = (self.heading.unit(), point - self.at);
        Vector::new(from.dot(&along), from.dot(&left(along)))
    }

    /// Points on the upper and lower edges of the texts, one height apart.
    fn edges(&self, height: f64) -> Vec<Point> {
        let [forward, ..] = self.reach();
        let along = self.heading.unit();
        let steps = forward.ceil() as usize;
        let letters: Vec<Vector> = (0..=steps).map(|i| along * (height * (i as f64).min(forward))).collect();
        let levels = (0..self.labels.len()).flat_map(|k| [ASCENT - LINE * k as f64, -DESCENT - LINE * k as f64]);
        let lines = levels.map(|level| self.at + left(along) * (height * level));
        lines.flat_map(|line| letters.iter().map(move |&letter| line + letter)).collect()
    }

    fn draw(&self, height: f64, context: &Context, out: &mut String) {
        for (k, (label, text)) in self.labels.iter().enumerate() {
            let mut title = format!("label{}", blocks([label.span]));
            if let Some(mirrored) = label.mirrored {
                let _infallible = write!(title, ", on mirrored pieces: {}", text_of(mirrored, context));
            }
            let _infallible = writeln!(
                out,
                "<text class=\"label\" transform=\"translate({},{}) rotate({}) scale(1,-1)\" y=\"{}\" font-size=\"{}\">{}\
                 <title>{}</title></text>",
                mm(self.at.x),
                mm(self.at.y),
                fixed(deg(self.heading.radians()), 3),
                mm(LINE * height * k as f64),
                mm(height),
                escape(text),
                escape(&title)
            );
        }
    }
}

fn width(c: char) -> f64 {
    if c >= IDEOGRAPHS_FROM { IDEOGRAPH_WIDTH } else { LETTER_WIDTH }
}

/// The height at which texts of some extent (in heights: forward, up, down) touch a chord given relative to their place;
/// infinite when they never do.
///
/// The box of the texts grows with the height about their place, so it touches a point at the greatest of `x / forward`, `y /
/// up` and `-y / down` (the gauge of a convex set: Rockafellar, Convex Analysis, 1970, section 4). Along a chord this function
/// is convex and piecewise linear: its minimum is at an end or where two of the three are equal.
fn touch([a, b]: [Vector; 2], [forward, up, down]: [f64; 3]) -> f64 {
    let chord = b - a;
    // Zero of a linear function along the chord.
    let zero = |at_a: f64, slope: f64| if slope == 0.0 { f64::NAN } else { -at_a / slope };
    let against = |reach: f64| zero(a.x / forward - a.y / reach, chord.x / forward - chord.y / reach);
    let shares = [0.0, 1.0, zero(a.x, chord.x), zero(a.y, chord.y), against(up), against(-down)];
    let heights = shares.into_iter().filter(|share| (0.0..=1.0).contains(share)).map(|share| {
        let point = a + chord * share;
        // There are no texts behind their place; a crossing that is behind by rounding only counts as ahead.
        if point.x < -AHEAD_EPSILON {
            f64::INFINITY
        } else {
            (point.x / forward).max(point.y / up).max(-point.y / down)
        }
    });
    heights.fold(f64::INFINITY, f64::min)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_text_grows_until_it_touches_a_line() {
        let check = |a: (f64, f64), b: (f64, f64), expected: f64| {
            let height = touch([Vector::new(a.0, a.1), Vector::new(b.0, b.1)], [10.0, 1.0, 0.5]);
            assert!(height == expected || (height - expected).abs() < 1e-9, "{a:?} {b:?}: {height}");
        };
        // A wall ahead, a lid, a floor, and a slope that the upper far corner meets.
        check((30.0, -50.0), (30.0, 50.0), 3.0);
        check((-50.0, 4.0), (50.0, 4.0), 4.0);
        check((-50.0, -1.0), (50.0, -1.0), 2.0);
        check((0.0, 2.0), (20.0, 0.0), 1.0);
        // A line behind is never touched; a line through the place leaves no room.
        check((-1.0, -5.0), (-1.0, 5.0), f64::INFINITY);
        check((-3.0, -3.0), (3.0, 3.0), 0.0);
    }
}
