//! Inspect: warns of contours that are probably not what was meant. Changes nothing.
//!
//! Needs: welded contours. Two rules:
//!
//! - A contour does not close. Where coordinates lie on a grid (a cutter file) contours outline parts, so every gap is
//!   worth a look; plain polylines may well be open, so there only a gap that is small beside the contour is.
//! - A contour stands twice: the same segments, wherever it starts and whichever way it goes. It would be cut twice.

use super::MarkerPass;
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::geom::{Point, bits};
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
/// The smallest gap that these decimals show, mm.
const GAP_SHOWN: f64 = 0.001;

fn run(marker: &mut Marker, _: &Job, diagnostics: &mut Diagnostics) {
    for (piece, contour) in marker.contours().filter(|(_, contour)| !contour.closed) {
        open_contour(marker, piece, contour, diagnostics);
    }
    twice(marker, diagnostics);
}

fn open_contour(marker: &Marker, piece: usize, contour: &Contour, diagnostics: &mut Diagnostics) {
    let first = first(&marker.list, contour.range);
    let end = self::first(&marker.list, contour.range.reversed()).from;
    let gap = (end - first.from).norm();
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

/// A contour by what is the same for all that cut the same segments.
struct Print {
    /// Sum over the segments, so that neither start nor direction matters.
    sum: u64,
    /// The piece's place in the marker.
    piece: usize,
    range: Range,
}

fn twice(marker: &Marker, diagnostics: &mut Diagnostics) {
    let mut prints: Vec<Print> = Vec::new();
    for (piece, contour) in marker.contours() {
        let segments = marker.list.walk(contour.range);
        let sum = segments.fold(0_u64, |sum, (_, segment)| sum.wrapping_add(hash(&segment)));
        prints.push(Print { sum, piece, range: contour.range });
    }
    let mut order: Vec<usize> = (0..prints.len()).collect();
    order.sort_by_key(|&i| prints[i].sum); // stable: equal ones stay in cut order
    let mut repeats: Vec<(usize, usize)> = Vec::new();
    for alike in order.chunk_by(|&a, &b| prints[a].sum == prints[b].sum).filter(|alike| alike.len() > 1) {
        // Equal sums are a hint only; the segments themselves decide.
        let mut exact: Vec<(Vec<Edge>, usize)> =
            alike.iter().map(|&i| (edges(&marker.list, prints[i].range), i)).collect();
        exact.sort();
        for same in exact.chunk_by(|a, b| a.0 == b.0) {
            repeats.extend(same[1..].iter().map(|later| (later.1, same[0].1)));
        }
    }
    repeats.sort_unstable();
    for (later, earlier) in repeats {
        let number = |i: usize| marker.pieces[prints[i].piece].number;
        let before = first(&marker.list, prints[earlier].range).span;
        let message = format!(
            "a contour of piece {} is the same as the one of piece {} in block {}",
            number(later),
            number(earlier),
            before.block
        );
        diagnostics.push(
            Diagnostic::new(&code::MARKER_TWICE, message)
                .at(first(&marker.list, prints[later].range).span)
                .hint("delete one of the two unless the cloth needs two cuts"),
        );
    }
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

/// Symmetric in the two ends. Coordinates on a grid differ in few bits, so their bits are mixed (the finaliser of
/// `splitmix64`, Steele, Lea & Flood 2014) before they are added and again after.
fn hash(segment: &Segment) -> u64 {
    let end = |point: Point| {
        let [x, y] = bits(point);
        mix(x.wrapping_add(mix(y)))
    };
    mix(end(segment.from).wrapping_add(end(segment.to)))
}

fn mix(mut z: u64) -> u64 {
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

fn first(list: &SegmentList, range: Range) -> Segment {
    list.walk(range).next().expect("a range is never empty").1
}
