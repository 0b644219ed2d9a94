//! Duplicate lines: pairs in which each line lies within reach of the other along its whole length. Such a pair is one line
//! drawn twice, since parts never share all of their edges. A line that lies on another one draws a part of it again.

use crate::geom::boxes::Boxes;
use crate::geom::budget::Budget;
use crate::geom::{Extent, Point, polyline};

/// Maximum number of lines that may coincide with one line. More are a hatching, and all of them are kept.
const MOST_ALIKE: usize = 64;
/// Position of the mark in a box, as a fraction of its diagonal: far from both corners and from the middle.
const MARK: f64 = 0.618;

/// Lines to search for twins, in order of preference: the earlier line of a pair is kept.
#[derive(Debug)]
pub struct Lines<Points, Alike> {
    /// Bounding box of each line.
    pub extents: Vec<Extent>,
    /// Returns the vertices of a line, given its index.
    pub points: Points,
    /// Quick test on two indices: true if the lines may be twins. Called only for lines with nearly equal boxes.
    pub may_be: Alike,
}

impl<Points: Fn(usize) -> Vec<Point>, Alike: Fn(usize, usize) -> bool> Lines<Points, Alike> {
    /// Finds pairs of lines that lie within `reach` of each other, mm: the line that is kept, and its twin. Each line is the
    /// twin of at most one kept line. Lines that the budget leaves unsearched have no twin.
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

    /// Finds lines that lie within `reach` of another one, mm, along their whole length: each with the first such line.
    /// `lying` are the lines to look at, `may_be` tells of one of them and another line whether that one may lie there.
    pub fn lying_on(&self, lying: &[usize], reach: f64, work: &mut Budget) -> Vec<[usize; 2]> {
        let mut found = Vec::new();
        if lying.is_empty() {
            return found; // as nearly always
        }
        let boxes = Boxes::new(self.extents.clone());
        for &line in lying {
            let own = self.extents[line];
            if !work.spend(boxes.cost_near(&own)) {
                break;
            }
            let is_around = |other: &usize| *other != line && self.extents[*other].grown(reach).covers(&own);
            let mut around: Vec<usize> = boxes.near(own.grown(reach)).filter(is_around).collect();
            around.sort_unstable();
            let path = Path::new((self.points)(line));
            let lies_on = |other: &usize| {
                let points = (self.points)(*other);
                work.spend(points.len()) && path.lies_along(&Path::new(points), reach, work)
            };
            found.extend(
                around.into_iter().filter(|&other| (self.may_be)(line, other)).find(lies_on).map(|on| [line, on]),
            );
        }
        found
    }
}

/// A point in the box of a line, used as the key of the search. Lines that share a corner or a centre have different marks.
fn mark(Extent { min, max }: &Extent) -> Extent {
    let at = min + (max - min) * MARK;
    Extent::between(at, at)
}

/// A polyline with an index of its edges.
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

    /// True if every vertex and every midpoint of an edge lies within `reach` of another line, mm. False once the budget is
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
