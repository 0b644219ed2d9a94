//! A second, small reading of a plot: where the pen goes while it is down, by other means than the reader's.
//!
//! It knows nothing of what is cut: a marker of a plot keeps account of what it leaves aside, and both together must be
//! what the pen draws. Holes are deduced from shapes, so their number is not in the bytes.

mod curve;
mod encoded;
mod frame;

use std::f64::consts::TAU;

use self::curve::{Chords, Gathered};
use super::scan::Slack;
use super::source_audit::{ARC_SAGITTA, Census};
use crate::geom::Point;
use crate::geom::moments::Moments;
use crate::machine::MachineProfile;

/// The terminator of labels unless DT gives another: ETX.
const ETX: u8 = 3;
/// Longest label, bytes, before its terminator counts as lost.
const LABEL_BYTES: usize = 1024;
/// Degrees of a full turn.
const FULL_TURN: f64 = 360.0;
/// Most numbers of an instruction that is no list of places.
const MOST_NUMBERS: usize = 8;

type Place = [f64; 2];

/// Scans a plot.
pub(super) fn scan(bytes: &[u8], profile: &MachineProfile) -> (Census, Slack) {
    let unit = profile.hpgl.unit.mm();
    let sagitta = profile.tolerance(unit) * ARC_SAGITTA;
    let mut scan = Scan {
        bytes,
        at: if bytes.starts_with(b"\xef\xbb\xbf") { 3 } else { 0 },
        is_text: !bytes.is_ascii() && std::str::from_utf8(bytes).map_or_else(|e| e.error_len().is_none(), |_| true),
        terminator: ETX,
        unit,
        sagitta: sagitta / unit,
        pen: Pen::default(),
        corners: None,
        page: None,
        scale: None,
        ranges: Vec::new(),
        quarters: 0,
        polygon: Vec::new(),
        part: None,
        is_fresh: false,
        census: Census::empty(unit),
        stroke: Moments::default(),
        slack: Slack { sagitta, length: 0.0, bounds: 0.0, moments: Moments::default() },
        curves: Vec::new(),
    };
    scan.run();
    scan.end_stroke();
    (scan.census, scan.slack)
}

/// The pen, in units of the file before RO.
#[derive(Default)]
struct Pen {
    at: Place,
    is_down: bool,
    is_relative: bool,
    /// What the stroke was last led on by; `None` when the pen was lifted.
    cause: Option<usize>,
}

/// A corner of PM: the place, what leads there, whether it is drawn.
type Corner = (Place, usize, bool);

struct Scan<'a> {
    bytes: &'a [u8],
    at: usize,
    /// Whether the whole file is UTF-8, so that high bytes of PE are pairs.
    is_text: bool,
    terminator: u8,
    unit: f64,
    /// Of curves, in units of the file.
    sagitta: f64,
    pen: Pen,
    corners: Option<[f64; 4]>,
    page: Option<Place>,
    /// Offset and factor of each axis.
    scale: Option<[Place; 2]>,
    /// The numbers of SC that it was made of.
    ranges: Vec<f64>,
    quarters: u8,
    polygon: Vec<Corner>,
    /// Where the part of the polygon that is gathered starts, and whether the next place starts another.
    part: Option<usize>,
    is_fresh: bool,
    census: Census,
    /// What is drawn since the pen was lifted: short sums of long ones lose less by rounding.
    stroke: Moments,
    slack: Slack,
    /// The curves of the polygon.
    curves: Vec<Gathered>,
}

