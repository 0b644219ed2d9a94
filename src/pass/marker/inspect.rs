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
//! - A point of a contour stands far off between two that lie near each other, or off a corner several times as far as the rest
//!   is long: a digit of it may be wrong.
//! - A contour stands twice: the same segments, wherever it starts and whichever way it goes. It would be cut twice.
//! - A closed contour runs beside another one all the way, nearer than edges of different parts that are one edge
//!   (`nest.band_mm`): another vertex or a rounding more, and it would be cut twice as well.
//!
//! A drawing does not say how often it is cut: what it repeats within a piece is cut once.

use std::collections::BTreeSet;

use rayon::prelude::*;

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
/// Least distance of a far point from both of its neighbours, mm: a part of a garment has no spike so long.
const FAR: f64 = 300.0;
/// Greatest distance between these neighbours, as a share of that.
const FAR_SHARE: f64 = 0.1;
/// Least distance of a corner from both of its neighbours, mm, from which on it may be as far from them as the rest of its contour
/// is long; greatest distance between these neighbours, as a share of that; and least area of the rest, as a share of the square
/// of its longer side: a long triangle has less.
const FAR_CORNER: f64 = 1000.0;
const CORNER_SHARE: f64 = 0.3;
const CORNER_REST: f64 = 0.1;
/// Least area of a contour without its far point, as a multiple of that of the spike.
const REST: f64 = 4.0;
/// Length of a spike, as a multiple of the extent of the rest of its contour, from which on that is compared with the square of
/// its foot alone.
const LONGER: f64 = 3.0;
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
    for (&(piece, contour), _) in open.iter().zip(is_side).filter(|(_, is_side)| !is_side) {
        open_contour(marker, piece, contour, diagnostics);
    }
    far_points(marker, diagnostics);
    let boxed = Boxed::of(marker);
    let mut repeats = twice(marker, &boxed, diagnostics);
    repeats.spared.extend(beside(marker, &boxed, &repeats.all, job.profile.band(marker.unit), diagnostics));
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

/// Reports the number of contours that have a point far off their other ones, and the farthest.
fn far_points(marker: &Marker, diagnostics: &mut Diagnostics) {
    let is_far = |[before, at, after]: [Point; 3]| {
        let [back, on] = [before - at, after - at];
        let least = back.norm_squared().min(on.norm_squared());
        let share = if least >= FAR_CORNER * FAR_CORNER { CORNER_SHARE } else { FAR_SHARE };
        least >= FAR * FAR && (on - back).norm_squared() <= share * share * least
    };
    let (mut count, mut worst): (usize, Option<(f64, usize, Range, usize)>) = (0, None);
    for (piece, contour) in marker.contours() {
        let points = marker.list.points(contour.range);
        let last = points.len() - 1;
        let start = contour.closed.then_some([last - 1, last, 1]);
        // A line turns back at a far point, so that a monotone chain begins there.
        let chains = marker.list.chains(contour.range);
        let begins = chains.each().map(|(chain, _)| chain.first as usize).filter(|k| (1..last).contains(k));
        let far = begins.map(|k| [k - 1, k, k + 1]).chain(start).filter(|&three| is_far(three.map(|k| points[k])));
        let off = |[before, at, _]: [usize; 3]| (points[at] - points[before]).norm();
        let farthest = far.max_by(|&a, &b| off(a).total_cmp(&off(b)));
        let is_wrong = |three: &[usize; 3]| {
            let places = three.map(|k| points[k]);
            let far = Far::of(&points, *three);
            let has_near = (places[2] - places[0]).norm() <= FAR_SHARE * off(*three);
            far.is_corner() || has_near && (far.stands_out(marker.unit) || has_wrong_digit(places, marker.unit))
        };
        let Some(three) = farthest.filter(is_wrong) else { continue };
        count += 1;
        if worst.is_none_or(|(most, ..)| off(three) > most) {
            worst = Some((off(three), piece, contour.range, three[0]));
        }
    }
    let Some((off, piece, range, segment)) = worst else { return };
    let (off, number) = (number::fixed(off, 0), marker.pieces[piece].number);
    let message = match count {
        1 => format!("a point of piece {number} stands {off} mm off its neighbours"),
        count => format!("{count} contours have a point far off its neighbours, piece {number} {off} mm"),
    };
    let span = marker.list.spans(range)[segment];
    let finding = Diagnostic::new(&code::MARKER_FAR_POINT, message).at(span).about(vec![number]);
    diagnostics.push(finding.hint("a digit may be doubled or lost: look at the picture (`-t svg`), export it again"));
}

/// A point far from its neighbours, and the rest of its contour.
struct Far {
    /// The neighbour before the point, the point, and the one behind it.
    spike: [Point; 3],
    rest: Vec<Point>,
    /// Area of the rest, mm2, and its longer side, mm.
    area: f64,
    side: f64,
}

