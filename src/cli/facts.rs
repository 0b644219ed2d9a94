//! Requests of a cutter file beyond its outlines: notches by kind and depth, speeds, events.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use serde::Serialize;

use crate::ir::Marker;
use crate::ir::marker::NotchKind;
use crate::ir::toolpath;
use crate::pipeline::significant;
use crate::units::MM_PER_M;
use crate::units::number::fixed;

/// Resolution of notch depths: a tenth of a millimetre. Finer differences are rounding of the file.
const DEPTHS_PER_MM: f64 = 10.0;
/// Significant digits of lengths and speeds, far below the resolution of a machine.
const DIGITS: i32 = 9;
/// Speed of a cut that is not slowed, percent.
const FULL: u8 = 100;
/// Maximum columns of a list of piece numbers, so that its line stays within 80.
const LIST_COLUMNS: usize = 42;

/// The facts of a marker. Fields are keys of the JSON output.
#[derive(Debug, Serialize)]
pub(super) struct Facts {
    notch_depths: Vec<Alike>,
    speeds: Vec<Speed>,
    events: Vec<Event>,
}

/// Notches of one kind and depth.
#[derive(Debug, Serialize)]
struct Alike {
    kind: &'static str,
    depth_mm: f64,
    count: usize,
}

/// Cuts at one speed.
#[derive(Debug, Serialize)]
struct Speed {
    /// The speed that the file asks for; `None` for that of the profile.
    feed_mm_s: Option<f64>,
    /// Percentage of that speed where the file slows the cut.
    percent: u8,
    cut_m: f64,
    pieces: Vec<u32>,
}

/// A stop or an advance of the cloth.
#[derive(Debug, Serialize)]
struct Event {
    kind: &'static str,
    /// Number of the piece that follows; `None` at the end of the file.
    before_piece: Option<u32>,
    block: u32,
}

impl Facts {
    /// The facts of a marker.
    pub(super) fn of(marker: &Marker) -> Self {
        Self { notch_depths: depths(marker), speeds: speeds(marker), events: events(marker) }
    }

    /// A table of notches, of speeds and of events, each only if the file has any.
    pub(super) fn text(&self) -> String {
        let mut out = String::new();
        // Writing into a `String` cannot fail, so the results of `writeln!` are dropped throughout.
        let width = self.notch_depths.iter().map(|alike| alike.kind.len()).max().unwrap_or(0).max("notch".len());
        if !self.notch_depths.is_empty() {
            let _ = writeln!(out, "\n  {:width$}  depth mm  count", "notch");
        }
        for Alike { kind, depth_mm, count } in &self.notch_depths {
            let _ = writeln!(out, "  {kind:width$}  {:>8}  {count:>5}", fixed(*depth_mm, 1));
        }
        if self.speeds.iter().any(|speed| speed.feed_mm_s.is_some() || speed.percent != FULL) {
            out.push_str("\n  feed mm/s  percent     cut m  pieces\n");
            for speed in &self.speeds {
                let feed = speed.feed_mm_s.map_or("profile".to_owned(), |feed| fixed(feed, 1));
                let (cut, pieces) = (fixed(speed.cut_m, 3), list(speed.pieces.iter().copied().map(Some)));
                let _ = writeln!(out, "  {feed:>9}  {:>7}  {cut:>8}  {pieces}", speed.percent);
            }
        }
        if !self.events.is_empty() {
            out.push_str("\n  event    count  before piece\n");
        }
        for kind in [name(toolpath::Event::Stop), name(toolpath::Event::Advance)] {
            let places: Vec<_> = self.events.iter().filter(|e| e.kind == kind).map(|e| e.before_piece).collect();
            if !places.is_empty() {
                let _ = writeln!(out, "  {kind:7}  {:>5}  {}", places.len(), list(places.iter().copied()));
            }
        }
        out
    }
}

