//! Order: inside each piece what lies within a contour is cut before it, the outline last: a part that is free shifts.
//!
//! Needs: welded contours. Leaves true: no contour of a piece comes behind a closed one of the same piece that holds it;
//! otherwise contours keep the order of the file. Holes and slits come before all contours anyway.

use std::borrow::Cow;

use super::MarkerPass;
use crate::diagnostic::Diagnostics;
use crate::geom::{Extent, Point, ring};
use crate::ir::list::SegmentList;
use crate::ir::marker::{Contour, Marker};
use crate::machine::Job;

pub(super) const PASS: MarkerPass =
    MarkerPass { name: "order", about: "puts what lies inside a contour before it, the outline last", run };

/// Contours and vertices that are looked at to tell what lies inside what, in one marker: far more than real ones need. In a
/// drawing made to be slow, the pieces that are left keep the order of the file.
const MOST_WORK: usize = 100_000_000;

fn run(marker: &mut Marker, _: &Job, _: &mut Diagnostics) {
    let mut work = MOST_WORK;
    let Marker { list, pieces, .. } = marker;
    for piece in pieces.iter_mut().filter(|piece| piece.contours.len() > 1) {
        let shapes: Vec<Shape> = piece.contours.iter().map(|contour| Shape::of(list, contour)).collect();
        let Some(places) = (0..shapes.len()).map(|i| place(i, &shapes, &mut work)).collect::<Option<Vec<_>>>() else {
            return;
        };
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
/// first. `None` when that would take too long.
fn place(i: usize, shapes: &[Shape], work: &mut usize) -> Option<(usize, std::cmp::Reverse<usize>)> {
    let point = shapes[i].place();
    let (mut depth, mut outermost) = (0, (i, shapes[i].extent));
    for (k, other) in shapes.iter().enumerate() {
        let is_near = k != i && other.closed && other.extent.holds(point);
        *work = work.checked_sub(if is_near { other.points.len() } else { 1 })?;
        if is_near && ring::contains(&other.points, point) {
            depth += 1;
            // Of contours that hold one place, the wider one holds the other.
            let (wide, high) = (other.extent.size(), outermost.1.size());
            if wide.0 * wide.1 > high.0 * high.1 {
                outermost = (k, other.extent);
            }
        }
    }
    Some((outermost.0, std::cmp::Reverse(depth)))
}