impl Far {
    fn of(points: &[Point], [before, at, after]: [usize; 3]) -> Self {
        let rest: Vec<Point> = points.iter().copied().filter(|point| *point != points[at]).collect();
        let (width, height) = Extent::of(&rest).size();
        let spike = [before, at, after].map(|k| points[k]);
        Self { spike, area: ring::area(&rest).abs(), side: width.max(height), rest }
    }

    /// True if the point is several times as far off as the rest of the contour is long.
    fn is_longer(&self) -> bool {
        let [before, at, after] = self.spike;
        (at - before).norm().min((at - after).norm()) >= LONGER * self.side
    }

    /// True if a point and its neighbours are a spike out of the rest of the contour: the tip of a strip or of a godet is most
    /// of its part, unless it is several times as long as all the rest. On a grid of `unit` mm (0 = none) a dart or a slash
    /// leads into its part, and a wrong digit is told by its number.
    fn stands_out(&self, unit: f64) -> bool {
        let [before, at, after] = self.spike;
        let base = if self.is_longer() { (after - before).norm_squared() } else { ring::area(&self.spike).abs() };
        self.area >= REST * base && (unit <= 0.0 || !ring::contains(&self.rest, at))
    }

    /// True if the point is a corner of an outline that is moved far away.
    fn is_corner(&self) -> bool {
        let [before, at, after] = self.spike;
        let least = (at - before).norm().min((at - after).norm());
        least >= FAR_CORNER && self.is_longer() && self.area >= CORNER_REST * self.side * self.side
    }
}

/// True if a point would lie between its neighbours with one digit more or less in one coordinate, on a grid of `unit` mm (0 =
/// none). The tip of a dart or a slash has no such number, unless by chance.
fn has_wrong_digit([before, at, after]: [Point; 3], unit: f64) -> bool {
    if unit <= 0.0 {
        return false;
    }
    let is_wrong = |axis: usize| {
        let [one, other] = [before[axis], after[axis]];
        let is_between = |value: f64| value >= one.min(other) - unit / 2.0 && value <= one.max(other) + unit / 2.0;
        let number = format!("{:.0}", (at[axis] / unit).abs());
        let told = |digits: String| digits.parse::<f64>().is_ok_and(|n| is_between((n * unit).copysign(at[axis])));
        let more = (0..=number.len()).flat_map(|k| (0..10).map(move |digit| (k, digit)));
        let mut more = more.map(|(k, digit)| format!("{}{digit}{}", &number[..k], &number[k..]));
        let mut less = (0..number.len()).map(|k| format!("{}{}", &number[..k], &number[k + 1..]));
        more.any(told) || less.any(told)
    };
    let is_kept = |axis: usize| {
        let [one, other] = [before[axis], after[axis]];
        at[axis] >= one.min(other) && at[axis] <= one.max(other)
    };
    is_kept(0) && is_wrong(1) || is_kept(1) && is_wrong(0)
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

fn open_contour(marker: &Marker, piece: usize, contour: &Contour, diagnostics: &mut Diagnostics) {
    let first = first(&marker.list, contour.range);
    let [start, end] = marker.list.ends_of(contour.range);
    let gap = (end - start).norm();
    let length = || marker.list.walk(contour.range).map(|(_, segment)| segment.length()).sum::<f64>();
    let number = marker.pieces[piece].number;
    let points = marker.list.points(contour.range);
    // Slashes and darts of a part are open on purpose.
    let is_alone = || marker.pieces[piece].contours.iter().all(|contour| !contour.closed);
    if gap > NEAR_ENDS
        && let Some(Passing { off, past }) = comes_by(&points)
    {
        let [off, past] = [off, past].map(|mm| number::fixed(mm, BESIDE_DECIMALS));
        let message = format!("a contour of piece {number} passes its start at {off} mm and goes on for {past} mm");
        let finding = Diagnostic::new(&code::MARKER_OPEN, message).at(first.span).about(vec![number]);
        diagnostics.push(finding.hint("end it at its first point if it should close; all of it is cut as it stands"));
    } else if marker.unit > 0.0 && gap < STRAIGHT_SHARE * length()
        || marker.drawing.is_some() && gap > NEAR_ENDS && is_alone() && gap < BENT_SHARE * length()
        || gap < GAP_SHARE * length()
        || AROUND.iter().any(|[share, area]| gap < share * length() && goes_around(&points, area * length().powi(2)))
    {
        let size = if gap < GAP_SHOWN { "less than 0.001".to_owned() } else { number::fixed(gap, GAP_DECIMALS) };
        let extent = marker.list.extent(contour.range);
        let is_in_it = |inner: &Contour| {
            let Extent { min, max } = marker.list.extent(inner.range);
            inner.closed && extent.holds(min) && extent.holds(max)
        };
        let inner =
            if marker.pieces[piece].contours.iter().any(is_in_it) { "; one in it is cut as a part" } else { "" };
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
