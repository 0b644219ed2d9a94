//! Order: inside each piece what lies within a contour is cut before it, the outline last: a part that is free shifts.
//!
//! Needs: welded contours. Leaves true: no contour of a piece comes behind a closed one of the same piece that holds it;
//! otherwise contours keep the order of the file. Holes and slits come before all contours anyway.

use std::borrow::Cow;
use std::cmp::Reverse;

use super::{MarkerPass, too_many_outlines};
use crate::diagnostic::Diagnostics;
use crate::geom::boxes::Boxes;
use crate::geom::budget::Budget;
use crate::geom::{Extent, Point, ring};
use crate::ir::list::SegmentList;
use crate::ir::marker::{Contour, Marker};
use crate::machine::Job;

pub(super) const PASS: MarkerPass =
    MarkerPass { name: "order", about: "puts what lies inside a contour before it, the outline last", run };

fn run(marker: &mut Marker, _: &Job, diagnostics: &mut Diagnostics) {
    let mut work = Budget::of_a_marker();
    let Marker { list, pieces, .. } = marker;
    for piece in pieces.iter_mut().filter(|piece| piece.contours.len() > 1) {
        let shapes: Vec<Shape> = piece.contours.iter().map(|contour| Shape::of(list, contour)).collect();
        let boxes = Boxes::new(shapes.iter().map(|shape| shape.extent).collect());
        let places: Vec<_> = (0..shapes.len()).map(|i| place(i, &shapes, &boxes, &mut work)).collect();
        if work.is_spent() {
            diagnostics.push(too_many_outlines().at(piece.span));
            return;
        }
        let mut order: Vec<usize> = (0..shapes.len()).collect();
        order.sort_by_key(|&i| places[i]); // stable: the order of the file among equals
        piece.contours = order.into_iter().map(|i| piece.contours[i]).collect();
    }
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
/// first. Without work left it is anything.
fn place(i: usize, shapes: &[Shape], boxes: &Boxes, work: &mut Budget) -> (usize, Reverse<usize>) {
    let point = shapes[i].place();
    let (mut depth, mut outermost) = (0, (i, shapes[i].extent));
    work.spend(boxes.looked_at(point));
    for (k, other) in boxes.at(point).map(|k| (k, &shapes[k])).filter(|(k, other)| *k != i && other.closed) {
        if work.spend(other.points.len()) && ring::contains(&other.points, point) {
            depth += 1;
            // Of contours that hold one place, the wider one holds the other.
            let (wide, high) = (other.extent.size(), outermost.1.size());
            if wide.0 * wide.1 > high.0 * high.1 {
                outermost = (k, other.extent);
            }
        }
    }
    (outermost.0, Reverse(depth))
}
