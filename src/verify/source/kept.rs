//! Audit of the passes: every place that the file cuts or drills in the marker as it was read must do so in the marker that is
//! cut, or a pass has lost it.
//!
//! Passes may cut once what the file cuts twice. A slit that is written there and back becomes one cut, and one of two equal
//! cuts goes. So a stroke whose place is gone is no loss if another stroke of its piece cuts between the same two places, or if
//! the file draws it again along a line that is still cut.

use std::collections::BTreeSet;

use rayon::prelude::*;

use crate::geom::{Point, bits, polyline};
use crate::ir::marker::{Notch, Piece};
use crate::ir::verdict::{Sighting, Worst};
use crate::ir::{Finding, Marker};
use crate::machine::MachineProfile;
use crate::source::Span;
use crate::verify::rules;

/// Greatest displacement of two places against each other by rounding, in units of the file: its diagonal.
const DIAGONAL: f64 = std::f64::consts::SQRT_2;
/// Greatest displacement by rounding in a file without a grid, mm.
const NO_GRID: f64 = 0.01;
/// Length below which steps out and back may be left out, mm.
const SHORTEST_STEP: f64 = 1.0;
/// Distance within which a line that is drawn again lies on itself, mm.
const AGAIN: f64 = 0.15;
/// Widest mouth of a notch that replaces such a line, mm.
const MOUTH: f64 = 12.5;
/// Greatest length of the edge over a mouth, in widths of the mouth: a half circle.
const CURVED: f64 = std::f64::consts::FRAC_PI_2;
/// Longest overcut that goes straight on from the start of an outline, mm, and the cosine of its greatest turn there.
const OVERCUT: f64 = 10.2;
const STRAIGHT_ON: f64 = 0.998;
/// Distance between the samples of a stroke, mm.
const SAMPLE: f64 = 0.2;

/// Place in the file that makes a cut or a hole: a block may hold many, each at its own byte.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Cause {
    block: u32,
    byte: u32,
}

impl Cause {
    /// Cause of a place to which nothing is cut.
    const NONE: Self = Self { block: 0, byte: 0 };

    fn of(span: Span) -> Self {
        Self { block: span.block, byte: span.start }
    }
}

/// Cuts and holes of a marker, to be compared with the result of the passes: two dozen bytes a segment.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Works {
    /// Each piece, and the end of its places.
    pieces: Vec<(Name, usize)>,
    /// Places of the knife and the drills in cut order, one line after the other. One block of memory, freed as a whole.
    places: Vec<KeptPlace>,
}

/// A piece by its number and its first byte: numbers may repeat.
type Name = (u32, u32);
/// The ends of a stroke by the bits of their coordinates, in a canonical order.
type Ends = [[u64; 2]; 2];

#[derive(Debug, Clone, Copy, PartialEq)]
struct KeptPlace {
    at: Point,
    /// Cause of the cut from the place before to this one, or of the hole here when both are equal; [`Cause::NONE`] where a
    /// line begins.
    cause: Cause,
}

/// A cut from one place to another; a hole starts and ends at one place.
#[derive(Debug, Clone, Copy)]
struct KnifeStroke {
    from: Point,
    to: Point,
    cause: Cause,
}

impl KnifeStroke {
    fn ends(&self) -> Ends {
        let mut ends = [bits(self.from), bits(self.to)];
        ends.sort_unstable();
        ends
    }

    fn length(&self) -> f64 {
        (self.to - self.from).norm()
    }

    /// True if each of its samples lies within `reach` mm of one of some others.
    fn is_near(&self, others: &[Self], reach: f64) -> bool {
        self.away(others, reach).iter().all(|is_away| !is_away)
    }

    /// True for each sample along it, at least two, that is farther than `reach` mm from all of some others.
    fn away(&self, others: &[Self], reach: f64) -> Vec<bool> {
        let middle = self.from + (self.to - self.from) / 2.0;
        let around = reach + self.length() / 2.0;
        let near = others.iter().filter(|other| polyline::distance_to_segment(middle, other.from, other.to) <= around);
        let near: Vec<&Self> = near.collect();
        let steps = (self.length() / SAMPLE).ceil().max(1.0);
        let is_away = |k: usize| {
            let at = self.from + (self.to - self.from) * (k as f64 / steps);
            near.iter().all(|other| polyline::distance_to_segment(at, other.from, other.to) > reach)
        };
        (0..=steps as usize).map(is_away).collect()
    }

