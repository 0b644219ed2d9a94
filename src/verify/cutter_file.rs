//! Judges a cut file that was written from a marker: read again, it must say what the marker says.
//!
//! Both become a list of statements in the order of the file, which are compared one by one. The reader knows the one
//! spelling that is written and nothing else: what it does not know is a bad block.

use std::f64::consts::PI;

use super::worst::{Worst, at};
use super::{Verdict, sort};
use crate::geom::{Point, angle};
use crate::ir::Marker;
use crate::ir::finding::Sighting;
use crate::ir::list::{FULL_SPEED, Joint};
use crate::ir::marker::{NotchKind, Piece};
use crate::ir::toolpath::Event;
use crate::machine::Job;
use crate::source::Source;
use crate::units::{MM_PER_INCH, S_PER_MIN};

/// How every such file begins.
const HEAD: &[u8] = b"H1*\n";
/// The unit of G71, mm.
const TENTH: f64 = 0.1;
/// Half of the last decimal that counts, units of the file.
const ROUNDING: f64 = 0.5e-6;
/// Rounding of the computation, mm.
const PLACE_EPSILON: f64 = 1e-9;
/// Greatest difference of two directions that six decimals of a far second point leave, rad.
const DIRECTION_EPSILON: f64 = 1e-8;
/// Greatest difference of two feeds, as a part of them.
const FEED_EPSILON: f64 = 1e-6;

/// Whether bytes are meant as a cut file that was written here.
pub(super) fn begins(bytes: &[u8]) -> bool {
    bytes.starts_with(HEAD)
}

/// Something that a cut file says.
#[derive(Debug, Clone, PartialEq)]
enum Said {
    Piece(u32),
    Event(Event),
    Hole(Point, u8),
    Label { text: Vec<u8>, mirrored: Option<Vec<u8>>, at: Option<Point>, direction: Option<f64> },
    Slit(Cut),
    Bar(Cut),
    Contour(Cut),
    Field(u8, Vec<u8>),
}

/// A line that is cut.
#[derive(Debug, Clone, PartialEq, Default)]
struct Cut {
    points: Vec<Point>,
    /// Of each chord: its speed in percent, and what is asked for where it starts.
    chords: Vec<(u8, Joint)>,
    /// The feed of its piece, mm/s.
    feed: Option<f64>,
    /// The block of its first chord, where it is known.
    block: u32,
}

/// Judges the bytes of a cut file against the marker that it was written from.
pub fn cutter_file(bytes: &[u8], marker: &Marker, source: &Source, job: &Job) -> Verdict {
    let mut format = Worst::new("verify/format", "bad blocks", Some(0.0));
    let mut same = Worst::new("verify/same", "statements", Some(0.0));
    let mut reader = Reader::new(bytes, job);
    let found = reader.read();
    let unit = reader.unit;
    let mut place = Worst::new("verify/same-place", "mm", Some(ROUNDING * unit * 2.0_f64.sqrt() + PLACE_EPSILON));
    let nowhere = Sighting { time: None, point: Point::origin(), block: 0 };
    if found.is_none() {
        format.see(1.0, || at(0.0, reader.at, 0));
    }
    let found = found.unwrap_or_default();
    let expected = expected(marker, source);
    let differing = expected.len().abs_diff(found.len());
    let mut wrong = differing as f64;
    same.see(wrong, || nowhere);
    for (told, meant) in found.iter().zip(&expected) {
        let sighting = meant.sighting().unwrap_or(nowhere);
        if let Some(away) = told.away(meant) {
            place.see(away, || sighting);
        } else {
            wrong += 1.0;
            same.see(wrong, || sighting);
        }
    }
    let mut findings = vec![format.finding(), same.finding(), place.finding()];
    sort(&mut findings);
    Verdict { findings, unread: None, untimed: Vec::new() }
}

impl Said {
    /// How far the places of two statements are apart, mm; `None` when they say different things.
    fn away(&self, other: &Self) -> Option<f64> {
        let apart = |a: Point, b: Point| (a - b).norm();
        match (self, other) {
            (Self::Hole(a, tool), Self::Hole(b, other)) if tool == other => Some(apart(*a, *b)),
            (
                Self::Label { text, mirrored, at, direction },
                Self::Label { text: t, mirrored: m, at: a, direction: d },
            ) => {
                let turned = match (direction, d) {
                    (Some(one), Some(other)) => angle::wrap(one - other).abs(),
                    (None, None) => 0.0,
                    _ => PI,
                };
                let same = text == t && mirrored == m && turned <= DIRECTION_EPSILON && at.is_some() == a.is_some();
                same.then(|| at.zip(*a).map_or(0.0, |(one, other)| apart(one, other)))
            }
            (Self::Slit(a), Self::Slit(b)) | (Self::Bar(a), Self::Bar(b)) | (Self::Contour(a), Self::Contour(b)) => {
                let feed = match (a.feed, b.feed) {
                    (Some(one), Some(other)) => (one - other).abs() <= FEED_EPSILON * other,
                    (None, None) => true,
                    _ => false,
                };
                let same = a.points.len() == b.points.len() && a.chords == b.chords && feed;
                same.then(|| a.points.iter().zip(&b.points).map(|(one, other)| apart(*one, *other)).fold(0.0, f64::max))
            }
            _ => (self == other).then_some(0.0),
        }
    }

