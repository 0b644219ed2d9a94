//! Inner: a cut-out that is a piece of its own is cut before the part that it lies in: a part that is free shifts.
//!
//! Needs: welded contours. In a file without numbers of pieces every contour is a piece. Leaves true: no piece that is a
//! cut-out of another comes behind it, unless something is asked of the operator before it; otherwise pieces keep the
//! order of the file.

use rayon::prelude::*;

use super::MarkerPass;
use crate::diagnostic::Diagnostics;
use crate::geom::budget::Budget;
use crate::geom::{Extent, Point, ring};
use crate::ir::list::SegmentList;
use crate::ir::marker::{Marker, Piece};
use crate::machine::Job;

pub(super) const PASS: MarkerPass =
    MarkerPass { name: "inner", about: "puts a cut-out that is a piece of its own before its part", run };

fn run(marker: &mut Marker, _: &Job, _: &mut Diagnostics) {
    let Marker { list, pieces, .. } = marker;
    let spaces: Vec<Extent> = pieces.par_iter().map(|piece| space(list, piece)).collect();
    let mut moved = cut_outs(list, pieces, &spaces);
    moved.retain(|&(inner, part)| part < inner && pieces[inner].events.is_empty());
    if !moved.is_empty() {
        let mut places: Vec<(usize, usize)> = (0..pieces.len()).map(|i| (i, pieces.len())).collect();
        for (inner, part) in moved {
            places[inner] = (part, inner);
        }
        let mut order: Vec<usize> = (0..pieces.len()).collect();
        order.sort_by_key(|&i| places[i]);
        let mut left: Vec<Option<Piece>> = pieces.drain(..).map(Some).collect();
        pieces.extend(order.into_iter().filter_map(|i| left[i].take()));
    }
}

/// The pieces that are cut-outs of others, each with its part.
fn cut_outs(list: &SegmentList, pieces: &[Piece], spaces: &[Extent]) -> Vec<(usize, usize)> {
    // Room for all: a vector that grows takes new memory each time, and that is slow.
    let mut by_start: Vec<(f64, usize)> = Vec::with_capacity(spaces.len());
    by_start.extend(spaces.iter().map(|space| space.min.x).zip(0..).filter(|&(_, i)| !spaces[i].is_empty()));
    by_start.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    let mut work = Budget::of_a_marker();
    // Those that begin no farther than here along X and have not ended.
    let mut open: Vec<usize> = Vec::new();
    let mut found = Vec::new();
    for (k, &(_, i)) in by_start.iter().enumerate() {
        let (extent, Some(point)) = (&spaces[i], point_on(list, &pieces[i])) else { continue };
        open.retain(|&other| spaces[other].max.x >= extent.min.x);
        // Others may begin at the very same place.
        let level = by_start[k + 1..].iter().take_while(|(start, _)| *start <= extent.min.x).map(|&(_, other)| other);
        let wider = open.iter().copied().chain(level).filter(|&other| spaces[other].covers(extent));
        if !work.spend(open.len() + 1) {
            break;
        }
        let holders: Vec<usize> = wider.filter(|&other| holds(list, &pieces[other], point, &mut work)).collect();
        if holders.len() % 2 == 1 {
            let area = |&i: &usize| {
                let (width, height) = spaces[i].size();
                width * height
            };
            let smallest = holders.into_iter().min_by(|a, b| area(a).total_cmp(&area(b)).then(a.cmp(b)));
            found.extend(smallest.map(|part| (i, part)));
        }
        open.push(i);
    }
    found
}

/// Whether a point lies in a piece: in an odd number of its closed contours.
fn holds(list: &SegmentList, piece: &Piece, point: Point, work: &mut Budget) -> bool {
    let closed = piece.contours.iter().filter(|contour| contour.closed);
    let holding = closed.filter(|contour| {
        let points = list.points(contour.range);
        work.spend(points.len()) && ring::contains(&points, point)
    });
    holding.count() % 2 == 1
}

/// The box around the closed contours of a piece.
fn space(list: &SegmentList, piece: &Piece) -> Extent {
    let mut space = Extent::EMPTY;
    for contour in piece.contours.iter().filter(|contour| contour.closed) {
        space.join(&Extent::of(&list.points(contour.range)));
    }
    space
}

/// A point on the first closed contour of a piece; none when none is closed.
fn point_on(list: &SegmentList, piece: &Piece) -> Option<Point> {
    piece.contours.iter().find(|contour| contour.closed).map(|contour| list.ends_of(contour.range)[0])
}
