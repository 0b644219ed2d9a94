//! Needle points along a line: one on each corner, the others evenly between.

use crate::geom::{Point, polyline};
use crate::sew::pattern::distinct;
use crate::units::rad;

/// Relative amount by which a stitch may exceed the pitch to save a stitch: lengths of lines carry rounding errors of their
/// sums.
const PITCH_EPSILON: f64 = 1e-9;

/// Needle points along a line, including its ends: one on every vertex that turns by `corner_deg` or more, and evenly between
/// these, at most `pitch` apart along the line.
pub(super) fn even(points: &[Point], pitch: f64, corner_deg: f64) -> Vec<Point> {
    let points = distinct(points);
    let Some(&first) = points.first() else { return Vec::new() };
    let mut out = vec![first];
    let mut from = 0;
    for at in 1..points.len() {
        let is_end = at + 1 == points.len();
        if is_end || polyline::turn_at(points[at - 1], points[at], points[at + 1]).abs() >= rad(corner_deg) {
            between(&points[from..=at], pitch, &mut out);
            from = at;
        }
    }
    out
}

/// Adds the needle points of a stretch after its first point.
fn between(points: &[Point], pitch: f64, out: &mut Vec<Point>) {
    let stations = polyline::stations(points);
    let length = stations[stations.len() - 1];
    let count = (length / pitch - PITCH_EPSILON).ceil().max(1.0);
    let count = count as usize;
    for i in 1..count {
        out.push(polyline::place(points, &stations, length * i as f64 / count as f64));
    }
    // The exact end point, without the rounding of summed lengths.
    out.push(points[points.len() - 1]);
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(points: &[[f64; 2]], expected: &[[f64; 2]]) {
        let points: Vec<Point> = points.iter().map(|&[x, y]| Point::new(x, y)).collect();
        let rounded = |value: f64| (value * 1e6).round() / 1e6;
        let laid: Vec<[f64; 2]> = even(&points, 2.5, 20.0).iter().map(|p| [rounded(p.x), rounded(p.y)]).collect();
        assert_eq!(laid, expected);
    }

    #[test]
    fn every_corner_has_a_needle_point_and_the_pitch_is_even_between() {
        check(&[[0.0, 0.0], [6.0, 0.0], [6.0, 2.5]], &[[0.0, 0.0], [2.0, 0.0], [4.0, 0.0], [6.0, 0.0], [6.0, 2.5]]);
        check(&[[0.0, 0.0], [0.3, 0.0], [5.0, 0.0]], &[[0.0, 0.0], [2.5, 0.0], [5.0, 0.0]]);
        check(&[[0.0, 0.0], [0.0, 0.0], [1.0, 0.0]], &[[0.0, 0.0], [1.0, 0.0]]);
    }
}
