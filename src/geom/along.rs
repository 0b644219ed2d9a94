//! Lines along each other: each of their places lies within reach of the other one. Such lines are one line that stands
//! twice: parts never share all of their edges.

use crate::geom::boxes::Boxes;
use crate::geom::budget::Budget;
use crate::geom::{Extent, Point, polyline};

/// Most lines that may stand where one does; more are a hatching, of which every line stays.
const MOST_ALIKE: usize = 64;
/// Share of the way from the least corner of a box to its greatest: far from both and from the middle.
const MARK: f64 = 0.618;

/// Lines among which twins are looked for, in the order in which they are kept.
#[derive(Debug)]
pub struct Lines<Points, Alike> {
    /// The box of each.
    pub extents: Vec<Extent>,
    /// The vertices of a line, by its place in the order.
    pub points: Points,
    /// Whether two lines may be twins, by their places in the order: their boxes nearly agree.
    pub may_be: Alike,
}

impl<Points: Fn(usize) -> Vec<Point>, Alike: Fn(usize, usize) -> bool> Lines<Points, Alike> {
    /// Pairs of lines each of which lies within `reach`, mm, along the other: the one that is kept, and its twin. A line has
    /// one twin that is kept. What the budget leaves unsearched has none.
    pub fn twins(&self, reach: f64, work: &mut Budget) -> Vec<[usize; 2]> {
        let boxes = Boxes::new(self.extents.iter().map(mark).collect());
        let mut is_taken = vec![false; self.extents.len()];
        let mut twins = Vec::new();
        for kept in 0..self.extents.len() {
            let around = mark(&self.extents[kept]).grown(reach);
            if is_taken[kept] || !work.spend(boxes.cost_near(&around)) {
                continue;
            }
            let off = |a: Point, b: Point| (b - a).amax();
            let has_its_box = |other: usize| {
                let [a, b] = [&self.extents[kept], &self.extents[other]];
                off(a.min, b.min).max(off(a.max, b.max)) <= reach
            };
            let near = boxes.near(around).filter(|&other| other != kept && has_its_box(other));
            let alike: Vec<usize> = near.filter(|&other| (self.may_be)(kept, other)).collect();
            if alike.len() > MOST_ALIKE || !alike.iter().any(|&other| other > kept) {
                continue;
            }
            let path = Path::new((self.points)(kept));
            for other in alike.into_iter().filter(|&other| other > kept) {
                let twin = Path::new((self.points)(other));
                if !work.spend(path.points.len() + twin.points.len()) {
                    break;
                }
                if path.lies_along(&twin, reach, work) && twin.lies_along(&path, reach, work) && !is_taken[other] {
                    is_taken[other] = true;
                    twins.push([kept, other]);
                }
            }
        }
        twins
    }
}

/// A place of the box of a line by which twins are looked for: lines that share a corner or their middle have others.
fn mark(Extent { min, max }: &Extent) -> Extent {
    let at = min + (max - min) * MARK;
    Extent::between(at, at)
}

/// The edges of a polyline, by their boxes.
#[derive(Debug)]
struct Path {
    points: Vec<Point>,
    boxes: Boxes,
}

impl Path {
    fn new(points: Vec<Point>) -> Self {
        let boxes = Boxes::new(points.windows(2).map(|ends| Extent::between(ends[0], ends[1])).collect());
        Self { points, boxes }
    }

    /// Whether every vertex and every middle of an edge lies within reach, mm, of another line; false once the budget is
    /// spent.
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
