//! Sides: joins strokes of an outline that run in different directions, or whose ends were rounded apart.
//!
//! A CAD system that writes each side of an outline separately may write it either way, and may round a corner twice: the next
//! side then starts a unit of the file beside the end of the previous one. An outline in one stroke may end a unit beside its
//! start. Both ends stand for one place within half a diagonal of a cell of the grid, and so does the middle between them.

use crate::geom::{Point, ring};
use crate::ir::list::{Range, Segment, SegmentList};
use crate::ir::marker::{Contour, Piece};

/// Greatest distance of two ends rounded from one place, in units of the file: a unit along X and along Y.
const APART: f64 = std::f64::consts::SQRT_2 + 1e-6;

/// Joins open contours of a piece that make a ring, in either direction, each ending beside an end of the next. A place with
/// more than two ends stays as it is. `seam` merges the joints where two become one.
pub(super) fn join(list: &mut SegmentList, piece: &mut Piece, unit: f64, seam: fn(&mut SegmentList, Range, Range)) {
    let reach = APART * unit;
    let open: Vec<usize> = (0..piece.contours.len()).filter(|&k| !piece.contours[k].closed).collect();
    let ends: Vec<Point> = open.iter().flat_map(|&k| list.ends_of(piece.contours[k].range)).collect();
    let mut is_taken = vec![false; piece.contours.len()];
    for cycle in cycles(&partners(&ends, reach)) {
        let range = |&(k, is_back): &(usize, bool)| {
            let range = piece.contours[open[k]].range;
            if is_back { range.reversed() } else { range }
        };
        let ranges: Vec<Range> = cycle.iter().map(range).collect();
        let places = || ranges.iter().flat_map(|range| list.points(*range).to_vec());
        let (places, length): (Vec<Point>, f64) =
            (places().collect(), ranges.iter().flat_map(|range| list.walk(*range)).map(|(_, s)| s.length()).sum());
        // A stroke there and back encloses nothing.
        if ring::area(&places).abs() <= reach * length {
            continue;
        }
        let ranges = ranges.into_iter().zip(&cycle).map(|(range, (_, is_back))| match is_back {
            true => forwards(list, range),
            false => range,
        });
        let ranges: Vec<Range> = ranges.collect();
        piece.contours[open[cycle[0].0]] = Contour { range: joined(list, ranges, seam), closed: true };
        cycle[1..].iter().for_each(|&(k, _)| is_taken[open[k]] = true);
    }
    let mut taken = is_taken.into_iter();
    piece.contours.retain(|_| !taken.next().unwrap_or_default());
}

/// A copy of a range that is walked backwards, in list order.
fn forwards(list: &mut SegmentList, range: Range) -> Range {
    let segments: Vec<Segment> = list.walk(range).map(|(_, segment)| segment).collect();
    list.append(segments).expect("a range is never empty")
}

/// The only other end beside each end, where each is the only one beside the other. The start of contour `k` is end 2 `k`, its
/// end is 2 `k` + 1.
fn partners(ends: &[Point], reach: f64) -> Vec<Option<usize>> {
    // Rows of cells along X: ends beside one lie in its own row or in a neighbouring one, even if all have one X.
    let row = |k: usize| (ends[k].y / reach).floor();
    let mut sorted: Vec<usize> = (0..ends.len()).collect();
    sorted.sort_by(|&a, &b| row(a).total_cmp(&row(b)).then(ends[a].x.total_cmp(&ends[b].x)));
    let beside = |end: usize| {
        let at = ends[end];
        let near = [-1.0, 0.0, 1.0].into_iter().flat_map(|step| {
            let of_row = row(end) + step;
            let is_before = |&k: &usize| row(k) < of_row || row(k) <= of_row && ends[k].x < at.x - reach;
            let first = sorted.partition_point(is_before);
            sorted[first..].iter().copied().take_while(move |&k| row(k) <= of_row && ends[k].x <= at.x + reach)
        });
        let mut near = near.filter(|&k| k != end && (ends[k] - at).norm() <= reach);
        let only = near.next();
        if near.next().is_some() { None } else { only }
    };
    let only: Vec<Option<usize>> = (0..ends.len()).map(beside).collect();
    (0..ends.len()).map(|end| only[end].filter(|&other| only[other] == Some(end))).collect()
}

/// Rings among contours, each from its first one on; of each contour its index, and true if the ring runs through it backwards.
fn cycles(partners: &[Option<usize>]) -> Vec<Vec<(usize, bool)>> {
    let mut is_seen = vec![false; partners.len() / 2];
    let mut cycles = Vec::new();
    for first in 0..is_seen.len() {
        let mut cycle = Vec::new();
        // The end at which the ring enters a contour.
        let mut entry = Some(2 * first);
        while let Some(end) = entry.filter(|end| !is_seen[end / 2]) {
            is_seen[end / 2] = true;
            cycle.push((end / 2, end % 2 == 1));
            entry = partners[end ^ 1];
        }
        cycles.extend((!cycle.is_empty() && entry == Some(2 * first)).then_some(cycle));
    }
    cycles
}

/// Joins several ranges that make a ring into one, with their ends moved to the middles between them.
fn joined(list: &mut SegmentList, mut ranges: Vec<Range>, seam: fn(&mut SegmentList, Range, Range)) -> Range {
    for k in 0..ranges.len() {
        let after = (k + 1) % ranges.len();
        let [end, start] = [list.ends_of(ranges[k])[1], list.ends_of(ranges[after])[0]];
        let middle = end + (start - end) / 2.0;
        let mut last = list.cursor(&mut ranges[k]);
        while last.advance() {}
        *last.to_mut() = middle;
        *list.cursor(&mut ranges[after]).from_mut() = middle;
    }
    let mut whole = ranges[0];
    for &range in &ranges[1..] {
        let Some(longer) = list.join(whole, range) else { return whole };
        seam(list, whole, range);
        whole = longer;
    }
    whole
}