impl Scan<'_> {
    fn run(&mut self) {
        while let Some(&byte) = self.bytes.get(self.at) {
            let next = self.bytes.get(self.at + 1).copied().unwrap_or(0);
            if byte == 0x1b {
                self.escape();
            } else if self.bytes[self.at..].starts_with(b"@PJL") {
                self.at += self.until(b"\n", usize::MAX);
            } else if byte.is_ascii_alphabetic() && next.is_ascii_alphabetic() {
                self.at += 2;
                self.instruction([byte.to_ascii_uppercase(), next.to_ascii_uppercase()]);
            } else {
                self.at += 1;
            }
        }
    }

    /// Bytes up to one of `ends`, or up to the end of the file or of `most`.
    fn until(&self, ends: &[u8], most: usize) -> usize {
        let rest = &self.bytes[self.at..];
        rest.iter().take(most).position(|byte| ends.contains(byte)).unwrap_or(rest.len().min(most))
    }

    fn escape(&mut self) {
        let rest = &self.bytes[self.at + 1..];
        let after = |skip: usize, is: &dyn Fn(u8) -> bool| {
            skip + rest[skip..].iter().position(|&byte| !is(byte)).unwrap_or(rest.len() - skip)
        };
        let length = match rest {
            [b'E', ..] => {
                self.reset();
                1
            }
            [b'.', letter, ..] if letter.is_ascii_graphic() => {
                let end = after(2, &|byte| byte.is_ascii_digit() || byte == b';' || byte == b',');
                if rest.get(end) == Some(&b':') { end + 1 } else { 2 }
            }
            [b'%', first, ..] => {
                let digits = 1 + usize::from(matches!(first, b'+' | b'-'));
                let end = after(digits, &|byte| byte.is_ascii_digit());
                let ends_well = end > digits && rest.get(end).is_some_and(u8::is_ascii_alphabetic);
                if ends_well { end + 1 } else { 0 }
            }
            [mark, ..] if b"!\"#$&'()*+,/".contains(mark) => {
                let end = after(1, &|b| b.is_ascii_digit() || b.is_ascii_lowercase() || b"+-.".contains(&b));
                if rest.get(end).is_some_and(|b| b.is_ascii_uppercase() || *b == b'@') { end + 1 } else { 0 }
            }
            [other, ..] if other.is_ascii_alphanumeric() || *other == b'=' => 1,
            _ => 0,
        };
        self.at += 1 + length;
    }

    /// IN; DF leaves the pen, the corners and the turn alone.
    fn reset(&mut self) {
        self.pen = Pen::default();
        (self.corners, self.scale, self.quarters, self.part) = (None, None, 0, None);
        (self.terminator, self.is_fresh) = (ETX, false);
        (self.polygon, self.curves) = (Vec::new(), Vec::new());
    }

    /// The next number of the instruction.
    fn number(&mut self) -> Option<f64> {
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

    fn numbers(&mut self) -> Vec<f64> {
        (0..MOST_NUMBERS).map_while(|_| self.number()).collect()
    }

    fn instruction(&mut self, mnemonic: [u8; 2]) {
        let cause = self.at;
        match &mnemonic {
            b"IN" | b"BP" => self.reset(),
            b"DF" => (self.pen.is_relative, self.scale, self.terminator) = (false, None, ETX),
            b"PU" | b"PD" | b"PA" | b"PR" => {
                match &mnemonic {
                    b"PU" => self.lift(),
                    b"PD" => self.pen.is_down = true,
                    other => self.pen.is_relative = other[1] == b'R',
                }
                self.places();
            }
            b"PE" => self.encoded(),
            b"SP" => self.pen.cause = None,
            b"LB" => {
                let window = &self.bytes[self.at..self.bytes.len().min(self.at + LABEL_BYTES)];
                match memchr::memchr(self.terminator, window) {
                    Some(length) => self.at += length + 1,
                    None => self.at += self.until(b";\r\n", LABEL_BYTES),
                }
            }
            b"DT" => {
                let given = self.bytes.get(self.at).copied().filter(|&byte| byte != b';');
                self.terminator = given.unwrap_or(ETX);
                self.at += usize::from(given.is_some());
            }
            b"CO" => {
                let quoted = self.bytes.get(self.at) == Some(&b'"');
                let window = self.bytes[self.at..].iter().skip(1).take(LABEL_BYTES);
                let end = window.clone().position(|&byte| byte == b'"').filter(|_| quoted);
                self.at += end.map_or_else(|| self.until(b";\r\n", usize::MAX), |length| length + 2);
            }
            _ => {
                let numbers = match &mnemonic {
                    b"BZ" | b"BR" => return self.beziers(mnemonic == *b"BR"),
                    _ => self.numbers(),
                };
                self.figure(mnemonic, &numbers, cause);
                self.frame(mnemonic, &numbers);
            }
        }
    }

    /// Places behind PU, PD, PA and PR.
    fn places(&mut self) {
        loop {
            let cause = self.at;
            let (Some(x), Some(y)) = (self.number(), self.number()) else { return };
            let to = self.target([x, y], self.pen.is_relative);
            self.lead(to, cause);
        }
    }

    /// A place of the file: the first one behind PM 1 starts a part, whatever leads there.
    fn lead(&mut self, to: Place, cause: usize) {
        let starts = self.part.is_some() && std::mem::take(&mut self.is_fresh);
        if starts {
            self.part = Some(self.polygon.len());
        }
        self.go(to, cause, self.pen.is_down && !starts);
    }

    fn target(&self, [x, y]: Place, is_relative: bool) -> Place {
        let [offset, factor] = self.scale.unwrap_or([[0.0; 2], [1.0; 2]]);
        let from = if is_relative { self.pen.at } else { offset };
        [from[0] + x * factor[0], from[1] + y * factor[1]]
    }

    fn lift(&mut self) {
        (self.pen.is_down, self.pen.cause) = (false, None);
    }

    /// A move; `cause` tells moves of one number or curve from others.
    fn go(&mut self, to: Place, cause: usize, draws: bool) {
        let from = std::mem::replace(&mut self.pen.at, to);
        if self.part.is_some() {
            self.polygon.push((to, cause, draws));
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
        }
    }

    fn end_stroke(&mut self) {
        self.census.moments += std::mem::take(&mut self.stroke);
    }

    /// Whether moves draw, now or when the polygon is drawn.
    fn leaves_trace(&self) -> bool {
        self.pen.is_down || self.part.is_some()
    }

    /// Along the chords of a curve, with the pen as it is.
    fn follow(&mut self, chords: &Chords, cause: usize) {
        if self.pen.is_down {
            self.draw_along(chords, cause);
        } else {
            chords.points.iter().for_each(|&to| self.go(to, cause, false));
        }
    }

    fn draw_along(&mut self, chords: &Chords, cause: usize) {
        self.allow(chords);
        chords.points.iter().for_each(|&to| self.go(to, cause, true));
    }

    fn point(&self, place: Place) -> Point {
        let [x, y] = self.turned(place);
        Point::new(x * self.unit, y * self.unit)
    }

    /// Figures and arcs.
    fn figure(&mut self, mnemonic: [u8; 2], numbers: &[f64], cause: usize) {
        let from = self.pen.at;
        let is_relative = matches!(&mnemonic, b"AR" | b"RT" | b"ER");
        let across = |scan: &Self, radius: f64| scan.target([radius, 0.0], true)[0] - from[0];
        match (&mnemonic, numbers) {
            (b"AA" | b"AR", &[x, y, degrees, ..]) => {
                let centre = self.target([x, y], is_relative);
                if self.leaves_trace() {
                    let chords = self.arc(from, centre, degrees.to_radians());
                    self.follow(&chords, cause);
                } else {
                    let to = self.on_arc([from, centre], degrees.to_radians());
                    self.go(to, cause, false);
                }
            }
            (b"AT" | b"RT", &[x1, y1, x2, y2, ..]) => {
                let middle = self.target([x1, y1], is_relative);
                let to = self.target([x2, y2], is_relative);
                if self.leaves_trace()
                    && let Some((centre, sweep)) = self.circle([from, middle, to])
                {
                    let chords = self.arc(from, centre, sweep);
                    self.follow(&chords, cause);
                }
                self.go(to, cause, self.pen.is_down);
            }
            (b"CI", &[radius, ..]) => {
                let start = [from[0] + across(self, radius), from[1]];
                let chords = self.arc(start, from, TAU);
                self.go(start, cause, false);
                self.draw_along(&chords, cause);
                self.go(from, cause, false);
            }
            (b"EA" | b"ER", &[x, y, ..]) => {
                let to = self.target([x, y], is_relative);
                self.go(from, cause, false);
                for corner in [[to[0], from[1]], to, [from[0], to[1]], from] {
                    self.go(corner, cause, true);
                }
                self.go(from, cause, false);
            }
            (b"EW", &[radius, start, degrees, ..]) => {
                let angle = start.to_radians();
                let start = self.target([radius * angle.cos(), radius * angle.sin()], true);
                let chords = self.arc(start, from, degrees.to_radians());
                let has_radii = degrees.abs() < FULL_TURN;
                if has_radii {
                    self.go(from, cause, false);
                }
                self.go(start, cause, has_radii);
                self.draw_along(&chords, cause);
                self.go(from, cause, has_radii);
                self.go(from, cause, false);
            }
            (b"PM", numbers) => match numbers.first().copied().unwrap_or(0.0) {
                0.0 => {
                    self.pen.cause = None;
                    (self.polygon, self.curves) = (vec![(from, cause, false)], Vec::new());
                    self.part = Some(0);
                }
                kind => {
                    let Some(part) = self.part else { return };
                    let first = self.polygon[part].0;
                    self.go(first, cause, true);
                    self.go(first, cause, false);
                    (self.part, self.is_fresh) = (None, kind == 1.0);
                    if self.is_fresh {
                        self.part = Some(self.polygon.len() - 1);
                    }
                }
            },
            (b"EP", _) if self.part.is_none() => {
                self.pen.cause = None;
                self.allow_polygon();
                for (to, cause, draws) in std::mem::take(&mut self.polygon) {
                    self.go(to, cause, draws);
                    self.polygon.push((to, cause, draws));
                }
                (self.pen.at, self.pen.cause) = (from, None);
            }
            _ => {}
        }
    }
}
