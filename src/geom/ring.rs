//! Closed polylines: area and containment. A ring is given by its vertices and may repeat the first one or not.

use super::{Point, Vector, cross};

/// Area, mm2; positive when the ring runs counter-clockwise.
pub fn area(ring: &[Point]) -> f64 {
    let Some(&origin) = ring.first() else { return 0.0 };
    // Relative to a vertex, so that no digits are lost far from the table's origin.
    let mut before = Vector::zeros();
    let doubled = ring[1..].iter().map(|&vertex| {
        let after = vertex - origin;
        cross(std::mem::replace(&mut before, after), after)
    });
    doubled.sum::<f64>() / 2.0
}

/// True if a point lies inside by the even-odd rule: a ray along +X crosses the ring an odd number of times. A point on the
/// ring itself may count either way.
pub fn contains(ring: &[Point], point: Point) -> bool {
    let Some(&last) = ring.last() else { return false };
    let mut inside = false;
    let mut before = last;
    for &after in ring {
        if (before.y > point.y) != (after.y > point.y) {
            let share = (point.y - before.y) / (after.y - before.y);
            inside ^= point.x < before.x + (after.x - before.x) * share;
        }
        before = after;
    }
    inside
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn area_has_the_sign_of_the_direction_and_inside_has_none() {
        let mut ring = [(0.0, 0.0), (4.0, 0.0), (4.0, 2.0), (0.0, 2.0)].map(|(x, y)| Point::new(1e6 + x, y));
        assert_eq!(area(&ring), 8.0);
        let inside = |ring: &[Point]| {
            [(1.0, 1.0), (5.0, 1.0), (-1.0, 1.0), (1.0, 3.0)].map(|(x, y)| contains(ring, Point::new(1e6 + x, y)))
        };
        assert_eq!(inside(&ring), [true, false, false, false]);
        ring.reverse();
        assert_eq!(area(&ring), -8.0);
        assert_eq!(inside(&ring), [true, false, false, false]);
        let repeated = [ring.as_slice(), &ring[..1]].concat();
        assert_eq!((area(&repeated), inside(&repeated)), (-8.0, [true, false, false, false]));
        assert!(area(&[]) == 0.0 && !contains(&[], Point::origin()));
    }
}
