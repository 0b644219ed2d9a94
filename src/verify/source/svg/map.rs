//! Affine transforms as two rows of a matrix.

use super::numbers::list;
use crate::geom::{Point, Vector};

/// Rows for x and y: images of the unit of x, the unit of y, and the origin.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Map(pub(super) [[f64; 3]; 2]);

impl Map {
    pub(super) fn shift(x: f64, y: f64) -> Self {
        Self([[1.0, 0.0, x], [0.0, 1.0, y]])
    }

    pub(super) fn scale(x: f64, y: f64) -> Self {
        Self([[x, 0.0, 0.0], [0.0, y, 0.0]])
    }

    /// Product with a map that is applied first.
    pub(super) fn times(self, first: Self) -> Self {
        let cell = |row: [f64; 3], k: usize| {
            let sum = row[0] * first.0[0][k] + row[1] * first.0[1][k];
            if k == 2 { sum + row[2] } else { sum }
        };
        Self(self.0.map(|row| std::array::from_fn(|k| cell(row, k))))
    }

    pub(super) fn at(self, x: f64, y: f64) -> Point {
        let [a, b] = self.0.map(|row| row[0] * x + row[1] * y + row[2]);
        Point::new(a, b)
    }

    pub(super) fn along(self, x: f64, y: f64) -> Vector {
        self.at(x, y) - self.at(0.0, 0.0)
    }

    /// Map of a `transform` attribute; its last transform is applied first.
    pub(super) fn read(text: &str) -> Option<Self> {
        let mut map = Self::shift(0.0, 0.0);
        for call in
            text.split(')').map(|call| call.trim_matches([' ', ',', '\t', '\n', '\r'])).filter(|c| !c.is_empty())
        {
            let (name, numbers) = call.split_once('(')?;
            map = map.times(Self::one(name.trim(), &list(numbers))?);
        }
        Some(map)
    }

    fn one(name: &str, numbers: &[f64]) -> Option<Self> {
        let tangent = |degrees: f64| degrees.to_radians().tan();
        Some(match (name, numbers) {
            ("matrix", &[a, b, c, d, e, f]) => Self([[a, c, e], [b, d, f]]),
            ("translate", &[x]) => Self::shift(x, 0.0),
            ("translate", &[x, y]) => Self::shift(x, y),
            ("scale", &[both]) => Self::scale(both, both),
            ("scale", &[x, y]) => Self::scale(x, y),
            ("rotate", &[degrees]) => {
                let (sin, cos) = degrees.to_radians().sin_cos();
                Self([[cos, -sin, 0.0], [sin, cos, 0.0]])
            }
            ("rotate", &[degrees, x, y]) => {
                Self::shift(x, y).times(Self::one(name, &[degrees])?).times(Self::shift(-x, -y))
            }
            ("skewX", &[degrees]) => Self([[1.0, tangent(degrees), 0.0], [0.0, 1.0, 0.0]]),
            ("skewY", &[degrees]) => Self([[1.0, 0.0, 0.0], [tangent(degrees), 1.0, 0.0]]),
            _ => return None,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_map_acts_first() {
        let check = |text: &str, x: f64, y: f64| {
            let found = Map::read(text).expect("a transform").at(3.0, 4.0);
            assert!((found - Point::new(x, y)).norm() < 1e-12, "{text}: {found:?}");
        };
        check("translate(10,20) scale(2)", 16.0, 28.0);
        check("scale(2),translate(10 20)", 26.0, 48.0);
        check("rotate(90 3 0)", -1.0, 0.0);
        check("matrix(1 2 3 4 5 6)", 20.0, 28.0);
        check("skewX(45)", 7.0, 4.0);
        check("skewY(45)", 3.0, 7.0);
        assert_eq!(Map::read("turn(90)"), None);
    }
}