    fn passes(&self, point: Point) -> bool {
        polyline::distance_to_segment(point, self.from, self.to) <= AGAIN
    }

    fn is_hole(&self) -> bool {
        self.from == self.to
    }
}

/// Adds the places of a piece.
fn add_places(piece: &Piece, marker: &Marker, places: &mut Vec<KeptPlace>) {
    let first = places.len();
    let begin = |places: &mut Vec<KeptPlace>, at: Point| {
        if places[first..].last().is_none_or(|last| last.at != at) {
            places.push(KeptPlace { at, cause: Cause::NONE });
        }
    };
    let mut add = |KnifeStroke { from, to, cause }: KnifeStroke| {
        begin(places, from);
        places.push(KeptPlace { at: to, cause });
    };
    for drill in &piece.drills {
        add(KnifeStroke { from: drill.at, to: drill.at, cause: Cause::of(drill.span) });
    }
    // Strokes without length cut nothing, here and below.
    for stroke in piece.notches.iter().flat_map(Notch::strokes).filter(|stroke| stroke.from != stroke.to) {
        add(KnifeStroke { from: stroke.from, to: stroke.to, cause: Cause::of(stroke.span) });
    }
    let mut was_ring = false;
    for contour in &piece.contours {
        let (points, spans) = (marker.list.points(contour.range), marker.list.spans(contour.range));
        // A ring is a line of its own, even where another line ends at its start or begins there.
        let is_ring = points[0] == points[points.len() - 1];
        if is_ring || was_ring {
            places.push(KeptPlace { at: points[0], cause: Cause::NONE });
        } else {
            begin(places, points[0]);
        }
        was_ring = is_ring;
        let ways = points.windows(2).zip(spans.iter()).filter(|(ends, _)| ends[0] != ends[1]);
        places.extend(ways.map(|(ends, span)| KeptPlace { at: ends[1], cause: Cause::of(*span) }));
    }
}

/// Cuts and holes among some places.
fn strokes(places: &[KeptPlace]) -> impl Iterator<Item = KnifeStroke> {
    let all = places.windows(2).map(|w| KnifeStroke { from: w[0].at, to: w[1].at, cause: w[1].cause });
    all.filter(|stroke| stroke.cause.block != Cause::NONE.block)
}