    fn sighting(&self) -> Option<Sighting> {
        let (point, block) = match self {
            Self::Hole(at, _) => (*at, 0),
            Self::Slit(cut) | Self::Bar(cut) | Self::Contour(cut) => (*cut.points.first()?, cut.block),
            Self::Label { at, .. } => ((*at)?, 0),
            Self::Piece(_) | Self::Event(_) | Self::Field(..) => return None,
        };
        Some(Sighting { time: None, point, block })
    }
}

/// What a marker says, in the order in which it is written.
fn expected(marker: &Marker, source: &Source) -> Vec<Said> {
    let is_cut = |piece: &Piece| !(piece.contours.is_empty() && piece.notches.is_empty() && piece.drills.is_empty());
    let text = |span| source.slice(span).trim_ascii().to_vec();
    let (mut said, mut waiting, mut fields) = (Vec::new(), (Vec::new(), Vec::new()), Vec::new());
    let last = marker.pieces.iter().rposition(is_cut);
    for (index, piece) in marker.pieces.iter().enumerate() {
        // What a piece without a cut has is the next one's; behind the last, texts are the last one's.
        waiting.0.extend(piece.events.iter().map(|event| Said::Event(event.kind)));
        let labels = piece
            .labels
            .iter()
            .chain(marker.pieces[index + 1..].iter().flat_map(|piece| &piece.labels).filter(|_| last == Some(index)));
        waiting.1.extend(labels.map(|label| Said::Label {
            text: text(label.span),
            mirrored: label.mirrored.map(text),
            at: label.at,
            direction: label.heading.map(crate::geom::Heading::radians),
        }));
        if !is_cut(piece) {
            continue;
        }
        said.push(Said::Piece(piece.number));
        said.append(&mut waiting.0);
        said.extend(piece.drills.iter().map(|drill| Said::Hole(drill.at, drill.tool)));
        said.append(&mut waiting.1);
        for notch in &piece.notches {
            let cut = |from, to, block| Cut {
                points: vec![from, to],
                chords: vec![(notch.percent, Joint::default())],
                feed: piece.feed,
                block,
            };
            said.push(Said::Slit(cut(notch.root, notch.tip, notch.span.block)));
            if let NotchKind::T(bar) = notch.kind {
                said.push(Said::Bar(cut(bar.from, bar.to, bar.span.block)));
            }
        }
        for contour in &piece.contours {
            let mut cut = Cut { points: marker.points(contour), feed: piece.feed, ..Cut::default() };
            for (_, segment) in marker.list.walk(contour.range) {
                cut.block = if cut.chords.is_empty() { segment.span.block } else { cut.block };
                cut.chords.push((segment.percent, segment.joint));
            }
            said.push(Said::Contour(cut));
        }
        if !piece.fields.is_empty() {
            let named = matches!(piece.fields[0].letter, b'L' | b'N');
            fields.push((named, piece));
        }
    }
    said.extend(waiting.0);
    said.extend(marker.closing.iter().map(|event| Said::Event(event.kind)));
    fields.sort_by_key(|(named, _)| *named); // stable: those without a name first
    let values = fields.iter().flat_map(|(_, piece)| &piece.fields);
    said.extend(values.map(|field| Said::Field(field.letter, source.slice(field.span).to_vec())));
    said
}

/// Follows the blocks of a file.
struct Reader<'a> {
    bytes: &'a [u8],
    offset: usize,
    unit: f64,
    at: Point,
    feed: Option<f64>,
    slowed: u8,
    slow: u8,
    of_piece: u8,
    /// Asked for by M18 for the next lift.
    no_overcut: bool,
}

impl<'a> Reader<'a> {
    fn new(bytes: &'a [u8], job: &Job) -> Self {
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

    /// The next block; `None` when there is none, or it does not end as it must.
    fn block(&mut self) -> Option<&'a [u8]> {
        let rest = &self.bytes[self.offset..];
        let end = memchr::memchr(b'*', rest)?;
        if rest.get(end + 1) != Some(&b'\n') {
            return None;
        }
        self.offset += end + 2;
        Some(&rest[..end])
    }

