//! Twins: lines along which another line of the same use runs from end to end, though their vertices differ. A second pass
//! of an outline may start elsewhere, have other vertices, or lie a unit aside.
//!
//! Two parts never share all of their edges, so twins are one line.

use std::collections::BTreeSet;

use super::line::{Class, Closing, Line};
use crate::geom::boxes::Boxes;
use crate::geom::budget::Budget;
use crate::geom::{Extent, Point, polyline};
use crate::ir::drawing::Vertex;

/// Most twins that one line may have; more are a hatching, of which every line stays.
const MOST_ALIKE: usize = 64;
/// Share of the way from the least corner of a box to its greatest: far from both and from the middle.
const MARK: f64 = 0.618;

/// Marks lines as drawn again: those that lie within `reach`, mm, of another line, and that line of them. The line that
/// needs no closing stays; of two such lines, the first.
pub(super) fn mark(lines: &mut [Line], vertices: &[Vertex], reach: f64, work: &mut Budget) {
    let mut order: Vec<usize> = (0..lines.len()).filter(|&i| !lines[i].is_set_aside()).collect();
    order.sort_by_key(|&i| (lines[i].closing != Closing::Drawn, i));
    let boxes = Boxes::new(order.iter().map(|&i| mark_of(&lines[i])).collect());
    let mut taken = BTreeSet::new();
    for (k, &kept) in order.iter().enumerate() {
        let around = mark_of(&lines[kept]).grown(reach);
        if taken.contains(&kept) || !work.spend(boxes.cost_near(&around)) {
            continue;
        }
        let may_be = |other: &usize| may_be_twins([&lines[kept], &lines[order[*other]]], reach);
        let alike: Vec<usize> = boxes.near(around).filter(|&other| other != k).filter(may_be).collect();
        if alike.len() > MOST_ALIKE || !alike.iter().any(|&other| other > k) {
            continue;
        }
        let path = Path::new(&lines[kept], vertices);
        for other in alike.into_iter().filter(|&other| other > k).map(|other| order[other]) {
            let twin = Path::new(&lines[other], vertices);
            if !work.spend(path.points.len() + twin.points.len()) {
                break;
            }
            if path.lies_along(&twin, reach, work) && twin.lies_along(&path, reach, work) {
                taken.insert(other);
            }
        }
    }
    for line in taken {
        lines[line].class = Class::Again;
    }
}

/// A place of the box of a line by which twins are looked for: lines that share a corner or their middle have others.
fn mark_of(line: &Line) -> Extent {
    let Extent { min, max } = line.extent;
    let at = min + (max - min) * MARK;
    Extent::between(at, at)
}

/// Whether two lines have the same use and kind, and nearly the same box and area.
fn may_be_twins([one, other]: [&Line; 2], reach: f64) -> bool {
    let off = (other.extent.min - one.extent.min).amax().max((other.extent.max - one.extent.max).amax());
    let is_as_large = (one.area - other.area).abs() <= reach * one.length.max(other.length);
    off <= reach && is_as_large && one.usage == other.usage && one.is_closed == other.is_closed
}

/// The edges of a line, by their boxes.
struct Path {
    points: Vec<Point>,
    boxes: Boxes,
}

impl Path {
    fn new(line: &Line, vertices: &[Vertex]) -> Self {
        let points = line.points(vertices);
        let boxes = Boxes::new(points.windows(2).map(|ends| Extent::between(ends[0], ends[1])).collect());
        Self { points, boxes }
    }

    /// Whether every vertex and every middle of an edge lies within reach, mm, of another line; false once the budget is spent.
    fn lies_along(&self, other: &Self, reach: f64, work: &mut Budget) -> bool {
        let middles = self.points.windows(2).map(|ends| ends[0] + (ends[1] - ends[0]) / 2.0);
        self.points.iter().copied().chain(middles).all(|at| {
            let around = Extent::between(at, at).grown(reach);
            let is_near =
                |edge: usize| polyline::distance_to_segment(at, other.points[edge], other.points[edge + 1]) <= reach;
            work.spend(other.boxes.cost_near(&around)) && other.boxes.near(around).any(is_near)
        })
    }
}
