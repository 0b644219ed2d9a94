//! Twins: lines that lie in the places of one before them, but not place by place. A second pass of an outline may start
//! elsewhere, have other places on its edges, or lie a unit aside.
//!
//! Of two parts each lies in places of its own, so two lines that lie along each other from end to end are one.

use std::collections::BTreeSet;

use super::line::{Class, Closing, Line};
use crate::geom::boxes::Boxes;
use crate::geom::budget::Budget;
use crate::geom::{Extent, Point, polyline};
use crate::ir::drawing::Vertex;

/// Most lines whose boxes begin near that of one: more are a hatching, and none of them is taken out.
const MOST_ALIKE: usize = 64;

/// Marks the lines that lie within `reach` of another one everywhere, mm, and that one within `reach` of them. Of two the
/// one that needs no closing stays, then the first.
pub(super) fn mark(lines: &mut [Line], vertices: &[Vertex], reach: f64, work: &mut Budget) {
    let corner = |line: &Line| Extent::between(line.extent.min, line.extent.min);
    let mut order: Vec<usize> = (0..lines.len()).filter(|&i| !lines[i].is_set_aside()).collect();
    order.sort_by_key(|&i| (lines[i].closing != Closing::Drawn, i));
    let boxes = Boxes::new(order.iter().map(|&i| corner(&lines[i])).collect());
    let mut taken = BTreeSet::new();
    for (k, &kept) in order.iter().enumerate() {
        let around = corner(&lines[kept]).grown(reach);
        if taken.contains(&kept) || !work.spend(boxes.cost_near(&around)) {
            continue;
        }
        let alike = boxes.near(around).filter(|&other| other > k).map(|other| order[other]);
        let alike: Vec<usize> = alike.filter(|&other| may_be_twins([&lines[kept], &lines[other]], reach)).collect();
        if alike.is_empty() || alike.len() > MOST_ALIKE {
            continue;
        }
        let path = Path::new(&lines[kept], vertices);
        for other in alike {
            let twin = Path::new(&lines[other], vertices);
            if path.lies_along(&twin, reach, work) && twin.lies_along(&path, reach, work) {
                taken.insert(other);
            }
        }
    }
    for line in taken {
        lines[line].class = Class::Again;
    }
}

/// Whether two lines have the same use, box and kind, nearly.
fn may_be_twins([one, other]: [&Line; 2], reach: f64) -> bool {
    let off = (other.extent.min - one.extent.min).amax().max((other.extent.max - one.extent.max).amax());
    off <= reach && one.usage == other.usage && one.is_closed == other.is_closed
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

    /// Whether all places of a line lie within reach of another one; not so once the budget is spent.
    fn lies_along(&self, other: &Self, reach: f64, work: &mut Budget) -> bool {
        self.points.iter().all(|&at| {
            let around = Extent::between(at, at).grown(reach);
            let is_near =
                |edge: usize| polyline::distance_to_segment(at, other.points[edge], other.points[edge + 1]) <= reach;
            work.spend(other.boxes.cost_near(&around)) && other.boxes.near(around).any(is_near)
        })
    }
}
