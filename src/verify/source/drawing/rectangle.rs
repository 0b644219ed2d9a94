//! Rectangles drawn by a plot, in one stroke or several: the edge of the cloth, along which outlines may be closed.
//!
//! Their strokes are straight along X or Y and meet at their ends. A stroke may continue past its start.

use crate::geom::{Extent, Point, polyline};

/// Number of steps between the sampled places of a line along a rectangle.
const STEPS: usize = 16;
/// Smaller side of the smallest rectangle that closes outlines, mm: a narrower one is a line.
const LEAST_SIZE: f64 = 30.0;
/// Greatest offset between the two ends of an edge along an axis, mm: rounding.
const ASKEW: f64 = 0.2;

/// Rectangle: its box, and its drawn edges.
pub(super) struct Rectangle {
    extent: Extent,
    edges: Vec<[Point; 2]>,
}

/// Rectangles among some strokes, whose ends meet within `reach`, mm. Each side of a rectangle has a drawn edge.
pub(super) fn drawn(strokes: &[Vec<Point>], reach: f64) -> Vec<Rectangle> {
    let straight = strokes.iter().filter(|stroke| stroke.len() > 1 && stroke.windows(2).all(is_along_axis));
    let straight: Vec<&Vec<Point>> = straight.collect();
    let mut ends: Vec<(Point, usize)> =
        straight.iter().enumerate().flat_map(|(k, stroke)| [(stroke[0], k), (stroke[stroke.len() - 1], k)]).collect();
    ends.sort_by(|a, b| a.0.x.total_cmp(&b.0.x).then(a.0.y.total_cmp(&b.0.y)).then(a.1.cmp(&b.1)));
    let mut group: Vec<usize> = (0..straight.len()).collect();
    for (i, &(at, one)) in ends.iter().enumerate() {
        let beside = ends[i + 1..].iter().take_while(|(other, _)| other.x <= at.x + reach).take(MOST_ENDS);
        for &(_, other) in beside.filter(|(other, _)| (other - at).norm() <= reach) {
            let [a, b] = [root(&mut group, one), root(&mut group, other)];
            group[a.max(b)] = a.min(b);
        }
    }
    let mut rectangles: Vec<Option<Rectangle>> = straight.iter().map(|_| None).collect();
    for (k, stroke) in straight.iter().enumerate() {
        let empty = || Rectangle { extent: Extent::EMPTY, edges: Vec::new() };
        let rectangle = rectangles[root(&mut group, k)].get_or_insert_with(empty);
        rectangle.extent.join(&Extent::of(stroke));
        rectangle.edges.extend(stroke.windows(2).map(|ends| [ends[0], ends[1]]));
    }
    rectangles.into_iter().flatten().filter(|rectangle| rectangle.is_whole(reach)).collect()
}

/// Maximum number of neighbouring ends that are compared: where more lie, no outline is closed.
const MOST_ENDS: usize = 64;

/// Stroke of least index in a group.
fn root(group: &mut [usize], of: usize) -> usize {
    let mut at = of;
    while group[at] != at {
        group[at] = group[group[at]];
        at = group[at];
    }
    at
}

fn is_along_axis(ends: &[Point]) -> bool {
    let way = ends[1] - ends[0];
    way.x.abs().min(way.y.abs()) <= ASKEW
}

impl Rectangle {
    fn corners(&self) -> [Point; 4] {
        let Extent { min, max } = self.extent;
        [min, Point::new(max.x, min.y), max, Point::new(min.x, max.y)]
    }

    /// True if each side is drawn.
    fn is_whole(&self, reach: f64) -> bool {
        let (width, height) = self.extent.size();
        let corners = self.corners();
        width.min(height) >= LEAST_SIZE
            && (0..4).all(|side| self.is_drawn([corners[side], corners[(side + 1) % 4]], reach))
    }

    /// True if an edge is drawn over its whole length.
    fn is_drawn(&self, [from, to]: [Point; 2], reach: f64) -> bool {
        let place = |k: usize| from + (to - from) * (k as f64 / STEPS as f64);
        let is_near = |at: Point| self.edges.iter().any(|[a, b]| polyline::distance_to_segment(at, *a, *b) <= reach);
        (0..=STEPS).all(|k| is_near(place(k)))
    }

    /// True if each edge of a line runs along one drawn side.
    pub(super) fn runs_along(&self, line: &[Point], reach: f64) -> bool {
        let corners = self.corners();
        let is_on = |side: usize, ends: &[Point]| {
            let [from, to] = [corners[side], corners[(side + 1) % 4]];
            ends.iter().all(|&end| polyline::distance_to_segment(end, from, to) <= reach)
        };
        line.windows(2).all(|ends| (0..4).any(|side| is_on(side, ends)) && self.is_drawn([ends[0], ends[1]], reach))
    }
}
