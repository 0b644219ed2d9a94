//! Inner: a cut-out that is a piece of its own is cut before the part that it lies in: a part that is free shifts.
//!
//! Needs: welded contours. In a file without numbers of pieces every contour is a piece. Leaves true: no piece that is a
//! cut-out of another comes behind it, unless something is asked of the operator before it; otherwise pieces keep the
//! order of the file.

use rayon::prelude::*;

use super::{MarkerPass, too_many_outlines};
use crate::diagnostic::Diagnostics;
use crate::geom::boxes::Boxes;
use crate::geom::budget::Budget;
use crate::geom::{Extent, Point, ring};
use crate::ir::list::SegmentList;
use crate::ir::marker::{Marker, Piece};
use crate::machine::Job;

pub(super) const PASS: MarkerPass =
    MarkerPass { name: "inner", about: "puts a cut-out that is a piece of its own before its part", run };

/// Parts lie in one another less deep than this.
const DEEP: usize = 16;
/// What a piece costs for each other that it lies in beyond that, beside the comparison of two boxes: whatever is asked of a
/// place in it looks at them all.
const HELD: usize = 200;

fn run(marker: &mut Marker, _: &Job, diagnostics: &mut Diagnostics) {
    let Marker { list, pieces, .. } = marker;
    let spaces = Boxes::new(pieces.par_iter().map(|piece| space(list, piece)).collect());
    let mut work = Budget::of_a_marker();
    let mut moved = cut_outs(list, pieces, &spaces, &mut work);
    if work.is_spent() {
        diagnostics.push(too_many_outlines());
    }
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
fn cut_outs(list: &SegmentList, pieces: &[Piece], spaces: &Boxes, work: &mut Budget) -> Vec<(usize, usize)> {
    let mut found = Vec::new();
    for (i, (piece, space)) in pieces.iter().zip(spaces.all()).enumerate() {
        let Some(point) = point_on(list, piece) else { continue };
        if !work.spend(spaces.looked_at(space.min)) {
            break;
        }
        // What covers a box holds its corner.
        let wider = spaces.at(space.min).filter(|&other| other != i && spaces.all()[other].covers(space));
        let holders: Vec<usize> = wider.filter(|&other| holds(list, &pieces[other], point, work)).collect();
        work.spend(HELD * holders.len().saturating_sub(DEEP));
        if holders.len() % 2 == 1 {
            let area = |&i: &usize| {
                let (width, height) = spaces.all()[i].size();
                width * height
            };
            let smallest = holders.into_iter().min_by(|a, b| area(a).total_cmp(&area(b)).then(a.cmp(b)));
            found.extend(smallest.map(|part| (i, part)));
        }
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
