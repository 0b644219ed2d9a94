//! A second, small reading of a plot: where the pen goes while it is down, by other means than the reader's.
//!
//! It knows nothing of what is cut: a marker of a plot keeps account of what it leaves aside, and both together must be
//! what the pen draws. Holes are deduced from shapes, so their number is not in the bytes.

use std::f64::consts::TAU;

use super::scan::Slack;
use super::source_audit::{ARC_SAGITTA, Census};
use crate::geom::Point;
use crate::machine::MachineProfile;

/// How much finer than the reader's the chords of curves are here.
const FINER: f64 = 4.0;
/// The most chords of a curve, as in the reader.
const MOST_CHORDS: f64 = 100_000.0;
/// The terminator of labels unless DT gives another: ETX.
const ETX: u8 = 3;
/// Longest label, bytes, before its terminator counts as lost.
const LABEL_BYTES: usize = 1024;
/// Most numbers of an instruction that is no list of places.
const MOST_NUMBERS: usize = 8;
/// Corners of the scale where the file gives none, in units of the file.
const CORNERS: [f64; 4] = [250.0, 596.0, 10_250.0, 7796.0];

/// Height of a triangle, in units of the file, below which its corners lie on a line.
const STRAIGHT: f64 = 1e-6;

type Place = [f64; 2];

