//! Curves through fit points, for splines without control points.

use super::nurbs::Nurbs;
use crate::geom::{Point, Vector};

/// Number of points of a closed curve that are repeated before its start and after its end, if there are that many. The end
/// effects of a natural spline decay by 0.27 per point (de Boor, *A Practical Guide to Splines*, ch. IV).
const AROUND: usize = 24;

/// The cubic spline through points, parametrised by chord length; it has no curvature at its ends unless it is closed. `None`
/// for fewer than two distinct points.
///
/// Each span is the Bezier curve given by its ends and the slopes there, which follow from the tridiagonal equations of the
/// natural spline (de Boor, ch. IV).
pub(super) fn through(points: &[Point], is_closed: bool) -> Option<Nurbs> {
    let mut points: Vec<Point> = points.to_vec();
    points.dedup();
    if is_closed && points.len() > 1 && points[0] == points[points.len() - 1] {
        points.pop();
    }
    if points.len() < 2 {
        return None;
    }
    let count = points.len();
    let is_closed = is_closed && count > 2;
    let (before, spans) = if is_closed { (AROUND, count) } else { (0, count - 1) };
    let at = |k: usize| points[(k + count * AROUND - before) % count];
    let all: Vec<Point> = (0..=spans + 2 * before).map(at).collect();
    let slopes = slopes(&all);
    let mut control = vec![all[before]];
    let mut knots = vec![0.0; 4];
    for k in before..before + spans {
        let [from, to] = [all[k], all[k + 1]];
        let third = (to - from).norm() / 3.0;
        control.extend([from + slopes[k] * third, to - slopes[k + 1] * third, to]);
        let end = knots[knots.len() - 1] + 3.0 * third;
        knots.extend([end; 3]);
    }
    knots.push(knots[knots.len() - 1]);
    Nurbs::of(3, knots, &control, &[]).ok()
}

/// The slopes of the natural cubic spline at its points, by chord length.
fn slopes(points: &[Point]) -> Vec<Vector> {
    let last = points.len() - 1;
    let chord = |k: usize| points[k + 1] - points[k];
    let length = |k: usize| chord(k).norm();
    let secant = |k: usize| chord(k) / length(k);
    // Rows of the equations for the slopes s: below s(k-1) + middle s(k) + above s(k+1) = right.
    let row = |k: usize| match k {
        0 => (0.0, 2.0, 1.0, secant(0) * 3.0),
        k if k == last => (1.0, 2.0, 0.0, secant(last - 1) * 3.0),
        k => {
            let [h, g] = [length(k - 1), length(k)];
            (g, 2.0 * (h + g), h, (secant(k - 1) * g + secant(k) * h) * 3.0)
        }
    };
    let (mut aboves, mut rights): (Vec<f64>, Vec<Vector>) = (Vec::new(), Vec::new());
    for k in 0..=last {
        let (below, middle, above, right) = row(k);
        let (before, sum) = if k == 0 { (0.0, Vector::zeros()) } else { (aboves[k - 1], rights[k - 1]) };
        let pivot = middle - below * before;
        aboves.push(above / pivot);
        rights.push((right - sum * below) / pivot);
    }
    for k in (0..last).rev() {
        rights[k] = rights[k] - rights[k + 1] * aboves[k];
    }
    rights
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_curve_goes_through_its_points_and_closes_smoothly() {
        let points: Vec<Point> = (0..12)
            .map(|k| {
                let (sin, cos) = (f64::from(k) * std::f64::consts::TAU / 12.0).sin_cos();
                Point::new(100.0 * cos, 100.0 * sin)
            })
            .collect();
        let curve = through(&points, true).expect("a curve").flatten(0.001, 10_000).expect("few");
        assert!(curve.iter().all(|place| (place.coords.norm() - 100.0).abs() < 0.05));
        assert!((curve[0] - curve[curve.len() - 1]).norm() < 1e-12);
        for point in &points {
            assert!(curve.iter().any(|place| (place - point).norm() < 1e-9));
        }
    }

    #[test]
    fn two_points_are_a_line_and_one_is_nothing() {
        let [a, b] = [Point::new(0.0, 0.0), Point::new(30.0, 40.0)];
        let line = through(&[a, b], false).expect("a line").flatten(0.01, 100).expect("few");
        assert!(line.iter().all(|place| (place.y * 3.0 - place.x * 4.0).abs() < 1e-9));
        assert!(through(&[a, a], false).is_none());
    }
}