/// Cuts and holes among the places of a piece as read that are missing in the piece as it is cut.
fn lost(read: &[KeptPlace], cut: &[KeptPlace], reach: f64) -> Vec<KnifeStroke> {
    if read == cut {
        return Vec::new(); // as of nearly all
    }
    let mut bytes: Vec<u32> = strokes(cut).map(|stroke| stroke.cause.byte).collect();
    bytes.sort_unstable();
    let is_there = |stroke: &KnifeStroke| bytes.binary_search(&stroke.cause.byte).is_ok();
    let mut lost: Vec<KnifeStroke> = strokes(read).filter(|stroke| !is_there(stroke)).collect();
    if lost.is_empty() {
        return lost;
    }
    let mut ends: Vec<Ends> = strokes(cut).map(|stroke| stroke.ends()).collect();
    ends.sort_unstable();
    lost.retain(|stroke| stroke.is_hole() || ends.binary_search(&stroke.ends()).is_err());
    let still: Vec<KnifeStroke> = if lost.is_empty() { Vec::new() } else { strokes(cut).collect() };
    // Strokes out and straight back, with identical coordinates.
    let mut back_and_forth: Vec<Ends> = Vec::new();
    let ways = read.windows(3).filter(|w| bits(w[0].at) == bits(w[2].at) && w[1].cause != Cause::NONE);
    back_and_forth.extend(ways.map(|w| KnifeStroke { from: w[0].at, to: w[1].at, cause: w[1].cause }.ends()));
    back_and_forth.sort_unstable();
    let is_twice = |stroke: &KnifeStroke| back_and_forth.binary_search(&stroke.ends()).is_ok();
    lost.retain(|stroke| {
        let is_step = stroke.length() < SHORTEST_STEP && is_twice(stroke);
        stroke.is_hole() || !stroke.is_near(&still, if is_step { SHORTEST_STEP } else { reach })
    });
    if !lost.is_empty() {
        let overcuts = overcuts(read);
        lost.retain(|stroke| !overcuts.contains(&stroke.cause.byte));
    }
    if !lost.is_empty() {
        let there: Vec<KnifeStroke> = strokes(read).filter(is_there).collect();
        // Ends of open lines of several strokes that are still cut.
        let is_kept = |pair: &[KeptPlace]| {
            let stroke = KnifeStroke { from: pair[0].at, to: pair[1].at, cause: pair[1].cause };
            is_there(&stroke) || ends.binary_search(&stroke.ends()).is_ok()
        };
        let lines = read.chunk_by(|_, next| next.cause != Cause::NONE);
        let open = lines.filter(|line| line.len() > 2 && line.windows(2).all(is_kept));
        let open: Vec<[Point; 2]> = open.map(|line| [line[0].at, line[line.len() - 1].at]).collect();
        let lines = lost.chunk_by(|a, b| a.to == b.from);
        let lines =
            lines.filter(|line| !stands_in_for(line, &there, &still, &open, reach)).map(<[_]>::to_vec).collect();
        let lines = joined(lines);
        let ends = lines.iter().flat_map(|line| [line[0].from, line[line.len() - 1].to]).map(bits);
        let ends: BTreeSet<[u64; 2]> = ends.collect();
        let beside = |stroke: &&KnifeStroke| ends.contains(&bits(stroke.from)) || ends.contains(&bits(stroke.to));
        let beside: Vec<KnifeStroke> = there.iter().filter(beside).copied().collect();
        lost = lines.into_iter().filter(|line| !is_mouth(line, &beside, &open)).flatten().collect();
    }
    lost.dedup_by_key(|stroke| stroke.cause.byte); // the chords of an arc are one place of the file
    lost
}

/// Bytes of the last strokes of lines that pass their start and go straight on from there: overcuts drawn by other software.
fn overcuts(read: &[KeptPlace]) -> Vec<u32> {
    let lines = read.chunk_by(|_, next| next.cause != Cause::NONE);
    let overcut = |line: &[KeptPlace]| {
        let [start, .., before, from, to] = line else { return None };
        let [way, over] = [from.at - before.at, to.at - from.at];
        let is_overcut =
            (to.at - start.at).norm() <= OVERCUT && way.dot(&over) >= STRAIGHT_ON * way.norm() * over.norm();
        (is_overcut && polyline::distance_to_segment(start.at, before.at, from.at) <= AGAIN).then_some(to.cause.byte)
    };
    lines.filter_map(overcut).collect()
}

/// True if notches replace a line that the file draws again, which is cut but for their mouths. A single gap as wide as a mouth
/// needs no notch with its own drawn line; each of several gaps needs one.
fn stands_in_for(
    line: &[KnifeStroke],
    there: &[KnifeStroke],
    still: &[KnifeStroke],
    open: &[[Point; 2]],
    reach: f64,
) -> bool {
    let mut gaps: Vec<[Point; 2]> = Vec::new();
    let mut total = 0.0;
    let mut is_in_gap = false;
    for stroke in line {
        let away = stroke.away(still, reach);
        let step = (stroke.to - stroke.from) / (away.len() - 1) as f64;
        for (is_away, k) in away.into_iter().zip(0..) {
            let at = stroke.from + step * f64::from(k);
            match gaps.last_mut() {
                Some(gap) if is_away && is_in_gap => {
                    total += (at - gap[1]).norm();
                    gap[1] = at;
                }
                _ if is_away => gaps.push([at, at]),
                _ => {}
            }
            is_in_gap = is_away;
        }
    }
    let near = |a: Point, b: Point| (a - b).norm() <= reach + 2.0 * SAMPLE + AGAIN;
    let is_mouth = |[a, b]: &[Point; 2]| {
        open.iter().any(|[from, to]| near(*a, *from) && near(*b, *to) || near(*a, *to) && near(*b, *from))
    };
    (total <= MOUTH || gaps.iter().all(is_mouth))
        && line.iter().all(|stroke| !stroke.is_hole() && stroke.is_near(there, AGAIN))
}

