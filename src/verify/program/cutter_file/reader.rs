//! Reader of the blocks of a cut file in our own spelling.

use super::said::{Cut, Said};
use crate::geom::Point;
use crate::ir::list::{FULL_SPEED, Joint};
use crate::ir::toolpath::Event;
use crate::machine::Job;
use crate::units::{MM_PER_INCH, S_PER_MIN};

/// Unit of G71, mm.
const TENTH: f64 = 0.1;

/// Cut between two statements.
struct Drawn {
    cut: Cut,
    /// True if M19 marks it as a slit.
    is_slit: bool,
}

/// Reader of the blocks of a file.
pub(super) struct Reader<'a> {
    bytes: &'a [u8],
    offset: usize,
    pub(super) unit: f64,
    pub(super) at: Point,
    feed: Option<f64>,
    slowed: u8,
    slow: u8,
    of_piece: u8,
    /// True if M18 forbids the overcut at the next lift.
    no_overcut: bool,
}

impl<'a> Reader<'a> {
    pub(super) fn new(bytes: &'a [u8], job: &Job) -> Self {
        let slowed = job.profile.knife.slow();
        Self {
            bytes,
            offset: 0,
            unit: MM_PER_INCH / 100.0,
            at: Point::origin(),
            feed: None,
            slowed,
            slow: FULL_SPEED,
            of_piece: FULL_SPEED,
            no_overcut: false,
        }
    }

