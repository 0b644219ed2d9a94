//! Sides: joins strokes of an outline whose ends were rounded apart.
//!
//! A CAD system that writes each side of an outline separately may round a corner twice: the next side then starts a unit of
//! the file beside the end of the previous one. An outline in one stroke may end a unit beside its start. Both ends stand for
//! one place within half a diagonal of a cell of the grid, and so does the middle between them.

use crate::geom::{Point, ring};
use crate::ir::list::{Range, SegmentList};
use crate::ir::marker::{Contour, Piece};

/// Greatest distance of two ends rounded from one place, in units of the file: a unit along X and along Y.
const APART: f64 = std::f64::consts::SQRT_2 + 1e-6;

/// Joins open contours of a piece that make a ring, each starting beside the end of the previous one. A start beside two ends,
/// or an end beside two starts, stays as it is. `seam` merges the joints where two become one.
pub(super) fn join(list: &mut SegmentList, piece: &mut Piece, unit: f64, seam: fn(&mut SegmentList, Range, Range)) {
    let reach = APART * unit;
    let open: Vec<usize> = (0..piece.contours.len()).filter(|&k| !piece.contours[k].closed).collect();
    let ends: Vec<[Point; 2]> = open.iter().map(|&k| list.ends_of(piece.contours[k].range)).collect();
    let next = successors(&ends, reach);
    let mut is_taken = vec![false; piece.contours.len()];
    for cycle in cycles(&next) {
        let ranges: Vec<Range> = cycle.iter().map(|&k| piece.contours[open[k]].range).collect();
        let places = || ranges.iter().flat_map(|range| list.points(*range).to_vec());
        let (places, length): (Vec<Point>, f64) =
            (places().collect(), ranges.iter().flat_map(|range| list.walk(*range)).map(|(_, s)| s.length()).sum());
        // A stroke there and back encloses nothing.
        if ring::area(&places).abs() <= reach * length {
            continue;
        }
        piece.contours[open[cycle[0]]] = Contour { range: joined(list, ranges, seam), closed: true };
        cycle[1..].iter().for_each(|&k| is_taken[open[k]] = true);
    }
    let mut taken = is_taken.into_iter();
    piece.contours.retain(|_| !taken.next().unwrap_or_default());
}

/// Only contour that starts beside the end of each one, if no other one ends there.
fn successors(ends: &[[Point; 2]], reach: f64) -> Vec<Option<usize>> {
    let mut starts: Vec<usize> = (0..ends.len()).collect();
    starts.sort_by(|&a, &b| ends[a][0].x.total_cmp(&ends[b][0].x));
    let beside = |at: Point| {
        let first = starts.partition_point(|&k| ends[k][0].x < at.x - reach);
        let near = starts[first..].iter().copied().take_while(move |&k| ends[k][0].x <= at.x + reach);
        let mut near = near.filter(move |&k| (ends[k][0] - at).norm() <= reach);
        let only = near.next();
        if near.next().is_some() { None } else { only }
    };
    let next: Vec<Option<usize>> = ends.iter().map(|[_, end]| beside(*end)).collect();
    let mut count = vec![0; ends.len()];
    next.iter().flatten().for_each(|&k| count[k] += 1);
    next.iter().map(|next| next.filter(|&next| count[next] == 1)).collect()
}

/// Rings among contours, each from its first one on. Each contour has at most one predecessor, so every path ends or returns to
/// its start.
fn cycles(next: &[Option<usize>]) -> Vec<Vec<usize>> {
    let mut is_seen = vec![false; next.len()];
    let mut cycles = Vec::new();
    for first in 0..next.len() {
        let mut cycle = Vec::new();
        let mut at = Some(first);
        while let Some(k) = at.filter(|&k| !is_seen[k]) {
            is_seen[k] = true;
            cycle.push(k);
            at = next[k];
        }
        cycles.extend((!cycle.is_empty() && at == Some(first)).then_some(cycle));
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
