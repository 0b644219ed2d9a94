//! Inspect: warns of contours that are probably not what was meant. Changes nothing but closed contours of a drawing that stand
//! twice in a piece.
//!
//! Needs: welded contours. Rules:
//!
//! - All contours together are smaller than any part.
//! - Open contours of a file with a grid miss each other by a unit or two at their ends: sides of one outline.
//! - A contour does not close. Where coordinates lie on a grid (a cutter file) contours outline parts, so every gap is
//!   worth a look; plain polylines may well be open, so there only a gap that is small beside the contour is, or a contour
//!   that comes by its start and goes on.
//! - A point of a contour stands far off two that lie near each other (`far`): a digit of it may be wrong.
//! - A contour stands twice: the same segments, wherever it starts and whichever way it goes. It would be cut twice.
//! - A closed contour runs beside another one all the way, nearer than edges of different parts that are one edge
//!   (`nest.band_mm`): another vertex or a rounding more, and it would be cut twice as well.
//! - An open contour lies on a closed one all along: a part of that is cut twice.
//!
//! A drawing does not say how often it is cut: what it repeats within a piece is cut once.

use std::collections::BTreeSet;

use rayon::prelude::*;

use super::far;
use super::pass::MarkerPass;
use super::search::search_ended;
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::geom::along::Lines;
use crate::geom::budget::Budget;
use crate::geom::{Extent, Point, bits, polyline, ring};
use crate::ir::list::{Range, Segment, SegmentList};
use crate::ir::marker::{Contour, Marker};
use crate::machine::Job;
use crate::source::Span;
use crate::units::number;

pub(super) const PASS: MarkerPass = MarkerPass {
    name: "inspect",
    about: "warns of contours that do not close or stand twice; drawings cut these once",
    run,
};

/// A gap below this share of the contour's length looks like a contour that was meant to close.
const GAP_SHARE: f64 = 0.05;
/// Greatest gap of a contour that encloses an area, as a share of its length, and the least area that it encloses, as a share of
/// the squared length: that of a rectangle ten times as long as wide, and of one that lacks a side.
const AROUND: [[f64; 2]; 2] = [[0.25, 0.02], [0.45, 0.05]];
/// Gap of a contour, as a share of its length, from which on it is a straight line, which nobody means to close.
const STRAIGHT_SHARE: f64 = 0.999;
/// Gap of a contour outside all parts of a drawing without a grid, as a share of its length, from which on it is a bent line.
const BENT_SHARE: f64 = 0.9;
/// Gap below which the ends of a contour of any length are near, mm.
const NEAR_ENDS: f64 = 5.0;
/// Gap between ends of open lines that were meant to meet, in units of the file: each end is rounded by itself.
const MISSES: f64 = 2.5;
/// Decimals of a gap, mm: the finest grid of any cutter file is 0.0254 mm.
const GAP_DECIMALS: u32 = 3;
/// Greatest number of boxes with which one is compared.
const MOST_COMPARED: usize = 16;
/// Decimals of the distance between contours side by side, mm.
const BESIDE_DECIMALS: u32 = 2;
/// Distance within which a contour lies on another one, mm: what a drawing rounds.
const ON_IT: f64 = 0.1;
/// The smallest gap that these decimals show, mm.
const GAP_SHOWN: f64 = 0.001;

/// Side of the box around all contours, mm, below which no knife can cut them, and below which no garment has a part.
const LEAST_CUT: f64 = 1.0;
const LEAST_PART: f64 = 5.0;

fn run(marker: &mut Marker, job: &Job, diagnostics: &mut Diagnostics) {
    see_size(marker, diagnostics);
    let open: Vec<(usize, &Contour)> = marker.contours().filter(|(_, contour)| !contour.closed).collect();
    let is_side = sides(marker, &open, diagnostics);
    let mut work = Budget::of_a_marker();
    let alone = open.iter().zip(is_side).filter(|(_, is_side)| !is_side).map(|(open, _)| *open);
    let alone: Vec<(usize, &Contour)> = alone.collect();
    for of_piece in alone.chunk_by(|a, b| a.0 == b.0) {
        let closed = Closed::of(marker, of_piece[0].0);
        for (piece, contour) in of_piece {
            open_contour(marker, (*piece, contour), &closed, &mut work, diagnostics);
        }
    }
    far::report(marker, diagnostics);
    let boxed = Boxed::of(marker);
    let mut repeats = twice(marker, &boxed, diagnostics);
    repeats.spared.extend(beside(marker, &boxed, &repeats.all, job.profile.band(marker.unit), diagnostics));
    lying(marker, &boxed, diagnostics);
    // The last first, so that the places of the others stay.
    for &[piece, contour] in repeats.spared.iter().rev() {
        marker.pieces[piece as usize].contours.remove(contour as usize);
    }
}