    /// Next block; `None` at the end, or when the block is not terminated correctly.
    fn block(&mut self) -> Option<&'a [u8]> {
        let rest = &self.bytes[self.offset..];
        let end = memchr::memchr(b'*', rest)?;
        if rest.get(end + 1) != Some(&b'\n') {
            return None;
        }
        self.offset += end + 2;
        Some(&rest[..end])
    }

    /// Next block, without consuming it.
    fn ahead(&mut self) -> Option<&'a [u8]> {
        let offset = self.offset;
        let block = self.block();
        self.offset = offset;
        block
    }

    /// All statements of the file; `None` when a block is not in our own spelling.
    pub(super) fn read(&mut self) -> Option<Vec<Said>> {
        let mut said = Vec::new();
        if self.block()? != b"H1" {
            return None;
        }
        self.unit = match self.ahead()? {
            b"G71" => TENTH,
            b"G70" => MM_PER_INCH / 1000.0,
            _ => self.unit,
        };
        if matches!(self.ahead()?, b"G71" | b"G70") {
            self.block()?;
        }
        loop {
            match self.block()? {
                b"M0" => break,
                b"M01" => said.push(Said::Event(Event::Stop)),
                b"M69" => said.push(Said::Event(Event::Advance)),
                // The length of the advance behind it.
                [b'Z', b'X', number @ ..] => {
                    said.push(Said::Advance(decimal(number)? * self.unit));
                    if self.block()? != b"M69" {
                        return None;
                    }
                }
                b"M31" => said.push(self.text()?),
                [b'N', number @ ..] => {
                    (self.slow, self.of_piece) = (FULL_SPEED, FULL_SPEED);
                    said.push(Said::Piece(std::str::from_utf8(number).ok()?.parse().ok()?));
                }
                [b'F', number @ ..] => self.feed = Some(decimal(number)? * MM_PER_INCH / S_PER_MIN),
                block if self.speed(block) => {}
                block => {
                    let (at, code) = point(block, self.unit)?;
                    self.at = at;
                    let statement = self.at_place(code, said.last())?;
                    said.push(statement);
                }
            }
        }
        said.extend(self.fields()?);
        Some(said)
    }

    /// Text behind M31, with or without its place.
    fn text(&mut self) -> Option<Said> {
        let at = self.ahead().and_then(|block| point(block, self.unit));
        if at.is_some_and(|(_, code)| code.is_empty()) {
            self.block()?;
        }
        Some(Said::Label { text: self.block()?.to_vec(), mirrored: None, at: at.map(|at| at.0), direction: None })
    }

    /// Statement at the current place, by the code behind it; `before` is the previous statement.
    fn at_place(&mut self, code: &[u8], before: Option<&Said>) -> Option<Said> {
        let at = self.at;
        Some(match code {
            b"M43" => Said::Hole(at, 1),
            b"M44" => Said::Hole(at, 2),
            b"M45" => Said::Hole(at, 3),
            b"M73" => Said::Hole(at, 4),
            b"M31" => self.label(at)?,
            b"" => {
                let drawn = self.cut()?;
                self.named(drawn, before)
            }
            _ => return None,
        })
    }

    /// List of values behind the end.
    fn fields(&self) -> Option<Vec<Said>> {
        let list = &self.bytes[self.offset..];
        if list.is_empty() {
            return Some(Vec::new());
        }
        let lines = list.strip_suffix(b"L0*\n")?.strip_suffix(b"\n")?;
        let field = |line: &[u8]| match line {
            [letter @ b'A'..=b'Z', b',', value @ ..] => Some(Said::Field(*letter, value.to_vec())),
            _ => None,
        };
        lines.split(|&byte| byte == b'\n').map(field).collect()
    }

    /// Executes a code of speed; `false` for any other block.
    fn speed(&mut self, block: &[u8]) -> bool {
        match block {
            b"M25" => self.slow = self.slowed,
            b"M26" => self.slow = FULL_SPEED,
            [b'M', b'6', k @ b'0'..=b'7'] => self.of_piece = 95 - 5 * (k - b'0'),
            _ => return false,
        }
        true
    }

    fn percent(&self) -> u8 {
        (u32::from(self.slow) * u32::from(self.of_piece) / u32::from(FULL_SPEED)).max(1) as u8
    }

    /// Label with a second point, after its first point was read.
    fn label(&mut self, at: Point) -> Option<Said> {
        let text = self.block()?.to_vec();
        let (mut mirrored, mut next) = (None, self.block()?);
        if point(next, self.unit).is_none_or(|(_, code)| !code.is_empty()) {
            mirrored = Some(next.to_vec());
            next = self.block()?;
        }
        let (second, code) = point(next, self.unit)?;
        let wanted: &[u8] = if mirrored.is_some() { b"M31" } else { b"" };
        if code != wanted || self.block()? != b"M15" {
            return None;
        }
        let direction = (second != at).then(|| (second - at).y.atan2((second - at).x));
        Some(Said::Label { text, mirrored, at: Some(at), direction })
    }

    /// Cut from the current place, from the knife down to its last lift.
    fn cut(&mut self) -> Option<Drawn> {
        let mut cut = Cut { points: vec![self.at], feed: self.feed, ..Cut::default() };
        let mut joint = self.plunge(Joint::default())?;
        let is_slit = self.ahead()? == b"M19";
        if is_slit {
            self.block()?;
        }
        let mut lift_ahead = false;
        let mut start_lift = false;
        let bare_end = loop {
            match self.block()? {
                b"M46" => lift_ahead = true,
                b"M18" => self.no_overcut = true,
                b"M15" | b"M19" if is_slit && cut.points.len() < 2 => return None,
                b"M19" => {
                    if self.block()? != b"M15" {
                        return None;
                    }
                    joint = self.plunge(Joint::default())?;
                }
                b"M15" => {
                    let bare = std::mem::take(&mut self.no_overcut);
                    if matches!(self.ahead()?, b"M17" | b"M14") {
                        joint = self.plunge(Joint { lift: true, no_overcut: bare, ..Joint::default() })?;
                        continue;
                    }
                    break bare;
                }
                block if self.speed(block) => {}
                block => {
                    let (to, code) = point(block, self.unit)?;
                    if !code.is_empty() {
                        return None;
                    }
                    let lift = std::mem::take(&mut lift_ahead);
                    if to == self.at && cut.chords.is_empty() {
                        start_lift = lift;
                        continue;
                    }
                    cut.points.push(to);
                    cut.chords.push((self.percent(), joint));
                    joint = Joint { lift, ..Joint::default() };
                    self.at = to;
                }
            }
        };
        let first = cut.chords.first_mut()?;
        first.1.lift |= start_lift;
        first.1.no_overcut |= bare_end;
        if is_slit && cut.chords.len() > 1 {
            cut.chords.iter_mut().for_each(|chord| chord.1.no_overcut = true);
            cut.chords[0].1.full_advance = true;
        }
        Some(Drawn { cut, is_slit })
    }

    /// Reads a knife-down, at the start of a cut or after a lift within it; `None` for any other block.
    fn plunge(&mut self, joint: Joint) -> Option<Joint> {
        let mut block = self.block()?;
        let full_advance = block == b"M17";
        if full_advance {
            block = self.block()?;
        }
        (block == b"M14").then_some(Joint { full_advance, ..joint })
    }

    /// Statement for a cut: a straight slit, the crossbar that the slit's tip divides, or a contour.
    fn named(&self, Drawn { cut, is_slit }: Drawn, before: Option<&Said>) -> Said {
        if is_slit && cut.chords.len() == 1 {
            return Said::Slit(cut);
        }
        if let (Some(Said::Slit(slit)), [from, to]) = (before, &cut.points[..]) {
            let tip = slit.points[1];
            let (ahead, way) = (tip - from, to - from);
            let share = ahead.dot(&way) / way.norm_squared();
            // Two points of a grid may be off the line between two others by the grid's diagonal.
            let is_near = (ahead - way * share).norm() <= self.unit * 2.0_f64.sqrt();
            if is_near && share > 0.0 && share < 1.0 && cut.chords[0].1 == Joint::default() {
                return Said::Bar(cut);
            }
        }
        Said::Contour(cut)
    }
}

/// Point of a block that is a place, mm, and the text behind it.
fn point(block: &[u8], unit: f64) -> Option<(Point, &[u8])> {
    let rest = block.strip_prefix(b"X")?;
    let middle = memchr::memchr(b'Y', rest)?;
    let (x, rest) = (&rest[..middle], &rest[middle + 1..]);
    let end = rest.iter().position(u8::is_ascii_uppercase).unwrap_or(rest.len());
    let (x, y) = (decimal(x)?, decimal(&rest[..end])?);
    Some((Point::new(x * unit, y * unit), &rest[end..]))
}

fn decimal(text: &[u8]) -> Option<f64> {
    let is_number = text.iter().all(|byte| byte.is_ascii_digit() || b"-.".contains(byte));
    std::str::from_utf8(text).ok().filter(|_| is_number)?.parse().ok()
}