fn depths(marker: &Marker) -> Vec<Alike> {
    let mut counts: BTreeMap<(&str, i64), usize> = BTreeMap::new();
    let rounded = |depth: f64| (depth * DEPTHS_PER_MM).round() as i64;
    for piece in &marker.pieces {
        for notch in &piece.notches {
            let kind = match notch.kind {
                NotchKind::Slit => "slit",
                NotchKind::T(_) => "t",
            };
            *counts.entry((kind, rounded(notch.depth()))).or_default() += 1;
        }
        for notch in &piece.outline_notches {
            *counts.entry((notch.word(), rounded(notch.depth()))).or_default() += 1;
        }
    }
    let depth = |((kind, depth), count)| Alike { kind, depth_mm: depth as f64 / DEPTHS_PER_MM, count };
    counts.into_iter().map(depth).collect()
}

/// Cuts by speed: those at the speed of the profile first, then the others from fast to slow.
fn speeds(marker: &Marker) -> Vec<Speed> {
    // The key consists of the bits of the feed, which for positive numbers are ordered like the numbers, and the percentage.
    let mut speeds: BTreeMap<(u64, u8), Speed> = BTreeMap::new();
    for piece in &marker.pieces {
        let feed_mm_s = piece.feed.map(|feed| significant(feed, DIGITS));
        let key = feed_mm_s.map_or(u64::MAX, f64::to_bits);
        let chords = piece.contours.iter().flat_map(|contour| marker.list.walk(contour.range));
        let cuts = chords.map(|(_, segment)| (segment.percent, segment.length()));
        for (percent, length) in cuts.chain(piece.notches.iter().map(|notch| (notch.percent, notch.depth()))) {
            let blank = Speed { feed_mm_s, percent, cut_m: 0.0, pieces: Vec::new() };
            let speed = speeds.entry((key, percent)).or_insert(blank);
            speed.cut_m += length / MM_PER_M;
            if speed.pieces.last() != Some(&piece.number) {
                speed.pieces.push(piece.number);
            }
        }
    }
    speeds.into_values().rev().map(|speed| Speed { cut_m: significant(speed.cut_m, DIGITS), ..speed }).collect()
}

fn events(marker: &Marker) -> Vec<Event> {
    let before = marker.pieces.iter().flat_map(|piece| piece.events.iter().map(|event| (Some(piece.number), event)));
    let all = before.chain(marker.closing.iter().map(|event| (None, event)));
    all.map(|(before_piece, event)| Event { kind: name(event.kind), before_piece, block: event.span.block }).collect()
}

fn name(event: toolpath::Event) -> &'static str {
    match event {
        toolpath::Event::Stop => "stop",
        toolpath::Event::Advance | toolpath::Event::AdvanceBy(_) => "advance",
    }
}

/// Piece numbers with consecutive ones as ranges and `None` as the end of the file: `2, 7-9, end`. Numbers that do not fit the
/// line are dropped.
fn list(numbers: impl Iterator<Item = Option<u32>>) -> String {
    let mut ranges: Vec<[Option<u32>; 2]> = Vec::new();
    for number in numbers {
        match ranges.last_mut() {
            Some([Some(_), Some(last)]) if last.checked_add(1).is_some_and(|next| Some(next) == number) => *last += 1,
            _ => ranges.push([number; 2]),
        }
    }
    let mut out = String::new();
    for [first, last] in ranges {
        let range = match (first, last) {
            (Some(first), Some(last)) if first != last => format!("{first}-{last}"),
            (Some(first), _) => first.to_string(),
            (None, _) => "end".to_owned(),
        };
        let comma = if out.is_empty() { "" } else { ", " };
        if out.len() + comma.len() + range.len() > LIST_COLUMNS {
            return out + ", ...";
        }
        let _ = write!(out, "{comma}{range}");
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn piece_numbers_are_listed_by_ranges_within_a_line() {
        let check = |numbers: &[u32], expected: &str| assert_eq!(list(numbers.iter().copied().map(Some)), expected);
        check(&[2, 7, 8, 9], "2, 7-9");
        check(&[3, 2, 1], "3, 2, 1");
        check(&[u32::MAX, 0], "4294967295, 0");
        check(&[], "");
        assert_eq!(list([Some(1), Some(2), None, None].into_iter()), "1-2, end, end");
        let odd: Vec<_> = (0..1000).map(|k| Some(2 * k + 1)).collect();
        let text = list(odd.into_iter());
        assert!(text.ends_with(", ...") && text.len() <= LIST_COLUMNS + 5, "{text}");
    }
}
