//! Affine maps of the plane: the transforms of SVG.

use svgtypes::{TransformListParser, TransformListToken};

/// A place or a way, in units of the file or in mm.
pub(super) type Pair = [f64; 2];

/// A map: `x' = a x + c y + e`, `y' = b x + d y + f`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Affine(pub(super) [f64; 6]);

impl Affine {
    /// The map that moves nothing.
    pub(super) const NONE: Self = Self([1.0, 0.0, 0.0, 1.0, 0.0, 0.0]);

    /// Moves by a way.
    pub(super) fn moved([x, y]: Pair) -> Self {
        Self([1.0, 0.0, 0.0, 1.0, x, y])
    }

    /// Stretches along both axes.
    pub(super) fn stretched([x, y]: Pair) -> Self {
        Self([x, 0.0, 0.0, y, 0.0, 0.0])
    }

    /// The map that first maps by `inner`.
    #[must_use]
    pub(super) fn after(self, inner: Self) -> Self {
        let [a, b, _, _, _, _] = self.0;
        let [c, d] = [self.0[2], self.0[3]];
        let [p, q, r, s, t, u] = inner.0;
        let [e, f] = self.place([t, u]);
        Self([a * p + c * q, b * p + d * q, a * r + c * s, b * r + d * s, e, f])
    }

    /// Where a place comes to lie.
    pub(super) fn place(self, [x, y]: Pair) -> Pair {
        let [a, b, c, d, e, f] = self.0;
        [a * x + c * y + e, b * x + d * y + f]
    }

    /// Length and direction that a way gets.
    pub(super) fn way(self, [x, y]: Pair) -> Pair {
        let [a, b, c, d, _, _] = self.0;
        [a * x + c * y, b * x + d * y]
    }

    /// Whether all of its numbers are numbers.
    pub(super) fn is_finite(self) -> bool {
        self.0.iter().all(|number| number.is_finite())
    }

    /// A list of transforms, the first of them outermost; `None` of what is no such list.
    pub(super) fn read(text: &str) -> Option<Self> {
        let mut map = Self::NONE;
        for token in TransformListParser::from(text) {
            let next = match token.ok()? {
                TransformListToken::Matrix { a, b, c, d, e, f } => Self([a, b, c, d, e, f]),
                TransformListToken::Translate { tx, ty } => Self::moved([tx, ty]),
                TransformListToken::Scale { sx, sy } => Self::stretched([sx, sy]),
                TransformListToken::Rotate { angle } => {
                    let (sin, cos) = sin_cos(angle);
                    Self([cos, sin, -sin, cos, 0.0, 0.0])
                }
                TransformListToken::SkewX { angle } => Self([1.0, 0.0, angle.to_radians().tan(), 1.0, 0.0, 0.0]),
                TransformListToken::SkewY { angle } => Self([1.0, angle.to_radians().tan(), 0.0, 1.0, 0.0, 0.0]),
            };
            map = map.after(next);
        }
        Some(map).filter(|map| map.is_finite())
    }
}

/// Sine and cosine of an angle in degrees, exact at quarters of a turn.
fn sin_cos(degrees: f64) -> (f64, f64) {
    match degrees.rem_euclid(360.0) {
        0.0 => (0.0, 1.0),
        90.0 => (1.0, 0.0),
        180.0 => (0.0, -1.0),
        270.0 => (-1.0, 0.0),
        _ => degrees.to_radians().sin_cos(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn transforms_map_from_the_innermost_outwards() {
        let check = |text: &str, to: Pair| {
            let found = Affine::read(text).expect("a transform").place([3.0, 4.0]);
            assert!((found[0] - to[0]).hypot(found[1] - to[1]) < 1e-12, "{text}: {found:?}");
        };
        check("", [3.0, 4.0]);
        check("translate(10)", [13.0, 4.0]);
        check("translate(10,20) scale(2)", [16.0, 28.0]);
        check("scale(2) translate(10,20)", [26.0, 48.0]);
        check("scale(-1,1)", [-3.0, 4.0]);
        check("rotate(90)", [-4.0, 3.0]);
        check("rotate(90 3 0)", [-1.0, 0.0]);
        check("skewX(45)", [7.0, 4.0]);
        check("skewY(45)", [3.0, 7.0]);
        check("matrix(1 2 3 4 5 6)", [20.0, 28.0]);
    }

    #[test]
    fn a_list_with_a_fault_is_none() {
        for text in ["rotate(", "scale(1 2 3)", "turn(90)", "matrix(1 2 3)", "translate(1e400)", "scale(a)"] {
            assert_eq!(Affine::read(text), None, "{text}");
        }
    }
}
