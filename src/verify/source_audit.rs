//! A small scan of the source bytes by other means than the reader's: what it counts must be what the marker holds, so
//! that a fault of the reader is seen, too.

use std::f64::consts::TAU;

use super::kept::{self, Work};
use super::source_hpgl;
use super::worst::Worst;
use crate::geom::{Extent, Point, Vector};
use crate::ir::marker::Drawing;
use crate::ir::{Finding, Marker};
use crate::machine::MachineProfile;

/// Rounding of sums of lengths, as a part of them.
const LENGTH_EPSILON: f64 = 1e-9;
/// Farthest that the chords of an arc may lie off it, as a part of the tolerance: a curve that is drawn coarser leaves the
/// knife no room.
pub(super) const ARC_SAGITTA: f64 = 0.25;

/// What is cut: points reached with the knife down, holes, length and bounds.
#[derive(Debug, Clone, PartialEq)]
pub struct Census {
    /// Points that the knife is led to while it is down.
    pub points: usize,
    /// Holes.
    pub drills: usize,
    /// Way of the knife while it is down, mm.
    pub length: f64,
    /// The box around all of it.
    pub bounds: Extent,
    /// What the numbers of the file are multiples of, mm.
    pub unit: f64,
    /// What cuts or drills, block by block; a scan of the bytes does not tell.
    pub(super) works: Vec<Work>,
}

impl Census {
    /// The census of a marker as it was read, before any pass.
    pub fn of(marker: &Marker) -> Self {
        let mut census = Self {
            works: kept::works(marker),
            points: 0,
            drills: 0,
            length: marker.cut_length(),
            bounds: marker.extent(),
            unit: marker.unit,
        };
        for piece in &marker.pieces {
            census.points += piece.notches.iter().filter(|notch| notch.root != notch.tip).count();
            census.drills += piece.drills.len();
            for contour in &piece.contours {
                let mut span = None;
                for (_, segment) in marker.list.walk(contour.range) {
                    // The chords of an arc come from one place and are one point of the file.
                    let is_new = segment.span.block == 0 || span.replace(segment.span) != Some(segment.span);
                    census.points += usize::from(is_new && segment.from != segment.to);
                }
            }
        }
        // A plot draws more than is cut, and its marker keeps account of that.
        if let Some(Drawing { aside, .. }) = &marker.drawing {
            census.points += aside.points;
            census.length += aside.length;
            if !aside.bounds.is_empty() {
                census.bounds.add(aside.bounds.min);
                census.bounds.add(aside.bounds.max);
            }
        }
        census
    }
}

/// Whether all that was read is still cut behind the passes, of the pieces that are there.
pub fn source_kept(read: &Census, marker: &Marker) -> Finding {
    kept::kept(&read.works, marker)
}

/// Compares a marker as it was read with a scan of the bytes; `None` when there is no scan for the dialect.
pub fn source_audit(dialect: &str, bytes: &[u8], read: &Census, profile: &MachineProfile) -> Option<Vec<Finding>> {
    let (scanned, slack) = match dialect {
        "iso" => scan_iso(bytes, read.unit, profile),
        "hpgl" => source_hpgl::scan(bytes, read, profile),
        _ => return None,
    };
    let corner = |a: Point, b: Point| (a - b).amax();
    let bounds = match (read.bounds.is_empty(), scanned.bounds.is_empty()) {
        (true, true) => 0.0,
        (false, false) => corner(read.bounds.min, scanned.bounds.min).max(corner(read.bounds.max, scanned.bounds.max)),
        _ => f64::INFINITY,
    };
    let nowhere = || super::worst::at(0.0, Point::origin(), 0);
    let finding = |rule, unit, value: f64, limit| {
        let mut worst = Worst::new(rule, unit, Some(limit));
        worst.see(value, nowhere);
        Finding { place: None, ..worst.finding() }
    };
    let length = (read.length - scanned.length).abs();
    Some(vec![
        finding("source/points", "points", read.points.abs_diff(scanned.points) as f64, 0.0),
        finding("source/drills", "holes", read.drills.abs_diff(scanned.drills) as f64, 0.0),
        finding("source/length", "mm", length, LENGTH_EPSILON * (1.0 + read.length) + slack.length),
        finding("source/bounds", "mm", bounds, LENGTH_EPSILON + slack.bounds),
    ])
}

