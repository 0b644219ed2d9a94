//! Arcs and circles of a pattern: their points in the file become a line on the curve.

use super::pattern::{Element, Pattern, SAME_EPSILON, Seam, Shape};
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::geom::{Point, Rotation, cross};
use crate::machine::Sewing;

/// Greatest turn from chord to chord, rad: far below any corner of a seam.
const MOST_TURN: f64 = 0.05;
/// Least sine of the turn at the middle point of an arc: below it the centre is lost in rounding.
const STRAIGHT_EPSILON: f64 = 1e-6;

/// Least number of stitches that go around a circle.
const FEWEST: f64 = 3.0;

/// Replaces the points of arcs and circles by points on the curve, whose chords stay within `tolerance` mm of it. The points of
/// the file are kept as marks. Adds an error where there is no such curve.
pub(super) fn trace(pattern: &mut Pattern, tolerance: f64, sewing: &Sewing, out: &mut Diagnostics) {
    for seam in &mut pattern.seams {
        let traced = match seam.shape {
            Shape::Line => continue,
            Shape::Arc => arc(&seam.points, tolerance),
            Shape::Circle => circle(seam, tolerance, sewing),
        };
        match traced {
            Ok(points) => seam.marks = std::mem::replace(&mut seam.points, points),
            Err(message) => out.push(Diagnostic::new(&code::SEW_ELEMENT, message).at(seam.span)),
        }
    }
}

/// An arc from the first to the third of three points, through the second.
fn arc(points: &[Point], tolerance: f64) -> Result<Vec<Point>, String> {
    let [start, middle, end] = *points else {
        return Err(format!("an arc has a start, a point on it and an end, and this has {} points", points.len()));
    };
    let (a, b) = (middle - start, end - start);
    let area = cross(a, b);
    if area.abs() <= STRAIGHT_EPSILON * a.norm() * b.norm().max((end - middle).norm()) {
        return Err("the three points of an arc lie on a straight line".to_owned());
    }
    // Circumcentre, from the start.
    let (a2, b2) = (a.norm_squared(), b.norm_squared());
    let centre =
        Point::new(start.x + (b.y * a2 - a.y * b2) / (2.0 * area), start.y + (a.x * b2 - b.x * a2) / (2.0 * area));
    let (from, to) = (start - centre, end - centre);
    let turn = cross(from, to).atan2(from.dot(&to)).rem_euclid(std::f64::consts::TAU);
    let turn = if area > 0.0 { turn } else { turn - std::f64::consts::TAU };
    Ok(around(centre, start, (turn, end), tolerance))
}

/// A whole turn anticlockwise around the first of two points, from the second.
fn circle(seam: &Seam, tolerance: f64, sewing: &Sewing) -> Result<Vec<Point>, String> {
    let [centre, start] = seam.points[..] else {
        let count = seam.points.len();
        return Err(format!("a circle has a centre and a point on it, and this has {count} points"));
    };
    let radius = (start - centre).norm();
    let half = seam.width.unwrap_or(sewing.tack_width_mm) / 2.0;
    if seam.element == Element::Eyelet && radius <= half + SAME_EPSILON {
        return Err(format!("an eyelet of radius {radius} mm has no hole: half its width is {half} mm"));
    }
    let usual = if seam.element == Element::Zigzag { sewing.zigzag_pitch_mm } else { sewing.pitch_mm };
    let pitch = if seam.element == Element::Eyelet { usual } else { seam.pitch.unwrap_or(usual) };
    if std::f64::consts::TAU * radius < FEWEST * pitch {
        return Err(format!("a circle of radius {radius} mm is too small for three stitches of {pitch} mm"));
    }
    Ok(around(centre, start, (std::f64::consts::TAU, start), tolerance))
}

/// Points on a circle from `start`, after a turn to `end`.
fn around(centre: Point, start: Point, (turn, end): (f64, Point), tolerance: f64) -> Vec<Point> {
    let from = start - centre;
    // The middle of a chord lies r (1 - cos(turn / 2)) inside its arc.
    let chord = 2.0 * (1.0 - tolerance / from.norm()).clamp(-1.0, 1.0).acos();
    let count = (turn.abs() / chord.min(MOST_TURN)).ceil().max(1.0);
    let place = |i: usize| {
        let along = Rotation(turn * i as f64 / count).unit();
        centre + along * from.x + crate::geom::left(along) * from.y
    };
    std::iter::once(start).chain((1..count as usize).map(place)).chain([end]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_arc_passes_its_middle_point_either_way_round() {
        let points = |middle: f64| [[1.0, 0.0], [0.0, middle], [-1.0, 0.0]].map(|[x, y]| Point::new(x, y));
        for side in [1.0, -1.0] {
            let traced = arc(&points(side), 0.01).expect("an arc");
            assert!(traced.iter().all(|point| (point.coords.norm() - 1.0).abs() < 1e-9 && point.y * side > -1e-9));
            assert_eq!([traced[0], traced[traced.len() - 1]], [points(side)[0], points(side)[2]]);
        }
        assert!(arc(&points(0.0), 0.01).is_err());
    }
}