/// Scans a plot.
pub(super) fn scan(bytes: &[u8], read: &Census, profile: &MachineProfile) -> (Census, Slack) {
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
        quarters: 0,
        polygon: Vec::new(),
        part: None,
        is_fresh: false,
        census: Census { drills: read.drills, ..Census::empty(unit) },
        slack: Slack { sagitta, length: 0.0, bounds: 0.0 },
    };
    scan.run();
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
    quarters: u8,
    polygon: Vec<Corner>,
    /// Where the part of the polygon that is gathered starts, and whether the next place starts another.
    part: Option<usize>,
    is_fresh: bool,
    census: Census,
    slack: Slack,
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
        self.polygon.clear();
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
                let window = self.bytes[self.at..].iter().take(LABEL_BYTES);
                match window.clone().position(|&byte| byte == self.terminator) {
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
            if self.part.is_some() && std::mem::take(&mut self.is_fresh) {
                self.part = Some(self.polygon.len());
                self.go(to, cause, false);
            } else {
                self.go(to, cause, self.pen.is_down);
            }
        }
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
        } else if from != to {
            let (a, b) = (self.point(from), self.point(to));
            self.census.points += usize::from(self.pen.cause.replace(cause) != Some(cause));
            self.census.length += (b - a).norm();
            self.census.bounds.add(a);
            self.census.bounds.add(b);
        }
    }

    /// Along the chords of a curve, with the pen as it is.
    fn follow(&mut self, points: Vec<Place>, cause: usize) {
        for to in points {
            self.go(to, cause, self.pen.is_down);
        }
    }

    fn point(&self, [x, y]: Place) -> Point {
        let [length, width] = self.page.unwrap_or_default();
        let [x, y] = match self.quarters {
            1 => [length - y, x],
            2 => [length - x, width - y],
            3 => [y, width - x],
            _ => [x, y],
        };
        Point::new(x * self.unit, y * self.unit)
    }

    /// A figure that is drawn whether the pen is up or down.
    fn closed(&mut self, start: Place, points: impl IntoIterator<Item = Place>, cause: usize) {
        let back = self.pen.at;
        self.go(start, cause, false);
        points.into_iter().for_each(|to| self.go(to, cause, true));
        self.go(back, cause, false);
    }

    /// An arc around a centre, finer than the reader's, and what the reader's chords may lack.
    fn arc(&mut self, from: Place, centre: Place, sweep: f64) -> Vec<Place> {
        let (x, y) = (from[0] - centre[0], from[1] - centre[1]);
        let radius = x.hypot(y);
        let sweep = sweep.clamp(-TAU, TAU);
        if radius <= 0.0 || sweep == 0.0 {
            return Vec::new();
        }
        let step = 2.0 * (1.0 - (self.sagitta / FINER / radius).min(0.5)).acos();
        let chords = (sweep.abs() / step).ceil().clamp(1.0, FINER * MOST_CHORDS);
        // Chords are shorter than their arc by s / (3 r) of it.
        self.slack.length += radius * sweep.abs() * (self.sagitta / (3.0 * radius)).min(1.0) * self.unit * 1.5;
        self.slack.bounds = self.slack.sagitta;
        let zero = y.atan2(x);
        let at = |i: f64| {
            let angle = zero + sweep * i / chords;
            [centre[0] + radius * angle.cos(), centre[1] + radius * angle.sin()]
        };
        let mut points: Vec<Place> = (1..=chords as u32).map(|i| at(i.into())).collect();
        if sweep.abs() >= TAU {
            // A full turn ends where it started, whatever rounding says.
            points.pop();
            points.push(from);
        }
        points
    }

    fn beziers(&mut self, is_relative: bool) {
        loop {
            let cause = self.at;
            let mut controls = [0.0; 6];
            for control in &mut controls {
                let Some(number) = self.number() else { return };
                *control = number;
            }
            let place = |k: usize| self.target([controls[k], controls[k + 1]], is_relative);
            let p = [self.pen.at, place(0), place(2), place(4)];
            let bend = |i: usize| {
                let of = |axis: usize| p[i][axis] - 2.0 * p[i + 1][axis] + p[i + 2][axis];
                of(0).hypot(of(1))
            };
            let rough = (0.75 * bend(0).max(bend(1)) / self.sagitta).sqrt().ceil().clamp(1.0, MOST_CHORDS);
            let chords = FINER * rough;
            let mut length = 0.0;
            for i in 1..=chords as u32 {
                let t = f64::from(i) / chords;
                // De Casteljau.
                let mix = |a: Place, b: Place| [a[0] + (b[0] - a[0]) * t, a[1] + (b[1] - a[1]) * t];
                let (a, b, c) = (mix(p[0], p[1]), mix(p[1], p[2]), mix(p[2], p[3]));
                let to = if i == chords as u32 { p[3] } else { mix(mix(a, b), mix(b, c)) };
                length += (to[0] - self.pen.at[0]).hypot(to[1] - self.pen.at[1]);
                self.go(to, cause, self.pen.is_down);
            }
            // A chord c with sagitta s is shorter than its curve by about 8 s2 / (3 c); cusps have short chords.
            let lacks = 8.0 * (rough * self.sagitta).powi(2) / (3.0 * length.max(self.sagitta));
            self.slack.length += (2.0 * lacks).min(length) * self.unit;
            self.slack.bounds = self.slack.sagitta;
        }
    }

    /// Degrees of the file as they turn on the table, rad.
    fn turn(&self, degrees: f64) -> f64 {
        let mirrors = |[_, factor]: [Place; 2]| factor[0].signum() != factor[1].signum();
        if self.scale.is_some_and(mirrors) { -degrees.to_radians() } else { degrees.to_radians() }
    }

    /// Figures and arcs.
    fn figure(&mut self, mnemonic: [u8; 2], numbers: &[f64], cause: usize) {
        let from = self.pen.at;
        let is_relative = matches!(&mnemonic, b"AR" | b"RT" | b"ER");
        let across = |scan: &Self, radius: f64| scan.target([radius, 0.0], true)[0] - from[0];
        match (&mnemonic, numbers) {
            (b"AA" | b"AR", &[x, y, degrees, ..]) => {
                let centre = self.target([x, y], is_relative);
                let points = self.arc(from, centre, self.turn(degrees));
                self.follow(points, cause);
            }
            (b"AT" | b"RT", &[x1, y1, x2, y2, ..]) => {
                let middle = self.target([x1, y1], is_relative);
                let to = self.target([x2, y2], is_relative);
                if let Some((centre, sweep)) = circle(from, middle, to) {
                    let points = self.arc(from, centre, sweep);
                    self.follow(points, cause);
                }
                self.go(to, cause, self.pen.is_down);
            }
            (b"CI", &[radius, ..]) => {
                let start = [from[0] + across(self, radius), from[1]];
                let points = self.arc(start, from, TAU);
                self.closed(start, points, cause);
            }
            (b"EA" | b"ER", &[x, y, ..]) => {
                let to = self.target([x, y], is_relative);
                self.closed(from, [[to[0], from[1]], to, [from[0], to[1]], from], cause);
            }
            (b"EW", &[radius, start, degrees, ..]) => {
                let angle = start.to_radians();
                let start = self.target([radius * angle.cos(), radius * angle.sin()], true);
                let mut points = self.arc(start, from, self.turn(degrees));
                if degrees.abs() < 360.0 {
                    points.insert(0, start);
                    points.push(from);
                    self.closed(from, points, cause);
                } else {
                    self.closed(start, points, cause);
                }
            }
            (b"PM", numbers) => match numbers.first().copied().unwrap_or(0.0) {
                0.0 => {
                    self.pen.cause = None;
                    self.polygon = vec![(from, cause, false)];
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
                for (to, cause, draws) in std::mem::take(&mut self.polygon) {
                    self.go(to, cause, draws);
                    self.polygon.push((to, cause, draws));
                }
                (self.pen.at, self.pen.cause) = (from, None);
            }
            _ => {}
        }
    }

    /// Scale, corners, page and turn.
    fn frame(&mut self, mnemonic: [u8; 2], numbers: &[f64]) {
        let set_corners = |scan: &mut Self, numbers: &[f64]| {
            let [a, b, c, d] = scan.corners.unwrap_or(CORNERS);
            scan.corners = match *numbers {
                [] => None,
                [x1, y1, x2, y2, ..] => Some([x1, y1, x2, y2]),
                [x, y] => Some([x, y, x + c - a, y + d - b]),
                _ => scan.corners,
            };
        };
        match (&mnemonic, numbers) {
            (b"IP", numbers) => set_corners(self, numbers),
            (b"IR", []) => self.corners = None,
            (b"IR", numbers) => {
                if let Some(page) = self.page {
                    let part = |(i, percent): (usize, &f64)| percent / 100.0 * page[i % 2];
                    let units: Vec<f64> = numbers.iter().take(4).enumerate().map(part).collect();
                    set_corners(self, &units);
                }
            }
            (b"PS", numbers) => self.page = numbers.first().map(|&x| [x, numbers.get(1).copied().unwrap_or(x)]),
            (b"RO", numbers) => {
                let degrees = numbers.first().copied().unwrap_or(0.0);
                let quarters = [0.0, 90.0, 180.0, 270.0, 360.0].iter().position(|&d| d == degrees);
                self.quarters = quarters.map_or(self.quarters, |quarters| quarters as u8 % 4);
            }
            (b"SC", &[x0, x1, y0, y1, ref kind @ ..]) => self.set_scale([x0, x1, y0, y1], kind),
            (b"SC", _) => self.scale = None,
            _ => {}
        }
    }

    fn set_scale(&mut self, [x0, x1, y0, y1]: [f64; 4], kind: &[f64]) {
        let [a, b, c, d] = self.corners.unwrap_or(CORNERS);
        let mut factor = [(c - a) / (x1 - x0), (d - b) / (y1 - y0)];
        let mut least = [a, b];
        match kind.first() {
            Some(2.0) if x1 == 0.0 || y1 == 0.0 => return,
            Some(2.0) => factor = [x1, y1],
            _ if x0 == x1 || y0 == y1 => return,
            Some(1.0) => {
                let equal = factor[0].abs().min(factor[1].abs());
                let spare = [(c - a) * (1.0 - equal / factor[0].abs()), (d - b) * (1.0 - equal / factor[1].abs())];
                for axis in 0..2 {
                    least[axis] += spare[axis] * kind.get(axis + 1).copied().unwrap_or(50.0) / 100.0;
                    factor[axis] = equal * factor[axis].signum();
                }
            }
            _ => {}
        }
        self.scale = Some([[least[0] - x0 * factor[0], least[1] - y0 * factor[1]], factor]);
    }

    /// PE: digits of base 64 or 32, least first.
    fn encoded(&mut self) {
        let (mut base, mut last_from) = (64.0, 191);
        let (mut bits, mut is_up, mut is_absolute, mut flag) = (0, false, false, b' ');
        let (mut value, mut weight) = (0.0, 1.0);
        let mut first: Option<(f64, usize)> = None;
        while let Some(&raw) = self.bytes.get(self.at) {
            self.at += 1;
            let mut byte = raw;
            if self.is_text && matches!(raw, 0xc2 | 0xc3) {
                let low = self.bytes.get(self.at).copied().unwrap_or(0);
                byte = (raw << 6) | (low & 0x3f);
                self.at += 1;
            }
            match byte {
                b';' => return,
                b'7' => (base, last_from) = (32.0, 95),
                b'<' => is_up = true,
                b'=' => is_absolute = true,
                b':' | b'>' => flag = byte,
                63..=126 | 191..=254 => {
                    let is_last = byte >= last_from;
                    value += f64::from(byte - if is_last { last_from } else { 63 }) * weight;
                    weight *= base;
                    if !is_last {
                        continue;
                    }
                    let half = (value / 2.0).floor();
                    let number = if value % 2.0 == 0.0 { half } else { -half };
                    (value, weight) = (0.0, 1.0);
                    match (std::mem::replace(&mut flag, b' '), first.take()) {
                        (b':', kept) => (first, self.pen.cause) = (kept, None),
                        (b'>', kept) => (first, bits) = (kept, number as i32),
                        (_, None) => first = Some((number * 2.0_f64.powi(-bits), self.at)),
                        (_, Some((x, cause))) => {
                            let to = self.target([x, number * 2.0_f64.powi(-bits)], !is_absolute);
                            self.pen.is_down = !is_up;
                            self.go(to, cause, !is_up);
                            (is_absolute, is_up) = (false, false);
                        }
                    }
                }
                _ => {}
            }
        }
    }
}

