//! Order: inside each piece what lies within a contour is cut before it, the outline last: a part that is free shifts.
//!
//! Needs: welded contours. Leaves true: no contour of a piece comes behind a closed one of the same piece that holds it;
//! otherwise contours keep the order of the file. Holes and slits come before all contours anyway.

use std::borrow::Cow;
use std::cmp::Reverse;

use rayon::prelude::*;

use super::{MarkerPass, depth_cost, in_parts, too_many_outlines};
use crate::diagnostic::{Diagnostic, Diagnostics};
use crate::geom::budget::Budget;
use crate::geom::region::Regions;
use crate::geom::{Extent, Point};
use crate::ir::list::SegmentList;
use crate::ir::marker::{Contour, Marker, Piece};
use crate::machine::Job;

pub(super) const PASS: MarkerPass =
    MarkerPass { name: "order", about: "puts what lies inside a contour before it, the outline last", run };

fn run(marker: &mut Marker, _: &Job, diagnostics: &mut Diagnostics) {
    let Marker { list, pieces, .. } = marker;
    let parts = in_parts(pieces.len());
    let sort = |pieces: &mut [Piece]| {
        let mut work = parts.budget();
        pieces.iter_mut().find_map(|piece| sort(list, piece, &mut work).err())
    };
    let ended: Vec<Option<Diagnostic>> = pieces.par_chunks_mut(parts.size).map(sort).collect();
    ended.into_iter().flatten().for_each(|finding| diagnostics.push(finding));
}

/// Puts the contours of a piece in order, unless there are too many in one another.
fn sort(list: &SegmentList, piece: &mut Piece, work: &mut Budget) -> Result<(), Diagnostic> {
    if piece.contours.len() < 2 {
        return Ok(());
    }
    let shapes: Vec<Shape> = piece.contours.iter().map(|contour| Shape::of(list, contour)).collect();
    let closed = (0..shapes.len() as u32).filter(|&i| shapes[i as usize].closed);
    let regions = Regions::new(closed, |i| vec![Cow::Borrowed(&*shapes[i as usize].points)]);
    let places: Option<Vec<_>> = (0..shapes.len()).map(|i| place(i, (&shapes, &regions), work)).collect();
    let places = places.ok_or_else(|| too_many_outlines(piece))?;
    let mut order: Vec<usize> = (0..shapes.len()).collect();
    order.sort_by_key(|&i| places[i]); // stable: the order of the file among equals
    piece.contours = order.into_iter().map(|i| piece.contours[i]).collect();
    Ok(())
}

/// A contour as a shape.
struct Shape<'a> {
    /// Its points; those of a closed one end with its first point.
    points: Cow<'a, [Point]>,
    extent: Extent,
    closed: bool,
}

impl<'a> Shape<'a> {
    fn of(list: &'a SegmentList, contour: &Contour) -> Self {
        let points = list.points(contour.range);
        Self { extent: Extent::of(&points), points, closed: contour.closed }
    }

    /// A place of it: the middle of its first segment, because an open line may begin on an outline.
    fn place(&self) -> Point {
        let (a, b) = (self.points[0], self.points[1]);
        a + (b - a) / 2.0
    }
}

/// By what a contour is sorted: the first contour among those that hold it and are held by none, then how many hold it, most
/// first. `None` when there is no work left.
fn place(i: usize, (shapes, regions): (&[Shape], &Regions), work: &mut Budget) -> Option<(usize, Reverse<usize>)> {
    let point = shapes[i].place();
    if !work.spend(regions.cost_at(point)) {
        return None;
    }
    let (mut depth, mut outermost) = (0, (i, shapes[i].extent));
    for k in regions.owners_at(point).into_iter().map(|k| k as usize).filter(|&k| k != i) {
        depth += 1;
        // Of contours that hold one place, the wider one holds the other.
        let (wide, high) = (shapes[k].extent.size(), outermost.1.size());
        if wide.0 * wide.1 > high.0 * high.1 {
            outermost = (k, shapes[k].extent);
        }
    }
    work.spend(depth_cost(depth)).then_some((outermost.0, Reverse(depth)))
}
