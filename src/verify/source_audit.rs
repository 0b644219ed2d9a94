//! A small scan of the source bytes by other means than the reader's: what it counts must be what the marker holds, so
//! that a fault of the reader is seen, too.

use super::worst::Worst;
use crate::geom::{Extent, Point};
use crate::ir::{Finding, Marker};

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
}

impl Census {
    /// The census of a marker as it was read, before any pass.
    pub fn of(marker: &Marker) -> Self {
        let mut census = Self { points: 0, drills: 0, length: marker.cut_length(), bounds: marker.extent() };
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
pub fn source_audit(dialect: &str, bytes: &[u8], read: &Census, unit: f64) -> Option<Vec<Finding>> {
    let scanned = match dialect {
        "iso" => scan_iso(bytes, unit),
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
fn scan_iso(bytes: &[u8], unit: f64) -> Census {
    let mut census = Census { points: 0, drills: 0, length: 0.0, bounds: Extent::EMPTY };
    let mut blocks = bytes.split(|&b| b == b'*').map(squeeze).peekable();
    let (mut at, mut down) = (Point::origin(), false);
    // Points of the stroke under way, so that one that never moves counts for nothing.
    let mut stroke: Vec<Point> = Vec::new();
    while let Some(block) = blocks.next() {
        let Some(words) = words(&block) else { continue };
        let has =
            |code: &str| words.iter().any(|(letter, number)| format!("{letter}{}", number.unwrap_or(0.0)) == code);
        let is_label = has("M31");
        let moves = words.iter().any(|(letter, _)| matches!(letter, 'X' | 'Y'))
            && !words.iter().any(|w| w.0 == 'Q' || w.0 == 'Z');
        if is_label || has("M20") {
            let placed = moves;
            if is_label && !placed && blocks.peek().is_some_and(|next| is_place(next)) {
                blocks.next();
            }
            blocks.next();
            continue;
        }
        if has("M15") || words[0].0 == 'A' {
            finish(&mut stroke, &mut census);
            down = false;
        }
        if has("M14") || words[0].0 == 'B' {
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
            if down {
                stroke.push(at);
            }
        }
        if ["M43", "R0", "M44", "M45", "M72", "M73"].iter().any(|code| has(code)) {
            census.drills += 1;
            census.bounds.add(at);
        }
        if has("M0") {
            break;
        }
    }
    finish(&mut stroke, &mut census);
    census
}

fn finish(stroke: &mut Vec<Point>, census: &mut Census) {
    if stroke.len() > 1 {
        census.points += stroke.len() - 1;
        census.length += stroke.windows(2).map(|w| (w[1] - w[0]).norm()).sum::<f64>();
        for &point in stroke.iter() {
            census.bounds.add(point);
        }
    }
    stroke.clear();
}

fn squeeze(block: &[u8]) -> Vec<u8> {
    block.iter().copied().filter(|b| !matches!(b, b'\r' | b'\n' | b' ' | b'\t' | 0 | 0x1a)).collect()
}

/// The words of a block: a letter and the number behind it. `None` when it is no such thing.
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
    (!words.is_empty()).then_some(words)
}

fn is_place(block: &[u8]) -> bool {
    words(block)
        .is_some_and(|words| words.iter().all(|(letter, number)| matches!(letter, 'X' | 'Y') && number.is_some()))
}