/// Scans a cut file. Only what moves the knife matters here; everything else is passed over.
fn scan_iso(bytes: &[u8], unit: f64, profile: &MachineProfile) -> (Census, Slack) {
    let mut census = Census { points: 0, drills: 0, length: 0.0, bounds: Extent::EMPTY, unit, works: Vec::new() };
    let mut slack = Slack { sagitta: profile.tolerance(unit) * ARC_SAGITTA, length: 0.0, bounds: 0.0 };
    let mut blocks = Blocks { bytes, at: 0 };
    let (mut at, mut down) = (Point::origin(), false);
    // Whether the knife was led here for a hole; whether a drill waits for its place; which way arcs go.
    let (mut fresh, mut waiting, mut way) = (false, false, 0.0);
    let mut stroke = Stroke::new(at);
    while let Some(block) = blocks.next(false) {
        let Some(words) = words(&block) else { continue };
        let has =
            |code: &str| words.iter().any(|(letter, number)| format!("{letter}{}", number.unwrap_or(0.0)) == code);
        let value =
            |of: char| words.iter().find(|(letter, _)| *letter == of).map(|(_, n)| n.unwrap_or(f64::NAN) * unit);
        let moves = ['X', 'Y', 'I', 'J'].iter().any(|&letter| value(letter).is_some())
            && !words.iter().any(|w| w.0 == 'Q' || w.0 == 'Z');
        if has("M31") || has("M20") {
            if has("M31") && !moves && blocks.clone().next(false).is_some_and(|next| is_place(&next)) {
                blocks.next(false);
            }
            blocks.next(true);
            continue;
        }
        if has("M15") || words[0].0 == 'A' {
            stroke.finish(&mut census);
            (down, fresh) = (false, false);
        }
        if (has("M14") || words[0].0 == 'B') && !down {
            down = true;
            stroke = Stroke::new(at);
        }
        for (code, turn) in [("G1", 0.0), ("G2", -1.0), ("G3", 1.0)] {
            if has(code) && profile.obeys(code) {
                way = turn;
            }
        }
        if moves {
            let to = Point::new(value('X').unwrap_or(at.x), value('Y').unwrap_or(at.y));
            let centre = Vector::new(value('I').unwrap_or(0.0), value('J').unwrap_or(0.0));
            fresh = true;
            if down {
                match (value('R').filter(|r| r.is_finite()), value('I').or(value('J'))) {
                    (_, Some(_)) if way != 0.0 => stroke.arc(to, centre, way, &mut slack),
                    (Some(radius), None) if way != 0.0 => stroke.arc(to, bulge(to - at, radius, way), way, &mut slack),
                    _ => stroke.line(to),
                }
            }
            at = to;
            if std::mem::take(&mut waiting) {
                census.bounds.add(at);
            }
        }
        // A bare R has no number; the profile knows it by its letter.
        let drills = [("M43", "M43"), ("R0", "R"), ("M44", "M44"), ("M45", "M45"), ("M72", "M72"), ("M73", "M73")];
        if drills.iter().any(|(code, name)| has(code) && profile.obeys(name)) {
            census.drills += 1;
            waiting = !fresh && place_follows(blocks.clone());
            if !waiting {
                census.bounds.add(at);
            }
            fresh = false;
        }
    }
    stroke.finish(&mut census);
    (census, slack)
}

/// What the chords of arcs may change, mm.
pub(super) struct Slack {
    /// Farthest that a chord may lie off its arc.
    pub(super) sagitta: f64,
    pub(super) length: f64,
    pub(super) bounds: f64,
}

/// What the knife does between going down and up.
struct Stroke {
    at: Point,
    points: usize,
    length: f64,
    bounds: Extent,
}

impl Stroke {
    fn new(at: Point) -> Self {
        let mut bounds = Extent::EMPTY;
        bounds.add(at);
        Self { at, points: 0, length: 0.0, bounds }
    }

    fn line(&mut self, to: Point) {
        self.points += usize::from(to != self.at);
        self.length += (to - self.at).norm();
        self.bounds.add(to);
        self.at = to;
    }

