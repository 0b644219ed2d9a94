//! Inspect: warns of contours that are probably not what was meant. Changes nothing.
//!
//! Needs: welded contours. Two rules:
//!
//! - A contour does not close. Where coordinates lie on a grid (a cutter file) contours outline parts, so every gap is
//!   worth a look; plain polylines may well be open, so there only a gap that is small beside the contour is.
//! - A contour stands twice: the same segments, wherever it starts and whichever way it goes. It would be cut twice.
//! - A closed contour runs beside another one all the way, nearer than edges of different parts that are one edge
//!   (`nest.band_mm`): another vertex or a rounding more, and it would be cut twice as well.

use rayon::prelude::*;

use super::pass::MarkerPass;
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
/// Decimals of how far a contour runs beside another one, mm.
const BESIDE_DECIMALS: u32 = 2;
/// The smallest gap that these decimals show, mm.
const GAP_SHOWN: f64 = 0.001;

fn run(marker: &mut Marker, job: &Job, diagnostics: &mut Diagnostics) {
    for (piece, contour) in marker.contours().filter(|(_, contour)| !contour.closed) {
        open_contour(marker, piece, contour, diagnostics);
    }
    twice(marker, diagnostics);
    beside(marker, job.profile.band(marker.unit), diagnostics);
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

fn twice(marker: &Marker, diagnostics: &mut Diagnostics) {
    let piece = |[piece, _]: ContourPlace| &marker.pieces[piece as usize];
    let range = |contour: ContourPlace| piece(contour).contours[contour[1] as usize].range;
    let print = |contour: ContourPlace| {
        let [x, y] = bits(Extent::of(&marker.list.points(range(contour))).min);
        x ^ y.rotate_left(u64::BITS / 2)
    };
    // Counted first: what a vector grows by is new memory each time, and that is slow.
    let mut prints: Vec<Print> = Vec::with_capacity(marker.contours().count());
    for (piece, i) in marker.pieces.iter().zip(0..) {
        prints.extend((0..piece.contours.len() as u32).map(|k| (0, [i, k])));
    }
    prints.par_iter_mut().for_each(|(number, contour)| *number = print(*contour));
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
    for (later, earlier) in repeats {
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
}

/// Tells closed contours that run beside another one within a reach, mm, and are not the same segments.
fn beside(marker: &Marker, reach: f64, diagnostics: &mut Diagnostics) {
    let closed: Vec<(usize, &Contour)> = marker.contours().filter(|(_, contour)| contour.closed).collect();
    let points = |k: usize| marker.list.points(closed[k].1.range);
    let all = Lines {
        extents: (0..closed.len()).into_par_iter().map(|k| Extent::of(&points(k))).collect(),
        points: |k| points(k).into_owned(),
        may_be: |one: usize, other: usize| !is_same(marker, [closed[one].1, closed[other].1]),
    };
    for [earlier, later] in all.twins(reach, &mut Budget::of_a_marker()) {
        let number = |k: usize| marker.pieces[closed[k].0].number;
        let span = |k: usize| first(&marker.list, closed[k].1.range).span;
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
}

/// Whether two contours are the same segments.
fn is_same(marker: &Marker, contours: [&Contour; 2]) -> bool {
    let [one, other] = contours.map(|contour| edges(&marker.list, contour.range));
    one == other
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
