//! Whether what was read is still there behind the passes: every block that cuts or drills something in the marker as it
//! was read does so in the marker that is cut, or a pass has lost it.
//!
//! Passes may cut once what the file cuts twice: a slit that is written there and back becomes one cut, and of two that
//! are the same one goes. So a stroke whose block is gone is no loss while another one of its piece cuts between the same
//! two places, or while the file draws it again, along a line whose block is there.

use rayon::prelude::*;

use crate::geom::{Point, bits, polyline};
use crate::ir::finding::Sighting;
use crate::ir::marker::{Notch, Piece};
use crate::ir::{Finding, Marker};
use crate::machine::MachineProfile;
use crate::verify::worst::Worst;

/// How far rounding moves one place against another, in units of the file: its diagonal.
const DIAGONAL: f64 = std::f64::consts::SQRT_2;
/// The same where the file has no grid, mm.
const NO_GRID: f64 = 0.01;
/// Steps out and back that are shorter may be left out, mm.
const SHORTEST_STEP: f64 = 1.0;
/// Distance within which a line that is drawn again lies on itself, mm.
const AGAIN: f64 = 0.15;
/// Places of a stroke are looked at so far from each other, mm.
const SAMPLE: f64 = 0.2;

/// Block of a place to which nothing is cut.
const NO_BLOCK: u32 = 0;

/// All that a marker cuts or drills, to be compared with what passes make of it: two dozen bytes a segment.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Works {
    /// Each piece, and where its places end.
    pieces: Vec<(Name, usize)>,
    /// Where the knife or a drill comes to, in cut order: one line behind the other. In one block of memory, which is given
    /// back as a whole.
    places: Vec<KeptPlace>,
}

/// A piece by its number and the byte at which it starts: numbers may come again.
type Name = (u32, u32);
/// The ends of a stroke by the bits of their coordinates, whichever way round.
type Ends = [[u64; 2]; 2];

#[derive(Debug, Clone, Copy, PartialEq)]
struct KeptPlace {
    at: Point,
    /// The block that cuts from the place before to this one, or that drills here when both are the same; [`NO_BLOCK`]
    /// where a line begins.
    block: u32,
}

/// A cut from one place to another; a hole goes from its place to the same.
#[derive(Debug, Clone, Copy)]
struct KnifeStroke {
    from: Point,
    to: Point,
    block: u32,
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

    /// Whether each place of it lies so near to one of some others, mm.
    fn is_near(&self, others: &[Self], reach: f64) -> bool {
        let middle = self.from + (self.to - self.from) / 2.0;
        let around = reach + self.length() / 2.0;
        let near = others.iter().filter(|other| polyline::distance_to_segment(middle, other.from, other.to) <= around);
        let near: Vec<&Self> = near.collect();
        let steps = (self.length() / SAMPLE).ceil().max(1.0);
        (0..=steps as usize).all(|k| {
            let at = self.from + (self.to - self.from) * (k as f64 / steps);
            near.iter().any(|other| polyline::distance_to_segment(at, other.from, other.to) <= reach)
        })
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
            places.push(KeptPlace { at, block: NO_BLOCK });
        }
    };
    let mut add = |KnifeStroke { from, to, block }: KnifeStroke| {
        begin(places, from);
        places.push(KeptPlace { at: to, block });
    };
    for drill in &piece.drills {
        add(KnifeStroke { from: drill.at, to: drill.at, block: drill.span.block });
    }
    // What has no length cuts nothing, here and below.
    for stroke in piece.notches.iter().flat_map(Notch::strokes).filter(|stroke| stroke.from != stroke.to) {
        add(KnifeStroke { from: stroke.from, to: stroke.to, block: stroke.span.block });
    }
    for contour in &piece.contours {
        let (points, spans) = (marker.list.points(contour.range), marker.list.spans(contour.range));
        begin(places, points[0]);
        let ways = points.windows(2).zip(spans.iter()).filter(|(ends, _)| ends[0] != ends[1]);
        places.extend(ways.map(|(ends, span)| KeptPlace { at: ends[1], block: span.block }));
    }
}