/// Repeated contours.
struct Repeats {
    all: BTreeSet<ContourPlace>,
    /// Those that a drawing repeats within a piece: they are cut once. Cut files tell the number of cuts.
    spared: BTreeSet<ContourPlace>,
}

/// Reports that a drawing has a contour of a piece twice.
fn say_once(piece: u32, span: Span, diagnostics: &mut Diagnostics) {
    let message = format!("a contour of piece {piece} stands twice: cut once");
    diagnostics.push(Diagnostic::new(&code::MARKER_ROUND_AGAIN, message).at(span));
}

/// Reports contours that together are smaller than a part. Readers of files with a grid check their unit themselves.
fn see_size(marker: &Marker, diagnostics: &mut Diagnostics) {
    let mut extent = Extent::EMPTY;
    for (_, contour) in marker.contours() {
        extent.join(&marker.list.extent(contour.range));
        if !extent.is_empty() && extent.size().0.max(extent.size().1) >= LEAST_PART {
            return; // as nearly all
        }
    }
    let (length, width) = if extent.is_empty() { return } else { extent.size() };
    let size = format!("{} x {} mm", number::fixed(length, 1), number::fixed(width, 1));
    let side = length.max(width);
    if side < LEAST_CUT {
        let message = format!("all that is cut measures {size}: no knife can cut that");
        let finding = Diagnostic::new(&code::MARKER_TINY, message);
        diagnostics.push(finding.hint("the unit is wrong, or the file is damaged: compare it with the CAD system"));
    } else if side < LEAST_PART && marker.unit <= 0.0 {
        let message = format!("all that is cut measures {size}: smaller than any part");
        let finding = Diagnostic::new(&code::MARKER_SMALL, message);
        diagnostics.push(finding.hint("see whether the file is in the unit that it is read in"));
    }
}

/// Marks the open contours both ends of which are beside an end of another one and not at it; warns of them once. In a file
/// without a grid that is a different one at each end: lines side by side are no sides of an outline.
fn sides(marker: &Marker, open: &[(usize, &Contour)], diagnostics: &mut Diagnostics) -> Vec<bool> {
    let has_grid = marker.unit > 0.0;
    let reach = if has_grid { MISSES * marker.unit } else { NEAR_ENDS };
    let ends =
        open.iter().enumerate().flat_map(|(k, (_, contour))| marker.list.ends_of(contour.range).map(|at| (k, at)));
    let mut ends: Vec<(usize, Point)> = ends.collect();
    ends.sort_by(|a, b| a.1.x.total_cmp(&b.1.x));
    let mut misses = vec![Vec::new(); open.len()];
    for &(k, at) in &ends {
        let first = ends.partition_point(|(_, other)| other.x < at.x - reach);
        let beside = ends[first..].iter().take_while(|(_, other)| other.x <= at.x + reach).take(MOST_COMPARED);
        let gaps = beside.filter(|(other, _)| *other != k).map(|(other, at_other)| ((at_other - at).norm(), *other));
        misses[k].extend(gaps.filter(|(gap, _)| *gap <= reach).min_by(|a, b| a.0.total_cmp(&b.0)));
    }
    let most = |misses: &[(f64, usize)]| misses.iter().map(|miss| miss.0).fold(0.0, f64::max);
    let is_side = |misses: &Vec<(f64, usize)>| {
        matches!(misses[..], [from, to] if has_grid || from.1 != to.1) && most(misses) > 0.0
    };
    let is_side: Vec<bool> = misses.iter().map(is_side).collect();
    let sides = || is_side.iter().zip(open).filter(|(is_side, _)| **is_side).map(|(_, side)| side);
    if let Some((_, contour)) = sides().next() {
        let by = misses.iter().zip(&is_side).filter(|(_, is_side)| **is_side).map(|(misses, _)| most(misses));
        let by = number::fixed(by.fold(0.0, f64::max), GAP_DECIMALS);
        let message = format!("ends of {} open lines miss each other by up to {by} mm", sides().count());
        let mut pieces: Vec<u32> = sides().map(|&(piece, _)| marker.pieces[piece].number).collect();
        pieces.dedup();
        let finding = Diagnostic::new(&code::MARKER_SIDES, message).at(first(&marker.list, contour.range).span);
        let finding = finding.about(pieces);
        diagnostics.push(finding.hint("sides of one outline? Let the CAD end each where the next one starts"));
    }
    is_side
}

/// Closed contours of a piece: the box around each, and one of its points.
struct Closed(Vec<(Extent, Point)>);

