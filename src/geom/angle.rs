//! Two kinds of angle that must never be mixed: a direction and the position of a rotary axis.

use std::f64::consts::{PI, TAU};

use super::Vector;

/// Relative tolerance of comparisons of angles, for rounding.
const SURE_EPSILON: f64 = 1e-9;

/// A direction in the plane: an angle modulo one turn, kept in `[0, 2 pi)` rad, 0 along +X, counter-clockwise.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Heading(f64);

/// Position of a rotary axis: an unwrapped angle, rad. 0 and 2 pi are different positions.
#[derive(Debug, Clone, Copy, PartialEq, PartialOrd, Default)]
pub struct Rotation(pub f64);

impl Heading {
    /// The heading at `radians` from +X; full turns are removed.
    pub fn new(radians: f64) -> Self {
        let wrapped = radians.rem_euclid(TAU);
        // `rem_euclid` of a tiny negative number rounds up to a full turn.
        Self(if wrapped >= TAU { 0.0 } else { wrapped })
    }

    /// The heading of a vector; 0 for the zero vector.
    pub fn of(vector: Vector) -> Self {
        Self::new(vector.y.atan2(vector.x))
    }

    /// The angle in `[0, 2 pi)`, rad.
    pub fn radians(self) -> f64 {
        self.0
    }

    /// Unit vector in this direction.
    pub fn unit(self) -> Vector {
        let (sin, cos) = self.0.sin_cos();
        Vector::new(cos, sin)
    }

    /// The signed turn from `self` to `other`, rad, in `(-pi, pi]`.
    pub fn turn_to(self, other: Self) -> f64 {
        wrap(other.0 - self.0)
    }
}

impl Rotation {
    /// Direction that the axis points in at this position.
    pub fn heading(self) -> Heading {
        Heading::new(self.0)
    }

    /// Unit vector in that direction.
    pub fn unit(self) -> Vector {
        let (sin, cos) = self.0.sin_cos();
        Vector::new(cos, sin)
    }

    /// The position nearest to `self` at which the axis points in the direction `heading`.
    #[must_use]
    pub fn nearest(self, heading: Heading) -> Self {
        Self(self.0 + self.heading().turn_to(heading))
    }
}

/// An angle reduced to `(-pi, pi]`, rad.
pub fn wrap(radians: f64) -> f64 {
    let wrapped = radians - TAU * (radians / TAU).round();
    if wrapped <= -PI { wrapped + TAU } else { wrapped }
}

/// The signed turn from the direction of `a` to that of `b`, rad, in `(-pi, pi]`.
pub fn turn(a: Vector, b: Vector) -> f64 {
    super::cross(a, b).atan2(a.dot(&b))
}

/// True if the directions of `a` and `b` differ by more than `limit` rad, either way. An angle of exactly `limit`, such as a
/// bend of 45 degrees, does not count, however its points were rounded. Most angles are far from the limit, so the angle itself
/// is rarely computed.
pub fn is_turned(a: Vector, b: Vector, limit: f64) -> bool {
    let (sine, cosine) = (super::cross(a, b).abs(), a.dot(&b));
    // An angle is less than its tangent and greater than its sine.
    if sine < limit * (1.0 - SURE_EPSILON) * cosine {
        return false;
    }
    let is_more = (cosine < 0.0 && limit < 1.0)
        || sine * sine > limit * limit * (1.0 + SURE_EPSILON).powi(2) * a.norm_squared() * b.norm_squared();
    is_more || turn(a, b).abs() > limit * (1.0 + SURE_EPSILON)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_heading_stays_below_one_turn() {
        assert_eq!(Heading::new(-1e-30).radians(), 0.0);
        assert_eq!(Heading::new(TAU).radians(), 0.0);
        assert!((Heading::new(-PI / 2.0).radians() - 1.5 * PI).abs() < 1e-12);
    }

    #[test]
    fn what_is_turned_by_more_is_told_at_the_limit_too() {
        let along = Heading::new(0.4).unit();
        for limit in [1e-6, 0.1, 1.0, 2.0, 3.0] {
            for turned in [-1.001, -1.0, -0.999, 0.0, 0.5, 0.999, 1.0, 1.001].map(|share| share * limit) {
                let other = Heading::new(0.4 + turned).unit() * 3.0;
                assert_eq!(is_turned(along, other, limit), turned.abs() > limit, "{turned} of {limit}");
            }
        }
    }

    #[test]
    fn the_nearest_rotation_is_at_most_half_a_turn_away() {
        let mut c = Rotation(7.0 * TAU + 0.3);
        for step in 0..50 {
            let heading = Heading::new(f64::from(step) * 2.1);
            let next = c.nearest(heading);
            assert!((next.0 - c.0).abs() <= PI + 1e-9);
            assert!(next.heading().turn_to(heading).abs() < 1e-9);
            c = next;
        }
    }
}
