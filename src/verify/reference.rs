//! What must be cut, as lines: the stretches of contours between corners, and the slits.
//!
//! Corners and the tube are found anew from the marker and the profile; see the module doc of the stage.

use rayon::prelude::*;

use super::caps::{BothWays, End, Feeds};
use super::chord;
use super::line::{Exceptions, Line, Vertex};
use super::nibbles::{self, Blade};
use super::notches;
use super::winding::Winding;
use crate::geom::angle;
use crate::ir::Marker;
use crate::ir::list::Segment;
use crate::ir::marker::{Piece, Stroke};
use crate::machine::{Fit, Follow, MachineProfile, TightCurves};

/// Longest chord that counts as a chord of a curve, mm.
const CURVE_CHORD: f64 = 25.0;

/// Ways along a contour that differ by less are the same, mm: rounding of their sums.
const SAME_WAY: f64 = 1e-6;

/// Smaller turns are none, rad.
const TURN_EPSILON: f64 = 1e-6;

/// All lines of a marker.
#[derive(Debug)]
pub(super) struct Reference<'a> {
    /// The marker that they come from.
    pub(super) marker: &'a Marker,
    /// The lines, in cut order.
    pub(super) lines: Vec<Line>,
    /// Ranks of the holes, in the order of the marker.
    pub(super) holes: Vec<usize>,
    /// Ranks of the events, in the order of the marker.
    pub(super) events: Vec<usize>,
    /// Permitted deviation of the tip, mm.
    pub(super) tolerance: f64,
}

impl<'a> Reference<'a> {
    /// The lines of `marker`.
    pub(super) fn new(marker: &'a Marker, profile: &MachineProfile) -> Self {
        let of_pieces: Vec<OfPiece> = marker
            .pieces
            .par_iter()
            .enumerate()
            .map(|(index, piece)| OfPiece::new(index, (piece, marker), profile))
            .collect();
        let count = of_pieces.iter().map(|piece| piece.lines.len()).sum();
        let (mut lines, mut holes, mut events) = (Vec::with_capacity(count), Vec::new(), Vec::new());
        let mut first = 0;
        for (piece, OfPiece { ranks, lines: mut of_piece }) in marker.pieces.iter().zip(of_pieces) {
            events.extend((first..).take(piece.events.len()));
            holes.extend((first + piece.events.len()..).take(piece.drills.len()));
            for line in &mut of_piece {
                line.rank += first;
            }
            lines.append(&mut of_piece);
            first += ranks;
        }
        events.extend((first..).take(marker.closing.len()));
        Self { marker, lines, holes, events, tolerance: profile.tolerance(marker.unit) }
    }
}

/// What is cut of a piece.
struct OfPiece {
    /// Its lines, their ranks counted from those of the piece.
    lines: Vec<Line>,
    /// How many ranks the piece has.
    ranks: usize,
}

impl OfPiece {
    fn new(index: usize, (piece, marker): (&Piece, &Marker), profile: &MachineProfile) -> Self {
        // Events come first, then holes, then slits, then contours.
        let mut ranks = piece.events.len() + piece.drills.len()..;
        let mut rank = || ranks.next().expect("a marker has fewer lines than numbers");
        let feeds = Feeds::new(profile, piece);
        let mut replaced = Vec::new();
        let outlines: Vec<Vec<Segment>> = piece
            .contours
            .iter()
            .map(|contour| {
                let mut outline = marker.list.walk(contour.range).map(|(_, segment)| segment).collect();
                replaced.extend(notches::straighten(&mut outline, piece, profile.notch));
                outline
            })
            .collect();
        let slits = notches::slits(piece, profile.notch, &replaced);
        let slits = slits.iter().map(|(stroke, percent)| slit(stroke, [index, rank()], feeds.at(*percent)));
        let mut lines: Vec<Line> = slits.collect();
        for (contour, outline) in piece.contours.iter().zip(outlines) {
            let place = Place { owner: [index, rank()], feeds, profile };
            lines.extend(contour_lines(outline, contour.closed, place));
        }
        let blade = Blade { knife: &profile.knife, tolerance: profile.tolerance(marker.unit) };
        for line in &mut lines {
            find_exceptions(line, blade);
        }
        Self { lines, ranks: rank() }
    }
}

/// Finds where a line is too tight for the blade, and where it may be nibbled.
fn find_exceptions(line: &mut Line, blade: Blade) {
    let knife = blade.knife;
    // What begins on a curve that the blade has no way to enter may be nibbled, whatever is done about others.
    let is_lifted = line.winds || knife.longest_cut().is_some_and(|longest| line.length() > longest);
    let ends = if is_lifted || line.ring { [0.0; 2] } else { nibbles::bowed_ends(line, blade) };
    let is_bowed = ends != [0.0; 2] || is_lifted && nibbles::bows_anywhere(line, blade);
    let is_nibbling = knife.tight_curves == TightCurves::Nibble;
    let tight = if is_nibbling || knife.follow == Follow::Chord { chord::tight(line, knife) } else { Vec::new() };
    let may_nibble = is_bowed || is_nibbling && !tight.is_empty();
    let nibbled = if !may_nibble {
        Vec::new()
    } else if is_lifted {
        vec![[f64::NEG_INFINITY, f64::INFINITY]]
    } else {
        nibbles::stretches(line, (&tight, ends), blade)
    };
    line.except(Exceptions { tight, nibbled });
}

