//! Edges that bound two parts and are drawn once: a stroke draws each, and two cuts run along it.

use crate::geom::boxes::Boxes;
use crate::geom::{Extent, Point, polyline};

/// Starts of such edges that lie farther than `reach` mm from every stroke, or on fewer than two cuts.
pub(super) fn wrong(shared: &[Vec<Point>], drawn: &[Vec<Point>], cuts: &[Vec<Point>], reach: f64) -> Vec<Point> {
    if shared.is_empty() {
        return Vec::new();
    }
    let boxes = |lines: &[Vec<Point>]| Boxes::new(lines.iter().map(|line| Extent::of(line).grown(reach)).collect());
    let (of_drawn, of_cuts) = (boxes(drawn), boxes(cuts));
    let along = |edge: &[Point], boxes: &Boxes, lines: &[Vec<Point>]| {
        let middles = edge.windows(2).map(|ends| ends[0] + (ends[1] - ends[0]) / 2.0);
        let places: Vec<Point> = edge.iter().copied().chain(middles).collect();
        let runs_by = |line: &usize| places.iter().all(|at| polyline::distance(*at, &lines[*line]) <= reach);
        boxes.near(Extent::of(edge)).filter(runs_by).count()
    };
    let is_right = |edge: &&Vec<Point>| along(edge, &of_drawn, drawn) >= 1 && along(edge, &of_cuts, cuts) >= 2;
    shared.iter().filter(|edge| !is_right(edge)).map(|edge| edge[0]).collect()
}
