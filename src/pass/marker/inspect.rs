//! Inspect: warns of contours that are probably not what was meant. Changes nothing.
//!
//! Needs: welded contours. Two rules:
//!
//! - A contour does not close. Where coordinates lie on a grid (a cutter file) contours outline parts, so every gap is
//!   worth a look; plain polylines may well be open, so there only a gap that is small beside the contour is.
//! - A contour stands twice: the same segments, wherever it starts and whichever way it goes. It would be cut twice.
//! - A closed contour runs beside another one all the way, nearer than edges of different parts that are one edge
//!   (`nest.band_mm`): another vertex or a rounding more, and it would be cut twice as well.

use std::collections::BTreeSet;

use rayon::prelude::*;

use super::pass::MarkerPass;
use super::search::search_ended;
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::geom::along::Lines;
use crate::geom::budget::Budget;
use crate::geom::{Extent, bits};
use crate::ir::list::{Range, Segment, SegmentList};
use crate::ir::marker::{Contour, Marker};
use crate::machine::Job;
use crate::units::number;

pub(super) const PASS: MarkerPass =
    MarkerPass { name: "inspect", about: "warns of contours that do not close or stand twice", run };

/// A gap below this share of the contour's length looks like a contour that was meant to close.
const GAP_SHARE: f64 = 0.05;
/// Decimals of a gap, mm: the finest grid of any cutter file is 0.0254 mm.
const GAP_DECIMALS: u32 = 3;
/// Boxes that begin beside one and are compared with it.
const MOST_COMPARED: usize = 16;
/// Decimals of how far a contour runs beside another one, mm.
const BESIDE_DECIMALS: u32 = 2;
/// The smallest gap that these decimals show, mm.
const GAP_SHOWN: f64 = 0.001;

fn run(marker: &mut Marker, job: &Job, diagnostics: &mut Diagnostics) {
    for (piece, contour) in marker.contours().filter(|(_, contour)| !contour.closed) {
        open_contour(marker, piece, contour, diagnostics);
    }
    let boxed = Boxed::of(marker);
    let repeats = twice(marker, &boxed, diagnostics);
    beside(marker, &boxed, &repeats, job.profile.band(marker.unit), diagnostics);
}

fn open_contour(marker: &Marker, piece: usize, contour: &Contour, diagnostics: &mut Diagnostics) {
    let first = first(&marker.list, contour.range);
    let [start, end] = marker.list.ends_of(contour.range);
    let gap = (end - start).norm();
    let length = || marker.list.walk(contour.range).map(|(_, segment)| segment.length()).sum::<f64>();
    if marker.unit > 0.0 || gap < GAP_SHARE * length() {
        let size = if gap < GAP_SHOWN { "less than 0.001".to_owned() } else { number::fixed(gap, GAP_DECIMALS) };
        let number = marker.pieces[piece].number;
        let message = format!("a contour of piece {number} ends {size} mm from where it starts");
        diagnostics.push(
            Diagnostic::new(&code::MARKER_OPEN, message)
                .at(first.span)
                .hint("repeat the first point at its end if it should close"),
        );
    }
}

/// A contour: the place of its piece among all, and its own in that.
type ContourPlace = [u32; 2];

/// A number made of the lower left corner of a contour's box, the same for all that cut the same segments, wherever they
/// start and whichever way they go; and the contour.
type Print = (u64, ContourPlace);

/// Contours of a marker with the boxes around them, in the order of the marker.
struct Boxed {
    places: Vec<ContourPlace>,
    extents: Vec<Extent>,
}

impl Boxed {
    fn of(marker: &Marker) -> Self {
        // Counted first: what a vector grows by is new memory each time, and that is slow.
        let mut places = Vec::with_capacity(marker.contours().count());
        for (piece, i) in marker.pieces.iter().zip(0..) {
            places.extend((0..piece.contours.len() as u32).map(|k| [i, k]));
        }
        let range = |[piece, k]: ContourPlace| marker.pieces[piece as usize].contours[k as usize].range;
        let extent = |place: &ContourPlace| Extent::of(&marker.list.points(range(*place)));
        let extents = places.par_iter().map(extent).collect();
        Self { places, extents }
    }
}

