//! Inset of closed contours: the line of a seam at a distance inside a contour, or around a cut-out.

use crate::geom::boxes::Boxes;
use crate::geom::{Extent, Point, Vector, cross, left, polyline, ring};

/// Relative amount by which a point may be closer to the contour than the inset: rounding of intersections.
const NEAR_EPSILON: f64 = 1e-6;
/// Sine of the angle between edges below which they are parallel.
const PARALLEL_EPSILON: f64 = 1e-9;

/// A shifted edge: a point and its direction.
#[derive(Clone, Copy)]
struct Edge {
    at: Point,
    along: Vector,
}

/// The closed line at a distance inside a closed contour, or around it if the distance is negative; `None` if there is no room.
/// Corners stay corners.
pub(super) fn inset(points: &[Point], distance: f64) -> Option<Vec<Point>> {
    let inwards = if ring::area(points) > 0.0 { distance } else { -distance };
    let mut edges: Vec<Edge> = (points.windows(2))
        .filter_map(|ends| polyline::direction(ends[0], ends[1]).map(|along| (ends[0], along)))
        .map(|(from, along)| Edge { at: from + left(along) * inwards, along })
        .collect();
    // An edge that is too short for the inset reverses; without it its neighbours meet.
    loop {
        if edges.len() < 3 {
            return None;
        }
        let corners = corners(&edges);
        let count = edges.len();
        let ways: Vec<f64> = (0..count).map(|i| (corners[(i + 1) % count] - corners[i]).dot(&edges[i].along)).collect();
        if ways.iter().all(|&way| way >= 0.0) {
            let mut out = corners;
            out.push(out[0]);
            return is_clear(&out, points, distance.abs()).then_some(out);
        }
        // Of adjacent reversed edges the most reversed one is removed first, as it may be the cause of the other.
        let goes = |i: usize| {
            let (before, behind) = (ways[(i + count - 1) % count], ways[(i + 1) % count]);
            ways[i] < 0.0 && ways[i] < before && ways[i] <= behind
        };
        let kept: Vec<Edge> = (0..count).filter(|&i| !goes(i)).map(|i| edges[i]).collect();
        if kept.len() == count {
            return None;
        }
        edges = kept;
    }
}

/// Start point of each edge: its intersection with the previous one.
fn corners(edges: &[Edge]) -> Vec<Point> {
    let meet = |i: usize| {
        let (before, edge) = (edges[(i + edges.len() - 1) % edges.len()], edges[i]);
        let sine = cross(before.along, edge.along);
        if sine.abs() < PARALLEL_EPSILON {
            return edge.at;
        }
        before.at + before.along * (cross(edge.at - before.at, edge.along) / sine)
    };
    (0..edges.len()).map(meet).collect()
}

/// True if every point of a line is at least `distance` mm away from a contour.
pub(super) fn is_clear(line: &[Point], contour: &[Point], distance: f64) -> bool {
    let least = distance * (1.0 - NEAR_EPSILON);
    let boxes = Boxes::new(contour.windows(2).map(|ends| Extent::of(ends).grown(distance)).collect());
    line.windows(2).all(|a| {
        let apart = |i: usize| polyline::distance_of_segments([a[0], a[1]], [contour[i], contour[i + 1]]);
        boxes.near(Extent::of(a)).all(|i| apart(i) >= least)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(points: &[[f64; 2]], distance: f64, expected: Option<&[[f64; 2]]>) {
        let points: Vec<Point> = points.iter().map(|&[x, y]| Point::new(x, y)).collect();
        let rounded = |value: f64| (value * 1e6).round() / 1e6;
        let found = inset(&points, distance);
        let found = found.map(|points| points.iter().map(|p| [rounded(p.x), rounded(p.y)]).collect::<Vec<_>>());
        assert_eq!(found.as_deref(), expected);
    }

    #[test]
    fn a_contour_shrinks_and_small_edges_go() {
        let square = [[0.0, 0.0], [10.0, 0.0], [10.0, 10.0], [0.0, 10.0], [0.0, 0.0]];
        let inner = [[2.0, 2.0], [8.0, 2.0], [8.0, 8.0], [2.0, 8.0], [2.0, 2.0]];
        check(&square, 2.0, Some(&inner));
        let turned: Vec<[f64; 2]> = square.iter().rev().copied().collect();
        check(&turned, 2.0, Some(&[[2.0, 2.0], [2.0, 8.0], [8.0, 8.0], [8.0, 2.0], [2.0, 2.0]]));
        check(&square, 5.1, None);
        let cut = [[0.0, 0.0], [9.5, 0.0], [10.0, 0.5], [10.0, 10.0], [0.0, 10.0], [0.0, 0.0]];
        check(&cut, 2.0, Some(&inner));
        let outer = [[-2.0, -2.0], [12.0, -2.0], [12.0, 12.0], [-2.0, 12.0], [-2.0, -2.0]];
        check(&square, -2.0, Some(&outer));
        let turned_outer: Vec<[f64; 2]> = outer.iter().rev().copied().collect();
        check(&turned, -2.0, Some(&turned_outer));
        // A waist narrower than twice the inset.
        let waist = [
            [0.0, 0.0],
            [10.0, 0.0],
            [10.0, 4.5],
            [30.0, 4.5],
            [30.0, 0.0],
            [40.0, 0.0],
            [40.0, 10.0],
            [30.0, 10.0],
            [30.0, 5.5],
            [10.0, 5.5],
            [10.0, 10.0],
            [0.0, 10.0],
            [0.0, 0.0],
        ];
        check(&waist, 1.0, None);
    }
}
