//! The pen of a plot as it is read a second time, and what it draws.

use crate::geom::Point;
use crate::geom::moments::Moments;
use crate::verify::source::census::{Census, Slack};

/// Most numbers of an instruction that is no list of places.
const MOST_NUMBERS: usize = 8;

/// A place, in units of the file.
pub(super) type Place = [f64; 2];

/// The pen, in units of the file before RO.
#[derive(Default)]
pub(super) struct Pen {
    pub(super) at: Place,
    pub(super) is_down: bool,
    pub(super) is_relative: bool,
    /// Whether no pen is taken, so that nothing is drawn.
    pub(super) is_away: bool,
    /// What the stroke was last led on by; `None` when the pen was lifted.
    pub(super) cause: Option<usize>,
}

/// A corner of PM.
pub(super) struct Corner {
    pub(super) at: Place,
    /// What leads there.
    pub(super) cause: usize,
    pub(super) draws: bool,
}

pub(super) struct Scan<'a> {
    pub(super) bytes: &'a [u8],
    pub(super) at: usize,
    /// Whether the whole file is UTF-8, so that high bytes of PE are pairs.
    pub(super) is_text: bool,
    pub(super) terminator: u8,
    pub(super) unit: f64,
    /// Of curves, in units of the file.
    pub(super) sagitta: f64,
    pub(super) pen: Pen,
    pub(super) corners: Option<[f64; 4]>,
    pub(super) page: Option<Place>,
    /// Offset and factor of each axis.
    pub(super) scale: Option<[Place; 2]>,
    /// The numbers of SC that it was made of.
    pub(super) ranges: Vec<f64>,
    pub(super) quarters: u8,
    pub(super) polygon: Vec<Corner>,
    /// Where the part of the polygon that is gathered starts, and whether the next place starts another.
    pub(super) part: Option<usize>,
    pub(super) is_fresh: bool,
    pub(super) census: Census,
    /// What is drawn since the pen was lifted: short sums of long ones lose less by rounding.
    pub(super) stroke: Moments,
    pub(super) slack: Slack,
    /// The curves of the polygon.
    pub(super) curves: Vec<Gathered>,
    /// The strokes, where they are asked for, and whether the next line begins one.
    pub(super) strokes: Option<Vec<Vec<Point>>>,
    pub(super) is_up: bool,
}

/// A curve as chords.
pub(super) struct Chords {
    /// Their ends.
    pub(super) points: Vec<Place>,
    /// How far moments may be off, as a part of what the reader's chords lack.
    pub(super) share: f64,
}

/// A curve of the polygon that PM gathers, drawn whenever the polygon is.
#[derive(Debug, Clone, Copy)]
pub(super) struct Gathered {
    pub(super) from: Place,
    /// Its first corner among those of the polygon, and how many they are.
    pub(super) first: usize,
    pub(super) count: usize,
    pub(super) share: f64,
}

impl Scan<'_> {
    /// The next number of the instruction.
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

    /// A move; `cause` tells moves of one number or curve from others.
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

    /// Notes a line of a stroke.
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

    /// Whether moves draw, now or when the polygon is drawn.
    pub(super) fn leaves_trace(&self) -> bool {
        self.pen.is_down || self.part.is_some()
    }

    /// Along the chords of a curve, with the pen as it is.
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