/// Lines joined end to start: an outline may begin in the mouth of a notch.
fn joined(mut lines: Vec<Vec<KnifeStroke>>) -> Vec<Vec<KnifeStroke>> {
    let mut i = 0;
    while i < lines.len() {
        let end = lines[i][lines[i].len() - 1].to;
        match lines.iter().position(|other| other[0].from == end).filter(|&next| next != i) {
            Some(next) => {
                let mut behind = std::mem::take(&mut lines[next]);
                lines[i].append(&mut behind);
                lines.remove(next);
                i -= usize::from(next < i);
            }
            None => i += 1,
        }
    }
    lines
}

/// True for the edge over the mouth of a notch: the ends of the line, or the strokes beside it, meet both ends of an open line
/// that is still cut.
fn is_mouth(line: &[KnifeStroke], beside: &[KnifeStroke], open: &[[Point; 2]]) -> bool {
    let (from, to) = (line[0].from, line[line.len() - 1].to);
    let ahead = |end: Point| {
        let mut before = beside.iter().filter(|stroke| stroke.to == from);
        (end - from).norm() <= AGAIN || before.any(|stroke| stroke.passes(end))
    };
    let behind = |end: Point| {
        let mut next = beside.iter().filter(|stroke| stroke.from == to);
        (end - to).norm() <= AGAIN || next.any(|stroke| stroke.passes(end))
    };
    let length: f64 = line.iter().map(KnifeStroke::length).sum();
    let is_over = |[a, b]: [Point; 2]| {
        let (mouth, edge) = ((b - a).norm(), (a - from).norm() + length + (b - to).norm());
        mouth <= MOUTH && edge <= CURVED * mouth + 2.0 * AGAIN && ahead(a) && behind(b)
    };
    open.iter().any(|&[a, b]| is_over([a, b]) || is_over([b, a]))
}

impl Works {
    /// Cuts and holes of a marker, block by block.
    pub fn of(marker: &Marker) -> Self {
        let mut works = Self { pieces: Vec::with_capacity(marker.pieces.len()), places: Vec::new() };
        let room = |piece: &Piece| {
            let points = piece.contours.iter().map(|contour| marker.list.points(contour.range).len());
            points.sum::<usize>() + 4 * piece.notches.len() + 2 * piece.drills.len()
        };
        works.places.reserve_exact(marker.pieces.iter().map(room).sum());
        for piece in &marker.pieces {
            add_places(piece, marker, &mut works.places);
            works.pieces.push((name(piece), works.places.len()));
        }
        works
    }

    /// Each piece with its places.
    fn each(&self) -> impl Iterator<Item = (Name, &[KeptPlace])> {
        let starts = std::iter::once(0).chain(self.pieces.iter().map(|(_, end)| *end));
        self.pieces.iter().zip(starts).map(|(&(name, end), start)| (name, &self.places[start..end]))
    }

    /// Checks that all of it is still cut in the marker after the passes, for the pieces that are there: pieces that were not
    /// selected are missing as a whole.
    pub fn kept(&self, marker: &Marker, profile: &MachineProfile) -> Finding {
        let rounding = if marker.unit > 0.0 { DIAGONAL * marker.unit } else { NO_GRID };
        let reach = profile.notch.box_max_mm / 2.0 + rounding;
        let wholes = marker.wholes();
        let mut cut: Vec<&Piece> = wholes.iter().collect();
        cut.sort_by_key(|piece| name(piece));
        let lost_of = |(of, read): (Name, &[KeptPlace])| {
            let Ok(place) = cut.binary_search_by_key(&of, |piece| name(piece)) else { return Vec::new() };
            let mut places = Vec::with_capacity(read.len());
            add_places(cut[place], marker, &mut places);
            lost(read, &places, reach)
        };
        let read: Vec<(Name, &[KeptPlace])> = self.each().collect();
        let lost: Vec<Vec<KnifeStroke>> = read.into_par_iter().map(lost_of).collect();
        let mut worst = Worst::new(&rules::SOURCE_KEPT, Some(0.0));
        for (lost, count) in lost.into_iter().flatten().zip(1..) {
            worst.see(f64::from(count), || Sighting::missing(lost.to, lost.cause.block));
        }
        worst.finding()
    }
}

fn name(piece: &Piece) -> Name {
    (piece.number, piece.span.start)
}