impl Closed {
    fn of(marker: &Marker, piece: usize) -> Self {
        let closed = marker.pieces[piece].contours.iter().filter(|contour| contour.closed);
        let boxed = |contour: &Contour| (marker.list.extent(contour.range), marker.list.points(contour.range)[0]);
        Self(closed.map(boxed).collect())
    }

    /// True if one of them lies inside a line that nearly closes; `false` once the budget is spent.
    fn any_in(&self, line: &[Point], work: &mut Budget) -> bool {
        if !work.spend(self.0.len()) {
            return false;
        }
        let around = Extent::of(line);
        let mut is_in_it = |(Extent { min, max }, at): &(Extent, Point)| {
            around.holds(*min) && around.holds(*max) && work.spend(line.len()) && ring::contains(line, *at)
        };
        self.0.iter().any(&mut is_in_it)
    }
}

/// Reports a contour that should close. `closed` are the contours of its piece that do.
fn open_contour(
    marker: &Marker,
    (piece, contour): (usize, &Contour),
    closed: &Closed,
    work: &mut Budget,
    diagnostics: &mut Diagnostics,
) {
    let first = first(&marker.list, contour.range);
    let [start, end] = marker.list.ends_of(contour.range);
    let gap = (end - start).norm();
    let length = || marker.list.walk(contour.range).map(|(_, segment)| segment.length()).sum::<f64>();
    let number = marker.pieces[piece].number;
    let points = marker.list.points(contour.range);
    if gap > NEAR_ENDS
        && let Some(Passing { off, past }) = comes_by(&points)
    {
        let [off, past] = [off, past].map(|mm| number::fixed(mm, BESIDE_DECIMALS));
        let message = format!("a contour of piece {number} passes its start at {off} mm and goes on for {past} mm");
        let finding = Diagnostic::new(&code::MARKER_OPEN, message).at(first.span).about(vec![number]);
        diagnostics.push(finding.hint("end it at its first point if it should close; all of it is cut as it stands"));
    } else if marker.unit > 0.0 && gap < STRAIGHT_SHARE * length()
        || marker.drawing.is_some() && gap > NEAR_ENDS && closed.0.is_empty() && gap < BENT_SHARE * length()
        || gap < GAP_SHARE * length()
        || AROUND.iter().any(|[share, area]| gap < share * length() && goes_around(&points, area * length().powi(2)))
    {
        let size = if gap < GAP_SHOWN { "less than 0.001".to_owned() } else { number::fixed(gap, GAP_DECIMALS) };
        let inner =
            if closed.any_in(&points, work) { "; a closed contour inside it is cut as a part of its own" } else { "" };
        let message = format!("a contour of piece {number} ends {size} mm from where it starts{inner}");
        let finding = Diagnostic::new(&code::MARKER_OPEN, message).at(first.span).about(vec![number]);
        diagnostics.push(finding.hint(if gap <= NEAR_ENDS || gap < GAP_SHARE * length() {
            "repeat the first point at its end if it should close"
        } else {
            "it is cut as an open line; sides of one outline must end where the next one starts"
        }));
    }
}

/// True if an open line encloses at least an area, mm2, and does not merely lead to and fro.
fn goes_around(points: &[Point], area: f64) -> bool {
    ring::area(points).abs() >= area
}

/// A line that returns to its start and goes on.
struct Passing {
    /// Distance from its start, mm.
    off: f64,
    /// Length after that, mm.
    past: f64,
}

/// Nearest return of a line to its start after it has left it, and the length after that.
fn comes_by(points: &[Point]) -> Option<Passing> {
    let first = points[0];
    let away = points.iter().position(|at| (at - first).norm() > NEAR_ENDS)?;
    let off = |k: usize| polyline::distance_to_segment(first, points[k], points[k + 1]);
    // The segment that leads away comes from the start itself.
    let (off, k) = (away..points.len() - 1).map(|k| (off(k), k)).min_by(|a, b| a.0.total_cmp(&b.0))?;
    let [a, b] = [points[k], points[k + 1]];
    let at = a + (b - a) * polyline::foot(first, a, b);
    let past = (b - at).norm() + polyline::length(&points[k + 1..]);
    (off <= NEAR_ENDS && past > NEAR_ENDS).then_some(Passing { off, past })
}

/// A contour: index of its piece among all, and its own index in the piece.
type ContourPlace = [u32; 2];

/// A number made of the lower left corner of a contour's box, equal for all contours of the same segments, in any direction and
/// from any start; and the contour.
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
        let extent = |place: &ContourPlace| marker.list.extent(range(*place));
        let extents = places.par_iter().map(extent).collect();
        Self { places, extents }
    }
}