/// What a block of the file cuts or drills: what has none is from no file.
fn strokes(places: &[KeptPlace]) -> impl Iterator<Item = KnifeStroke> {
    let all = places.windows(2).map(|w| KnifeStroke { from: w[0].at, to: w[1].at, block: w[1].block });
    all.filter(|stroke| stroke.block != NO_BLOCK)
}

/// What is done in the places of a piece and no more in those of the piece as it is cut.
fn lost(read: &[KeptPlace], cut: &[KeptPlace], reach: f64) -> Vec<KnifeStroke> {
    if read == cut {
        return Vec::new(); // as of nearly all
    }
    let mut blocks: Vec<u32> = strokes(cut).map(|stroke| stroke.block).collect();
    blocks.sort_unstable();
    let is_there = |stroke: &KnifeStroke| blocks.binary_search(&stroke.block).is_ok();
    let mut lost: Vec<KnifeStroke> = strokes(read).filter(|stroke| !is_there(stroke)).collect();
    if lost.is_empty() {
        return lost;
    }
    let mut ends: Vec<Ends> = strokes(cut).map(|stroke| stroke.ends()).collect();
    ends.sort_unstable();
    lost.retain(|stroke| stroke.is_hole() || ends.binary_search(&stroke.ends()).is_err());
    let still: Vec<KnifeStroke> = if lost.is_empty() { Vec::new() } else { strokes(cut).collect() };
    // Out and straight back in a row, to the bit.
    let mut back_and_forth: Vec<Ends> = Vec::new();
    let ways = read.windows(3).filter(|w| bits(w[0].at) == bits(w[2].at) && w[1].block != NO_BLOCK);
    back_and_forth.extend(ways.map(|w| KnifeStroke { from: w[0].at, to: w[1].at, block: w[1].block }.ends()));
    back_and_forth.sort_unstable();
    let is_twice = |stroke: &KnifeStroke| back_and_forth.binary_search(&stroke.ends()).is_ok();
    lost.retain(|stroke| {
        let is_step = stroke.length() < SHORTEST_STEP && is_twice(stroke);
        stroke.is_hole() || !stroke.is_near(&still, if is_step { SHORTEST_STEP } else { reach })
    });
    // A notch may stand in the place of the edge that is drawn twice.
    if !lost.is_empty() {
        let there: Vec<KnifeStroke> = strokes(read).filter(is_there).collect();
        lost.retain(|stroke| stroke.is_hole() || !stroke.is_near(&there, AGAIN));
    }
    lost.dedup_by_key(|stroke| stroke.block); // the chords of an arc are one block
    lost
}

impl Works {
    /// What a marker cuts and drills, block by block.
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

    /// Whether all of it is still cut in what passes made of the marker, of the pieces that are there: those that were not
    /// selected are gone as a whole.
    pub fn kept(&self, marker: &Marker, profile: &MachineProfile) -> Finding {
        let rounding = if marker.unit > 0.0 { DIAGONAL * marker.unit } else { NO_GRID };
        let reach = profile.notch.box_max_mm / 2.0 + rounding;
        let mut cut: Vec<&Piece> = marker.pieces.iter().collect();
        cut.sort_by_key(|piece| name(piece));
        let lost_of = |(of, read): (Name, &[KeptPlace])| {
            let Ok(place) = cut.binary_search_by_key(&of, |piece| name(piece)) else { return Vec::new() };
            let mut places = Vec::with_capacity(read.len());
            add_places(cut[place], marker, &mut places);
            lost(read, &places, reach)
        };
        let read: Vec<(Name, &[KeptPlace])> = self.each().collect();
        let lost: Vec<Vec<KnifeStroke>> = read.into_par_iter().map(lost_of).collect();
        let mut worst = Worst::new("source/kept", "blocks", Some(0.0));
        for (lost, count) in lost.into_iter().flatten().zip(1..) {
            worst.see(f64::from(count), || Sighting { time: None, line: None, point: lost.to, block: lost.block });
        }
        worst.finding()
    }
}

fn name(piece: &Piece) -> Name {
    (piece.number, piece.span.start)
}