/// Centre and sweep of the arc by way of `middle`; `None` on a line, or where rounding cannot be told from a bend.
fn circle(from: Place, middle: Place, to: Place) -> Option<(Place, f64)> {
    let far = |p: Place, q: Place| (p[0] - q[0]).hypot(p[1] - q[1]);
    if far(from, to) < STRAIGHT {
        let centre = [f64::midpoint(from[0], middle[0]), f64::midpoint(from[1], middle[1])];
        return (far(from, middle) > STRAIGHT).then_some((centre, TAU));
    }
    // The bisectors of the two chords from the start meet at the centre.
    let (a, b) = ([middle[0] - from[0], middle[1] - from[1]], [to[0] - from[0], to[1] - from[1]]);
    let cross = a[0] * b[1] - a[1] * b[0];
    let half_square = |v: Place| f64::midpoint(v[0] * v[0], v[1] * v[1]);
    let (aa, bb) = (half_square(a), half_square(b));
    let seen = [(aa * b[1] - bb * a[1]) / cross, (bb * a[0] - aa * b[0]) / cross];
    let longest = far(from, middle).max(far(from, to)).max(far(middle, to));
    if !seen[0].is_finite() || !seen[1].is_finite() || cross.abs() < STRAIGHT * longest {
        return None;
    }
    let angle = |p: Place| (p[1] - seen[1]).atan2(p[0] - seen[0]);
    let turn = (angle(b) - angle([0.0, 0.0])).rem_euclid(TAU);
    Some(([from[0] + seen[0], from[1] + seen[1]], if cross > 0.0 { turn } else { turn - TAU }))
}