    /// An arc around `at + centre`, `way` 1 counter-clockwise and -1 clockwise; it is longer than its chords by
    /// s / (3 r) of its length, s their sagitta.
    fn arc(&mut self, to: Point, centre: Vector, way: f64, slack: &mut Slack) {
        let around = self.at + centre;
        let (start, end) = (-centre, to - around);
        let radius = start.norm();
        let angle = |v: Vector| v.y.atan2(v.x);
        let turned = (way * (angle(end) - angle(start))).rem_euclid(TAU);
        let sweep = if to == self.at { TAU } else { turned };
        for quarter in 0..4 {
            let extreme = f64::from(quarter) * TAU / 4.0;
            if (way * (extreme - angle(start))).rem_euclid(TAU) < sweep {
                self.bounds.add(around + Vector::new(extreme.cos(), extreme.sin()) * radius);
            }
        }
        let length = sweep * radius;
        self.points += 1;
        self.length += length;
        self.bounds.add(to);
        self.at = to;
        let uneven = (end.norm() - radius).abs();
        slack.length += length * (slack.sagitta / (3.0 * radius)).min(1.0) + uneven * (1.0 + sweep);
        slack.bounds = slack.bounds.max(slack.sagitta + uneven);
    }

    /// A stroke that never moves cuts nothing.
    fn finish(&mut self, census: &mut Census) {
        if self.points > 0 {
            census.points += self.points;
            census.length += self.length;
            census.bounds.add(self.bounds.min);
            census.bounds.add(self.bounds.max);
        }
        *self = Self::new(self.at);
    }
}

/// Where the centre of an arc lies as seen from its start, when the file gives the radius: negative, the longer way round.
fn bulge(chord: Vector, radius: f64, way: f64) -> Vector {
    let half = chord.norm() / 2.0;
    let height = (radius * radius - half * half).max(0.0).sqrt() * way * radius.signum();
    chord / 2.0 + Vector::new(-chord.y, chord.x) / (2.0 * half) * height
}

/// The blocks of a file.
#[derive(Clone)]
struct Blocks<'a> {
    bytes: &'a [u8],
    at: usize,
}

impl Blocks<'_> {
    /// The next block, without blanks. What stands between two slashes is deleted; in a text it is not.
    fn next(&mut self, is_text: bool) -> Option<Vec<u8>> {
        let mut block = Vec::new();
        if self.at >= self.bytes.len() {
            return None;
        }
        while let Some(&byte) = self.bytes.get(self.at) {
            self.at += 1;
            match byte {
                b'*' => return Some(squeeze(&block)),
                b'/' if !is_text => {
                    self.at += self.bytes[self.at..].iter().position(|&b| b == b'/').map_or(0, |i| i + 1);
                }
                _ => block.push(byte),
            }
        }
        Some(squeeze(&block))
    }
}

/// Whether the next block is a place, but not the start of a contour.
fn place_follows(mut blocks: Blocks) -> bool {
    let is_down = |block: Vec<u8>| words(&block).is_some_and(|words| words.contains(&('M', Some(14.0))));
    blocks.next(false).is_some_and(|block| is_place(&block)) && !blocks.next(false).is_some_and(is_down)
}

fn squeeze(block: &[u8]) -> Vec<u8> {
    block.iter().copied().filter(|b| !matches!(b, b'\r' | b'\n' | b' ' | b'\t' | 0 | 0x1a)).collect()
}

/// The words of a block: a letter and the number behind it. `None` when it is no such thing, but a text: codes have
/// numbers, all but one at the most.
fn words(block: &[u8]) -> Option<Vec<(char, Option<f64>)>> {
    let mut words: Vec<(char, Option<f64>)> = Vec::new();
    let mut rest = block;
    while let [letter, behind @ ..] = rest {
        if !letter.is_ascii_uppercase() {
            return None;
        }
        let end = behind.iter().position(u8::is_ascii_uppercase).unwrap_or(behind.len());
        let number = std::str::from_utf8(&behind[..end]).ok()?;
        words.push((char::from(*letter), if number.is_empty() { None } else { Some(number.parse().ok()?) }));
        rest = &behind[end..];
    }
    let bare = words.iter().filter(|(_, number)| number.is_none()).count();
    (!words.is_empty() && bare <= 1).then_some(words)
}

fn is_place(block: &[u8]) -> bool {
    words(block)
        .is_some_and(|words| words.iter().all(|(letter, number)| matches!(letter, 'X' | 'Y') && number.is_some()))
}
