//! A small scan of the source bytes by other means than the reader's: what it counts must be what the marker holds, so
//! that a fault of the reader is seen, too.

use super::worst::Worst;
use crate::geom::{Extent, Point};
use crate::ir::{Finding, Marker};
use crate::machine::MachineProfile;

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
}

impl Census {
    /// The census of a marker as it was read, before any pass.
    pub fn of(marker: &Marker) -> Self {
        let mut census =
            Self { points: 0, drills: 0, length: marker.cut_length(), bounds: marker.extent(), unit: marker.unit };
        for piece in &marker.pieces {
            census.points += piece.notches.len();
            census.drills += piece.drills.len();
            for contour in &piece.contours {
                census.points += marker.list.walk(contour.range).count();
            }
        }
        census
    }
}

/// Compares a marker as it was read with a scan of the bytes; `None` when there is no scan for the dialect.
pub fn source_audit(dialect: &str, bytes: &[u8], read: &Census, profile: &MachineProfile) -> Option<Vec<Finding>> {
    let scanned = match dialect {
        "iso" => scan_iso(bytes, read.unit, profile),
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
    Some(vec![
        finding("source/points", "points", read.points.abs_diff(scanned.points) as f64, 0.0),
        finding("source/drills", "holes", read.drills.abs_diff(scanned.drills) as f64, 0.0),
        finding("source/length", "mm", (read.length - scanned.length).abs(), LENGTH_EPSILON * (1.0 + read.length)),
        finding("source/bounds", "mm", bounds, LENGTH_EPSILON),
    ])
}

/// Rounding of sums of lengths, as a part of them.
const LENGTH_EPSILON: f64 = 1e-9;

/// Scans a cut file. Only what moves the knife matters here; everything else is passed over.
fn scan_iso(bytes: &[u8], unit: f64, profile: &MachineProfile) -> Census {
    let mut census = Census { points: 0, drills: 0, length: 0.0, bounds: Extent::EMPTY, unit };
    let mut blocks = Blocks { bytes, at: 0 };
    let (mut at, mut down) = (Point::origin(), false);
    // Whether the knife was led here for a hole; whether a drill waits for its place.
    let (mut fresh, mut waiting) = (false, false);
    // Points of the stroke under way, so that one that never moves counts for nothing.
    let mut stroke: Vec<Point> = Vec::new();
    while let Some(block) = blocks.next(false) {
        let Some(words) = words(&block) else { continue };
        let has =
            |code: &str| words.iter().any(|(letter, number)| format!("{letter}{}", number.unwrap_or(0.0)) == code);
        let moves = words.iter().any(|(letter, _)| matches!(letter, 'X' | 'Y'))
            && !words.iter().any(|w| w.0 == 'Q' || w.0 == 'Z');
        if has("M31") || has("M20") {
            if has("M31") && !moves && blocks.clone().next(false).is_some_and(|next| is_place(&next)) {
                blocks.next(false);
            }
            blocks.next(true);
            continue;
        }
        if has("M15") || words[0].0 == 'A' {
            finish(&mut stroke, &mut census);
            (down, fresh) = (false, false);
        }
        if (has("M14") || words[0].0 == 'B') && !down {
            down = true;
            stroke = vec![at];
        }
        if moves {
            for (letter, number) in &words {
                match letter {
                    'X' => at.x = number.unwrap_or(f64::NAN) * unit,
                    'Y' => at.y = number.unwrap_or(f64::NAN) * unit,
                    _ => {}
                }
            }
            fresh = true;
            if down {
                stroke.push(at);
            }
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
    finish(&mut stroke, &mut census);
    census
}

fn finish(stroke: &mut Vec<Point>, census: &mut Census) {
    stroke.dedup();
    if stroke.len() > 1 {
        census.points += stroke.len() - 1;
        census.length += stroke.windows(2).map(|w| (w[1] - w[0]).norm()).sum::<f64>();
        for &point in stroke.iter() {
            census.bounds.add(point);
        }
    }
    stroke.clear();
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
