//! Pen of the second reading of a plot, and its lines.

use crate::geom::Point;
use crate::geom::moments::Moments;
use crate::verify::source::census::{Census, Slack};

/// Maximum number of numbers of an instruction, except lists of places.
const MOST_NUMBERS: usize = 8;

/// Place, in units of the file.
pub(super) type Place = [f64; 2];

/// Pen, in units of the file before RO.
#[derive(Default)]
pub(super) struct Pen {
    pub(super) at: Place,
    pub(super) is_down: bool,
    pub(super) is_relative: bool,
    /// True if no pen is selected, so that nothing is drawn.
    pub(super) is_away: bool,
    /// Position of the instruction or number that last extended the stroke; `None` after the pen was lifted.
    pub(super) cause: Option<usize>,
}

/// Corner of a PM polygon.
pub(super) struct Corner {
    pub(super) at: Place,
    /// Position of the instruction or number that leads there.
    pub(super) cause: usize,
    pub(super) draws: bool,
}

pub(super) struct Scan<'a> {
    pub(super) bytes: &'a [u8],
    pub(super) at: usize,
    /// True if the whole file is UTF-8, so that high bytes of PE are pairs.
    pub(super) is_text: bool,
    pub(super) terminator: u8,
    pub(super) unit: f64,
    /// Sagitta of curves, in units of the file.
    pub(super) sagitta: f64,
    pub(super) pen: Pen,
    pub(super) corners: Option<[f64; 4]>,
    pub(super) page: Option<Place>,
    /// Offset and factor of each axis.
    pub(super) scale: Option<[Place; 2]>,
    /// Numbers of the SC instruction of the scale.
    pub(super) ranges: Vec<f64>,
    pub(super) quarters: u8,
    pub(super) polygon: Vec<Corner>,
    /// Start index of the current part of the polygon; and true if the next place starts another part.
    pub(super) part: Option<usize>,
    pub(super) is_fresh: bool,
    pub(super) census: Census,
    /// Moments since the pen was lifted: summing strokes separately reduces rounding.
    pub(super) stroke: Moments,
    pub(super) slack: Slack,
    /// Curves of the polygon.
    pub(super) curves: Vec<Gathered>,
    /// Strokes, if requested; and true if the next line begins one.
    pub(super) strokes: Option<Vec<Vec<Point>>>,
    pub(super) is_up: bool,
}

/// Curve as chords.
pub(super) struct Chords {
    /// End points of the chords.
    pub(super) points: Vec<Place>,
    /// Permitted difference of moments, as a share of the shortfall of the reader's chords.
    pub(super) share: f64,
}

/// Curve of the PM polygon, drawn whenever the polygon is.
#[derive(Debug, Clone, Copy)]
pub(super) struct Gathered {
    pub(super) from: Place,
    /// Index of its first corner in the polygon, and number of its corners.
    pub(super) first: usize,
    pub(super) count: usize,
    pub(super) share: f64,
}

impl Scan<'_> {
    /// Next number of the instruction.
    pub(super) fn number(&mut self) -> Option<f64> {
        let mut at = self.at;
        while self.bytes.get(at).is_some_and(|byte| b", \t\r\n".contains(byte)) {
            at += 1;
        }
        let start = at;
        at += usize::from(self.bytes.get(at).is_some_and(|byte| b"+-".contains(byte)));
        let mut has_point = false;
        while let Some(&byte) = self.bytes.get(at) {
            if !(byte.is_ascii_digit() || byte == b'.' && !has_point) {
                break;
            }
            has_point |= byte == b'.';
            at += 1;
        }
        let value = std::str::from_utf8(&self.bytes[start..at]).ok()?.parse().ok()?;
        self.at = at;
        Some(value)
    }

    pub(super) fn numbers(&mut self) -> Vec<f64> {
        (0..MOST_NUMBERS).map_while(|_| self.number()).collect()
    }

    pub(super) fn target(&self, [x, y]: Place, is_relative: bool) -> Place {
        let [offset, factor] = self.scale.unwrap_or([[0.0; 2], [1.0; 2]]);
        let from = if is_relative { self.pen.at } else { offset };
        [from[0] + x * factor[0], from[1] + y * factor[1]]
    }

    pub(super) fn lift(&mut self) {
        (self.pen.is_down, self.pen.cause) = (false, None);
    }

    /// Moves the pen; `cause` identifies the number or curve of the file that the move belongs to.
    pub(super) fn go(&mut self, to: Place, cause: usize, draws: bool) {
        let from = std::mem::replace(&mut self.pen.at, to);
        if self.part.is_some() {
            self.polygon.push(Corner { at: to, cause, draws });
        } else if !draws {
            self.pen.cause = None;
            self.end_stroke();
        } else if from != to {
            let (a, b) = (self.point(from), self.point(to));
            self.census.points += usize::from(self.pen.cause.replace(cause) != Some(cause));
            self.census.length += (b - a).norm();
            self.stroke += Moments::line(a, b);
            self.census.bounds.add(a);
            self.census.bounds.add(b);
            self.note([a, b]);
        }
    }

    /// Adds a line to the strokes.
    fn note(&mut self, [a, b]: [Point; 2]) {
        let is_new = std::mem::take(&mut self.is_up);
        let Some(strokes) = self.strokes.as_mut().filter(|_| !self.pen.is_away) else { return };
        match strokes.last_mut().filter(|stroke| !is_new && stroke.last() == Some(&a)) {
            Some(stroke) => stroke.push(b),
            None => strokes.push(vec![a, b]),
        }
    }

    pub(super) fn end_stroke(&mut self) {
        self.is_up = true;
        self.census.moments += std::mem::take(&mut self.stroke);
    }

    /// True if moves leave a line, now or when the polygon is drawn.
    pub(super) fn leaves_trace(&self) -> bool {
        self.pen.is_down || self.part.is_some()
    }

    /// Follows the chords of a curve with the pen as it is.
    pub(super) fn follow(&mut self, chords: &Chords, cause: usize) {
        if self.pen.is_down {
            self.draw_along(chords, cause);
        } else {
            chords.points.iter().for_each(|&to| self.go(to, cause, false));
        }
    }

    pub(super) fn draw_along(&mut self, chords: &Chords, cause: usize) {
        self.allow(chords);
        chords.points.iter().for_each(|&to| self.go(to, cause, true));
    }

    pub(super) fn point(&self, place: Place) -> Point {
        let [x, y] = self.turned(place);
        Point::new(x * self.unit, y * self.unit)
    }
}