/// What the lines of a contour have in common.
#[derive(Clone, Copy)]
struct Place<'a> {
    /// Index of its piece, and its rank.
    owner: [usize; 2],
    feeds: Feeds<'a>,
    profile: &'a MachineProfile,
}

/// The line of a slit, `cap` mm/s being the greatest speed of the tip.
fn slit(stroke: &Stroke, owner: [usize; 2], cap: f64) -> Line {
    let from = Vertex { at: stroke.from, station: 0.0, bulge: 0.0, block: stroke.span.block };
    let to = Vertex { at: stroke.to, station: stroke.length(), ..from };
    Line::new(owner, Box::new([from, to]), BothWays::One(cap), false)
}

/// Cuts a contour at its corners.
fn contour_lines(mut segments: Vec<Segment>, closed: bool, place: Place) -> Vec<Line> {
    let Place { owner, feeds, profile } = place;
    let mut lines = Vec::new();
    let count = segments.len();
    // At the start of each segment.
    let mut turns: Vec<f64> = Vec::with_capacity(count);
    for i in 0..count {
        let before = &segments[(i + count - 1) % count];
        turns.push(angle::turn(before.to - before.from, segments[i].to - segments[i].from));
    }
    let limit = profile.corner.angle();
    let is_corner = |i: usize, segments: &[Segment], turns: &[f64]| segments[i].joint.lift || turns[i].abs() > limit;
    let mut ring = false;
    // Where a contour ends no corner lies before the tip.
    let mut ends = vec![0];
    if closed {
        let corners: Vec<usize> = (0..count).filter(|&i| is_corner(i, &segments, &turns)).collect();
        match corners.first() {
            Some(&first) => {
                ends = nearest_to_start(&segments, &corners).map(|i| i - first).collect();
                segments.rotate_left(first);
                turns.rotate_left(first);
            }
            None => ring = true,
        }
    }
    let mut from = 0;
    for i in 1..=count {
        if i == count || is_corner(i, &segments, &turns) {
            let inner = i - from;
            let turn_at = |k: usize| match (k == 0 || k == inner, ring) {
                (true, false) => 0.0,
                (true, true) => turns[0],
                (false, _) => turns[from + k],
            };
            let chords = &segments[from..i];
            let bulge = |k: usize| bulge(&chords[k], [turn_at(k), turn_at(k + 1)], profile);
            let path = path(chords, bulge);
            let end = |vertex: usize| if ring || ends.contains(&(vertex % count)) { End::Plain } else { End::AtCorner };
            let percents = chords.iter().map(|chord| chord.percent);
            let caps = feeds.both_ways(&path, percents, [end(from), end(i)]);
            let mut line = Line::new(owner, path, caps, ring);
            let turned = (1..inner).map(|k| turn_at(k).abs()).sum();
            line.winds = profile.blade_range().is_some_and(|range| Winding::is_past(&line, turned, (range, profile)));
            lines.push(line);
            from = i;
        }
    }
    lines
}

/// The points of a line of these chords; `bulge` gives the bulge of each.
fn path(chords: &[Segment], bulge: impl Fn(usize) -> f32) -> Box<[Vertex]> {
    let mut path = Vec::with_capacity(chords.len() + 1);
    let mut station = 0.0;
    for (k, chord) in chords.iter().enumerate() {
        path.push(Vertex { at: chord.from, station, bulge: bulge(k), block: chord.span.block });
        station += chord.length();
    }
    let last = &chords[chords.len() - 1];
    path.push(Vertex { at: last.to, station, bulge: 0.0, block: last.span.block });
    path.into()
}

/// The corners of a closed contour at which it may begin, and end: those least far along it from its start in the file.
fn nearest_to_start<'a>(segments: &[Segment], corners: &'a [usize]) -> impl Iterator<Item = usize> + 'a {
    let mut stations = vec![0.0];
    for segment in segments {
        stations.push(stations[stations.len() - 1] + segment.length());
    }
    let length = stations[segments.len()];
    let away = move |i: &usize| stations[*i].min(length - stations[*i]);
    let least = corners.iter().map(&away).fold(f64::INFINITY, f64::min);
    corners.iter().copied().filter(move |i| away(i) <= least + SAME_WAY)
}

/// On a chord between two turns to the same side the curve that was flattened lies outside, by about length * turn / 8.
fn bulge(segment: &Segment, turns: [f64; 2], profile: &MachineProfile) -> f32 {
    let length = segment.length();
    let is_turn = |turn: &f64| turn.abs() > TURN_EPSILON && turn.abs() < profile.corner.angle();
    let curved = turns[0] * turns[1] > 0.0 && turns.iter().all(is_turn);
    if profile.path.fit == Fit::Polygon || !curved || length > CURVE_CHORD {
        return 0.0;
    }
    let mean = f64::midpoint(turns[0], turns[1]);
    let sagitta = (length * mean.abs() / 8.0).min(profile.path.chord_sag_max_mm);
    (-mean.signum() * sagitta / length) as f32
}