/// Tells contours that stand again: which they are.
fn twice(marker: &Marker, boxed: &Boxed, diagnostics: &mut Diagnostics) -> BTreeSet<ContourPlace> {
    let piece = |[piece, _]: ContourPlace| &marker.pieces[piece as usize];
    let range = |contour: ContourPlace| piece(contour).contours[contour[1] as usize].range;
    let print = |extent: &Extent| {
        let [x, y] = bits(extent.min);
        x ^ y.rotate_left(u64::BITS / 2)
    };
    let mut prints: Vec<Print> = boxed.extents.iter().map(print).zip(boxed.places.iter().copied()).collect();
    prints.sort_unstable();
    let mut repeats: Vec<(ContourPlace, ContourPlace)> = Vec::new();
    for alike in prints.chunk_by(|a, b| a.0 == b.0).filter(|alike| alike.len() > 1) {
        // Equal numbers are a hint only; the segments themselves decide.
        let mut exact: Vec<(Vec<Edge>, ContourPlace)> =
            alike.iter().map(|&(_, i)| (edges(&marker.list, range(i)), i)).collect();
        exact.sort();
        for same in exact.chunk_by(|a, b| a.0 == b.0) {
            repeats.extend(same[1..].iter().map(|later| (later.1, same[0].1)));
        }
    }
    repeats.sort_unstable();
    for &(later, earlier) in &repeats {
        let number = |contour: ContourPlace| piece(contour).number;
        let before = first(&marker.list, range(earlier)).span;
        let message = format!(
            "a contour of piece {} is the same as the one of piece {} in block {}",
            number(later),
            number(earlier),
            before.block
        );
        diagnostics.push(
            Diagnostic::new(&code::MARKER_TWICE, message)
                .at(first(&marker.list, range(later)).span)
                .hint("delete one of the two unless the cloth needs two cuts"),
        );
    }
    repeats.into_iter().map(|(later, _)| later).collect()
}

/// Tells closed contours that run beside another one within a reach, mm; those that stand again are told already.
fn beside(marker: &Marker, boxed: &Boxed, repeats: &BTreeSet<ContourPlace>, reach: f64, diagnostics: &mut Diagnostics) {
    let contour = |[piece, k]: ContourPlace| &marker.pieces[piece as usize].contours[k as usize];
    let is_looked_at = |k: &usize| contour(boxed.places[*k]).closed && !repeats.contains(&boxed.places[*k]);
    let closed: Vec<usize> = (0..boxed.places.len()).filter(is_looked_at).collect();
    if !may_be_beside(closed.iter().map(|&k| boxed.extents[k]).collect(), reach) {
        return; // as in nearly all markers
    }
    let range = |k: usize| contour(boxed.places[closed[k]]).range;
    let all = Lines {
        extents: closed.iter().map(|&k| boxed.extents[k]).collect(),
        points: |k| marker.list.points(range(k)).into_owned(),
        may_be: |_, _| true,
    };
    let mut work = Budget::of_a_marker();
    for [earlier, later] in all.twins(reach, &mut work) {
        let span = |k: usize| first(&marker.list, range(k)).span;
        let number = |k: usize| marker.pieces[boxed.places[closed[k]][0] as usize].number;
        let message = format!(
            "a contour of piece {} runs beside the one of piece {} in block {}, nowhere farther than {} mm from it",
            number(later),
            number(earlier),
            span(earlier).block,
            number::fixed(reach, BESIDE_DECIMALS)
        );
        let finding = Diagnostic::new(&code::MARKER_TWICE, message).at(span(later));
        diagnostics.push(finding.hint("delete one of the two unless the cloth needs two cuts"));
    }
    if work.is_spent() {
        diagnostics.push(search_ended("some contours may run beside others and be cut twice"));
    }
}

/// Quick test for boxes that nearly agree; true also where many begin beside each other, so that a search must tell.
fn may_be_beside(mut boxes: Vec<Extent>, reach: f64) -> bool {
    boxes.sort_unstable_by(|a, b| a.min.x.total_cmp(&b.min.x));
    let off = |a: &Extent, b: &Extent| (b.min - a.min).amax().max((b.max - a.max).amax());
    (0..boxes.len()).any(|k| {
        let near = boxes[k + 1..].iter().take_while(|other| other.min.x - boxes[k].min.x <= reach);
        near.enumerate().any(|(count, other)| count == MOST_COMPARED || off(&boxes[k], other) <= reach)
    })
}

/// A segment as its two ends, the lesser first: the same whichever way it is cut.
type Edge = [[u64; 2]; 2];

fn edges(list: &SegmentList, range: Range) -> Vec<Edge> {
    let mut edges: Vec<Edge> = list.walk(range).map(|(_, segment)| edge(&segment)).collect();
    edges.sort_unstable();
    edges
}

fn edge(segment: &Segment) -> Edge {
    let mut edge = [bits(segment.from), bits(segment.to)];
    edge.sort_unstable();
    edge
}

fn first(list: &SegmentList, range: Range) -> Segment {
    list.walk(range).next().expect("a range is never empty").1
}
