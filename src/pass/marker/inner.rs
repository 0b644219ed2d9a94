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

/// A piece as the space that it takes.
struct Space {
    extent: Extent,
    /// A point on one of its closed contours; none when none is closed.
    point: Option<Point>,
}

fn run(marker: &mut Marker, _: &Job, _: &mut Diagnostics) {
    let Marker { list, pieces, .. } = marker;
    let spaces: Vec<Space> = pieces.par_iter().map(|piece| Space::of(list, piece)).collect();
    let mut places: Vec<(usize, usize)> = (0..pieces.len()).map(|i| (i, pieces.len())).collect();
    let mut is_moved = false;
    for (inner, part) in cut_outs(list, pieces, &spaces) {
        if part < inner && pieces[inner].events.is_empty() {
            places[inner] = (part, inner);
            is_moved = true;
        }
    }
    if is_moved {
        let mut order: Vec<usize> = (0..pieces.len()).collect();
        order.sort_by_key(|&i| places[i]);
        let mut left: Vec<Option<Piece>> = pieces.drain(..).map(Some).collect();
        pieces.extend(order.into_iter().filter_map(|i| left[i].take()));
    }
}

/// The pieces that are cut-outs of others, each with its part.
fn cut_outs(list: &SegmentList, pieces: &[Piece], spaces: &[Space]) -> Vec<(usize, usize)> {
    let mut by_start: Vec<usize> = (0..spaces.len()).filter(|&i| spaces[i].point.is_some()).collect();
    by_start.sort_by(|&a, &b| spaces[a].extent.min.x.total_cmp(&spaces[b].extent.min.x).then(a.cmp(&b)));
    let mut work = Budget::of_a_marker();
    // Those that begin no farther than here along X and have not ended.
    let mut open: Vec<usize> = Vec::new();
    let mut found = Vec::new();
    for (k, &i) in by_start.iter().enumerate() {
        let Space { extent, point: Some(point) } = &spaces[i] else { continue };
        open.retain(|&other| spaces[other].extent.max.x >= extent.min.x);
        // Others may begin at the very same place.
        let level = by_start[k + 1..].iter().take_while(|&&other| spaces[other].extent.min.x <= extent.min.x);
        let wider = open.iter().chain(level).copied().filter(|&other| spaces[other].extent.covers(extent));
        if !work.spend(open.len() + 1) {
            break;
        }
        let holders: Vec<usize> = wider.filter(|&other| holds(list, &pieces[other], *point, &mut work)).collect();
        if holders.len() % 2 == 1 {
            let area = |&i: &usize| {
                let (width, height) = spaces[i].extent.size();
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
        let points: Vec<Point> = list.points(contour.range).collect();
        work.spend(points.len()) && ring::contains(&points, point)
    });
    holding.count() % 2 == 1
}

impl Space {
    fn of(list: &SegmentList, piece: &Piece) -> Self {
        let mut space = Self { extent: Extent::EMPTY, point: None };
        for contour in piece.contours.iter().filter(|contour| contour.closed) {
            for point in list.points(contour.range) {
                space.extent.add(point);
                space.point.get_or_insert(point);
            }
        }
        space
    }
}
