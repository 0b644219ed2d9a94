//! Corners of a polyline with rounded points. A turn is a corner only if rounding cannot produce it.

use super::{Point, angle, polyline};

/// Distances from a vertex to the neighbours that are compared, in units of the rounding. Points closer together turn by
/// rounding alone.
const WINDOWS: [f64; 3] = [3.0, 6.0, 12.0];
/// Minimum height of a corner above the line between its neighbours, in units. Rounding alone gives up to sqrt(2): three points
/// of a straight line, each off by half a diagonal of the unit.
const HEIGHT: f64 = 1.5;
/// Maximum number of points examined on either side. It bounds the cost of a line that goes to and fro on the spot.
const LOOK: usize = 64;

/// True if a polyline turns at a point by more than `limit` rad. `before` and `behind` are its other points, walking back and
/// on from there. All points are rounded to multiples of `unit` mm (0 = not rounded).
///
/// A curve drawn with points as close as its unit climbs in steps that each turn by 45 degrees or more. There a corner must
/// also turn when seen from neighbours farther away, and must stand out by more than rounding.
pub fn is_corner(
    at: Point,
    before: &(impl Iterator<Item = Point> + Clone),
    behind: &(impl Iterator<Item = Point> + Clone),
    limit: f64,
    unit: f64,
) -> bool {
    let turns = |from: Point, to: Point| angle::is_turned(at - from, to - at, limit);
    let (Some(from), Some(to)) = (before.clone().next(), behind.clone().next()) else { return false };
    if !turns(from, to) {
        return false;
    }
    let far = WINDOWS[WINDOWS.len() - 1] * unit;
    let is_far = |point: Point, reach: f64| (point - at).norm() >= reach;
    if is_far(from, far) && is_far(to, far) {
        return true;
    }
    WINDOWS.iter().map(|window| window * unit).any(|reach| {
        let [from, to] = [
            neighbour(before.clone(), |point| is_far(point, reach)),
            neighbour(behind.clone(), |point| is_far(point, reach)),
        ];
        from.zip(to)
            .is_some_and(|(from, to)| turns(from, to) && polyline::distance_to_segment(at, from, to) > HEIGHT * unit)
    })
}

/// The first point that is far enough, or the last of the first `LOOK` points.
fn neighbour(points: impl Iterator<Item = Point> + Clone, is_far: impl Fn(Point) -> bool) -> Option<Point> {
    let near = points.take(LOOK);
    near.clone().find(|&point| is_far(point)).or_else(|| near.last())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The vertices of a polyline that are corners of more than 45 degrees.
    fn corners(points: &[(f64, f64)], unit: f64) -> Vec<usize> {
        let points: Vec<Point> = points.iter().map(|&(x, y)| Point::new(x, y)).collect();
        let is_corner = |&i: &usize| {
            let (before, behind) = (points[..i].iter().rev().copied(), points[i + 1..].iter().copied());
            is_corner(points[i], &before, &behind, std::f64::consts::FRAC_PI_4, unit)
        };
        (1..points.len() - 1).filter(is_corner).collect()
    }

    #[test]
    fn steps_of_rounding_are_no_corners_and_small_notches_are() {
        // A slanted line in steps of one unit.
        let steps: Vec<(f64, f64)> =
            (0..40).map(|i| (f64::from(i / 2 + i % 2) * 0.1, f64::from(i / 2) * 0.1)).collect();
        assert!(corners(&steps, 0.1).is_empty());
        assert_eq!(corners(&steps, 0.0).len(), 38);
        // A V three units high, and a right angle between points three units apart.
        assert_eq!(corners(&[(0.0, 0.0), (6.0, 0.0), (6.4, 0.3), (6.8, 0.0), (9.0, 0.0)], 0.1), [2]);
        let dense: Vec<(f64, f64)> = (0..20)
            .map(|i| 0.3 * f64::from(i))
            .map(|way| if way < 3.0 { (way, 0.0) } else { (3.0, way - 3.0) })
            .collect();
        assert_eq!(corners(&dense, 0.1), [10]);
        // Two points of a corner that are one unit apart.
        assert_eq!(corners(&[(0.0, 0.0), (5.0, 0.0), (5.1, 0.0), (5.1, 9.0)], 0.1), [2]);
    }
}