    /// Looks at the next block without taking it.
    fn ahead(&mut self) -> Option<&'a [u8]> {
        let offset = self.offset;
        let block = self.block();
        self.offset = offset;
        block
    }

    /// Everything that the file says; `None` when a block is not one that is written here.
    fn read(&mut self) -> Option<Vec<Said>> {
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
            let block = self.block()?;
            match block {
                b"M0" => break,
                b"M01" => said.push(Said::Event(Event::Stop)),
                b"M69" => said.push(Said::Event(Event::Advance)),
                b"M31" => {
                    let at = self.ahead().and_then(|block| point(block, self.unit));
                    if at.is_some_and(|(_, code)| code.is_empty()) {
                        self.block()?;
                    }
                    let text = self.block()?.to_vec();
                    said.push(Said::Label { text, mirrored: None, at: at.map(|at| at.0), direction: None });
                }
                [b'N', number @ ..] => {
                    (self.slow, self.of_piece) = (FULL_SPEED, FULL_SPEED);
                    said.push(Said::Piece(std::str::from_utf8(number).ok()?.parse().ok()?));
                }
                [b'F', number @ ..] => self.feed = Some(decimal(number)? * MM_PER_INCH / S_PER_MIN),
                _ if self.speed(block) => {}
                _ => {
                    let (at, code) = point(block, self.unit)?;
                    self.at = at;
                    match code {
                        b"M43" => said.push(Said::Hole(at, 1)),
                        b"M44" => said.push(Said::Hole(at, 2)),
                        b"M45" => said.push(Said::Hole(at, 3)),
                        b"M73" => said.push(Said::Hole(at, 4)),
                        b"M31" => said.push(self.label(at)?),
                        b"" => {
                            let cut = self.cut()?;
                            said.push(self.named(cut, said.last()));
                        }
                        _ => return None,
                    }
                }
            }
        }
        let list = &self.bytes[self.offset..];
        if !list.is_empty() {
            let lines = list.strip_suffix(b"L0*\n")?.strip_suffix(b"\n")?;
            for line in lines.split(|&byte| byte == b'\n') {
                let [letter @ b'A'..=b'Z', b',', value @ ..] = line else { return None };
                said.push(Said::Field(*letter, value.to_vec()));
            }
        }
        Some(said)
    }

    /// A code of speed.
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

    /// A label with a second point, whose first one was read.
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

    /// What is cut from here on, from the knife down to its last lift, and whether M19 says that it is a slit.
    fn cut(&mut self) -> Option<(Cut, bool)> {
        let mut cut = Cut { points: vec![self.at], feed: self.feed, ..Cut::default() };
        let mut joint = Joint::default();
        let mut block = self.block()?;
        if block == b"M17" {
            joint.full_advance = true;
            block = self.block()?;
        }
        if block != b"M14" {
            return None;
        }
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
                    joint = self.again(Joint::default())?;
                }
                b"M15" => {
                    let bare = std::mem::take(&mut self.no_overcut);
                    if matches!(self.ahead()?, b"M17" | b"M14") {
                        joint = self.again(Joint { lift: true, no_overcut: bare, ..Joint::default() })?;
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
        Some((cut, is_slit))
    }

    /// The plunge where a contour was left.
    fn again(&mut self, joint: Joint) -> Option<Joint> {
        let mut block = self.block()?;
        let full_advance = block == b"M17";
        if full_advance {
            block = self.block()?;
        }
        (block == b"M14").then_some(Joint { full_advance, ..joint })
    }

    /// A cut as what it is: a straight slit, the crossbar that its tip divides, or a contour.
    fn named(&self, (cut, is_slit): (Cut, bool), before: Option<&Said>) -> Said {
        if is_slit && cut.chords.len() == 1 {
            return Said::Slit(cut);
        }
        if let (Some(Said::Slit(slit)), [from, to]) = (before, &cut.points[..]) {
            let tip = slit.points[1];
            let (ahead, way) = (tip - from, to - from);
            let share = ahead.dot(&way) / way.norm_squared();
            // Two points of a grid may miss the line between others by its diagonal.
            let is_near = (ahead - way * share).norm() <= self.unit * 2.0_f64.sqrt();
            if is_near && share > 0.0 && share < 1.0 && cut.chords[0].1 == Joint::default() {
                return Said::Bar(cut);
            }
        }
        Said::Contour(cut)
    }
}

/// A block that is a place: the point, mm, and what stands behind it.
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