/// Reports and returns contours that are repeated.
fn twice(marker: &Marker, boxed: &Boxed, diagnostics: &mut Diagnostics) -> Repeats {
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
    let is_spared = |&(later, earlier): &(ContourPlace, ContourPlace)| {
        marker.drawing.is_some() && later[0] == earlier[0] && piece(later).contours[later[1] as usize].closed
    };
    for &(later, earlier) in &repeats {
        let number = |contour: ContourPlace| piece(contour).number;
        let span = first(&marker.list, range(later)).span;
        if is_spared(&(later, earlier)) {
            say_once(number(later), span, diagnostics);
            continue;
        }
        let before = first(&marker.list, range(earlier)).span;
        let message = format!(
            "a contour of piece {} is the same as the one of piece {} in block {}",
            number(later),
            number(earlier),
            before.block
        );
        diagnostics.push(
            Diagnostic::new(&code::MARKER_TWICE, message)
                .at(span)
                .hint("delete one of the two unless the cloth needs two cuts"),
        );
    }
    let spared = repeats.iter().filter(|pair| is_spared(pair)).map(|(later, _)| *later).collect();
    Repeats { all: repeats.into_iter().map(|(later, _)| later).collect(), spared }
}

/// Reports closed contours that run beside another one within `reach` mm, except those already reported, and returns those that
/// are spared.
fn beside(
    marker: &Marker,
    boxed: &Boxed,
    repeats: &BTreeSet<ContourPlace>,
    reach: f64,
    diagnostics: &mut Diagnostics,
) -> Vec<ContourPlace> {
    let mut spared = Vec::new();
    let contour = |[piece, k]: ContourPlace| &marker.pieces[piece as usize].contours[k as usize];
    let is_looked_at = |k: &usize| contour(boxed.places[*k]).closed && !repeats.contains(&boxed.places[*k]);
    let closed: Vec<usize> = (0..boxed.places.len()).filter(is_looked_at).collect();
    if !may_be_beside(closed.iter().map(|&k| boxed.extents[k]).collect(), reach) {
        return spared; // as in nearly all markers
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
        let places = [earlier, later].map(|k| boxed.places[closed[k]]);
        let lies_on = || {
            let [one, other] = [range(later), range(earlier)].map(|range| marker.list.points(range).into_owned());
            one.iter().all(|&at| polyline::distance(at, &other) <= ON_IT)
        };
        if marker.drawing.is_some() && places[0][0] == places[1][0] && lies_on() {
            say_once(number(later), span(later), diagnostics);
            spared.push(places[1]);
            continue;
        }
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
    spared
}

/// Reports open contours that lie on a closed one all along.
fn lying(marker: &Marker, boxed: &Boxed, diagnostics: &mut Diagnostics) {
    let contour = |k: usize| {
        let [piece, contour] = boxed.places[k];
        &marker.pieces[piece as usize].contours[contour as usize]
    };
    let open: Vec<usize> = (0..boxed.places.len()).filter(|&k| !contour(k).closed).collect();
    let all = Lines {
        extents: boxed.extents.clone(),
        points: |k: usize| marker.list.points(contour(k).range).into_owned(),
        may_be: |_, other: usize| contour(other).closed,
    };
    let mut work = Budget::of_a_marker();
    for [line, on] in all.lying_on(&open, ON_IT, &mut work) {
        let [number, other] = [line, on].map(|k| marker.pieces[boxed.places[k][0] as usize].number);
        let [span, before] = [line, on].map(|k| first(&marker.list, contour(k).range).span);
        let block = before.block;
        let message = format!("an open line of piece {number} lies on a contour of piece {other} in block {block}");
        let finding = Diagnostic::new(&code::MARKER_TWICE, message).at(span).about(vec![number]);
        diagnostics.push(finding.hint("delete it unless the cloth needs two cuts there"));
    }
    if work.is_spent() {
        diagnostics.push(search_ended("some lines may lie on contours and be cut twice"));
    }
}

/// Quick test for boxes that nearly agree; also true if many begin side by side, so that a search must decide.
fn may_be_beside(mut boxes: Vec<Extent>, reach: f64) -> bool {
    boxes.sort_unstable_by(|a, b| a.min.x.total_cmp(&b.min.x));
    let off = |a: &Extent, b: &Extent| (b.min - a.min).amax().max((b.max - a.max).amax());
    (0..boxes.len()).any(|k| {
        let near = boxes[k + 1..].iter().take_while(|other| other.min.x - boxes[k].min.x <= reach);
        near.enumerate().any(|(count, other)| count == MOST_COMPARED || off(&boxes[k], other) <= reach)
    })
}

/// A segment as its two ends in a canonical order, independent of its direction.
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
