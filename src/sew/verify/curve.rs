//! Checks that the line of an arc or circle is on the curve that the marks of the file give.

use super::ground::sighting;
use super::rules;
use crate::geom::{Point, Vector};
use crate::ir::verdict::WorstByRule;
use crate::sew::pattern::{Pattern, Seam, Shape};

/// Rounding of the sum of angles of a whole turn, rad.
const TURN_EPSILON: f64 = 1e-6;

/// Compares each curve as drawn with its marks. `tolerance` is the permitted deviation, mm.
pub(super) fn judge(drawn: &Pattern, tolerance: f64, worst: &mut WorstByRule) {
    for seam in drawn.seams.iter().filter(|seam| seam.shape != Shape::Line) {
        let off = deviation(seam).unwrap_or(f64::INFINITY);
        let place = seam.points.first().copied().unwrap_or(Point::origin());
        worst.see(&rules::CURVE, off - tolerance, sighting(0, place));
    }
}

/// Greatest distance of the line from its curve, mm; `None` if the line does not run from mark to mark.
fn deviation(seam: &Seam) -> Option<f64> {
    let (line, first, last) = (&seam.points, *seam.points.first()?, *seam.points.last()?);
    let (centre, passed) = match (seam.shape, &seam.marks[..]) {
        (Shape::Circle, &[centre, start]) if first == start && last == start => (centre, start),
        (Shape::Arc, &[start, middle, end]) if first == start && last == end => (middle_of(start, middle, end), middle),
        _ => return None,
    };
    let radius = (passed - centre).norm();
    let off = |point: Point| ((point - centre).norm() - radius).abs();
    let chords = || line.windows(2).map(|pair| (pair[0], pair[1]));
    // Chords that go on in one direction, and round the centre once at the most.
    let turn = |from: Vector, to: Vector| (from.x * to.y - from.y * to.x).atan2(from.dot(&to));
    let turns: Vec<f64> = chords().map(|(a, b)| turn(a - centre, b - centre)).collect();
    let (sum, parts): (f64, f64) = (turns.iter().sum(), turns.iter().map(|turn| turn.abs()).sum());
    let is_once = match seam.shape {
        Shape::Circle => (sum - std::f64::consts::TAU).abs() <= TURN_EPSILON,
        Shape::Arc | Shape::Line => parts < std::f64::consts::TAU,
    };
    if !is_once || parts > sum.abs() + TURN_EPSILON {
        return None;
    }
    let at_mark = chords().map(|(a, b)| beside(passed, a, b)).fold(f64::INFINITY, f64::min);
    Some(chords().map(|(a, b)| off(b).max(off(a + (b - a) / 2.0))).fold(at_mark, f64::max))
}

/// The point at the same distance from three others: where the bisectors of two chords meet.
fn middle_of(a: Point, b: Point, c: Point) -> Point {
    let (first, second) = (b - a, c - b);
    let across = Vector::new(-first.y, first.x);
    let (from, to) = (a + first / 2.0, b + second / 2.0);
    from + across * ((to - from).dot(&second) / across.dot(&second))
}

/// Distance of a point from a chord, mm.
fn beside(point: Point, a: Point, b: Point) -> f64 {
    let way = b - a;
    let along = ((point - a).dot(&way) / way.norm_squared().max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
    (point - a - way * along).norm()
}
