//! Affine maps of the plane, as insertions and transforms of drawings apply them.

use nalgebra::Matrix2;

use super::{Point, Vector};

/// An affine map of points: a linear part and a translation, mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Affine {
    linear: Matrix2<f64>,
    shift: Vector,
}

impl Affine {
    /// The identity map.
    pub const IDENTITY: Self = Self { linear: Matrix2::new(1.0, 0.0, 0.0, 1.0), shift: Vector::new(0.0, 0.0) };

    /// The linear map that takes the unit vectors along X and Y to the given vectors.
    pub fn of([x, y]: [Vector; 2]) -> Self {
        Self { linear: Matrix2::from_columns(&[x, y]), ..Self::IDENTITY }
    }

    /// The map `x' = a x + c y + e`, `y' = b x + d y + f` with the given six coefficients.
    pub fn matrix([a, b, c, d, e, f]: [f64; 6]) -> Self {
        Self { linear: Matrix2::new(a, c, b, d), shift: Vector::new(e, f) }
    }

    /// A translation by a vector, mm.
    pub fn shift(by: Vector) -> Self {
        Self { shift: by, ..Self::IDENTITY }
    }

    /// A scaling along each axis; negative factors mirror.
    pub fn scale(x: f64, y: f64) -> Self {
        Self { linear: Matrix2::new(x, 0.0, 0.0, y), ..Self::IDENTITY }
    }

    /// A rotation about the origin, rad, counter-clockwise positive. Quarter turns are exact.
    pub fn turn(angle: f64) -> Self {
        let (sin, cos) = exact_sin_cos(angle);
        Self { linear: Matrix2::new(cos, -sin, sin, cos), ..Self::IDENTITY }
    }

    /// A shear: x grows by the tangent of the first angle per unit of y, and y by the tangent of the second per unit of x, rad.
    pub fn slant(x: f64, y: f64) -> Self {
        Self { linear: Matrix2::new(1.0, x.tan(), y.tan(), 1.0), ..Self::IDENTITY }
    }

    /// The composition of two maps: `self` first, then `next`.
    #[must_use]
    pub fn then(&self, next: &Self) -> Self {
        Self { linear: next.linear * self.linear, shift: next.linear * self.shift + next.shift }
    }

    /// Image of a point.
    pub fn point(&self, at: Point) -> Point {
        Point::from(self.linear * at.coords + self.shift)
    }

    /// Image of a displacement.
    pub fn vector(&self, way: Vector) -> Vector {
        self.linear * way
    }

    /// Largest factor by which the map lengthens a vector: the greater singular value of its linear part.
    pub fn stretch(&self) -> f64 {
        let [a, c, b, d] = [self.linear.m11, self.linear.m21, self.linear.m12, self.linear.m22];
        f64::midpoint((a + d).hypot(c - b), (a - d).hypot(c + b))
    }

    /// True if the map mirrors: left becomes right.
    pub fn mirrors(&self) -> bool {
        self.linear.determinant() < 0.0
    }

    /// True if all coefficients are finite.
    pub fn is_finite(&self) -> bool {
        self.linear.iter().chain(self.shift.iter()).all(|number| number.is_finite())
    }
}

/// Sine and cosine of an angle, rad. Quarter turns are exact: the rounding of pi does not show.
fn exact_sin_cos(angle: f64) -> (f64, f64) {
    let quarters = angle / std::f64::consts::FRAC_PI_2;
    if (quarters - quarters.round()).abs() > f64::EPSILON * quarters.abs().max(1.0) {
        return angle.sin_cos();
    }
    match quarters.round().rem_euclid(4.0) as u8 {
        0 => (0.0, 1.0),
        1 => (1.0, 0.0),
        2 => (0.0, -1.0),
        _ => (-1.0, 0.0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{FRAC_PI_2, PI};

    #[test]
    fn maps_follow_each_other_in_their_order() {
        let map = Affine::scale(2.0, -1.0).then(&Affine::turn(FRAC_PI_2)).then(&Affine::shift(Vector::new(10.0, 0.0)));
        assert_eq!(map.point(Point::new(3.0, 1.0)), Point::new(11.0, 6.0));
        assert_eq!(map.vector(Vector::new(3.0, 1.0)), Vector::new(1.0, 6.0));
        assert!(map.mirrors() && !Affine::turn(1.0).mirrors());
        assert!((map.stretch() - 2.0).abs() < 1e-12);
    }

    #[test]
    fn the_stretch_of_a_slant_is_that_of_its_longest_way() {
        let map = Affine::turn(0.3).then(&Affine::scale(3.0, 0.5)).then(&Affine::turn(-1.1));
        let longest =
            (0..3600).map(|k| map.vector(Affine::turn(f64::from(k) / 3600.0 * PI).vector(Vector::x())).norm());
        assert!((longest.fold(0.0, f64::max) - map.stretch()).abs() < 1e-5);
    }
}
