//! Transform lists of SVG, combined to one map.

use svgtypes::{TransformListParser, TransformListToken};

use crate::geom::affine::Affine;
use crate::geom::{Point, Vector};
use crate::units::rad;

/// A point or a vector, in units of the file or in mm.
pub(super) type Pair = [f64; 2];

/// Image of a point.
pub(super) fn placed(map: &Affine, [x, y]: Pair) -> Pair {
    map.point(Point::new(x, y)).into()
}

/// Image of a vector.
pub(super) fn led(map: &Affine, [x, y]: Pair) -> Pair {
    map.vector(Vector::new(x, y)).into()
}

/// The map of a list of transforms, the first of them outermost; `None` if the list is malformed.
pub(super) fn transform(text: &str) -> Option<Affine> {
    let mut map = Affine::IDENTITY;
    for token in TransformListParser::from(text) {
        let next = match token.ok()? {
            TransformListToken::Matrix { a, b, c, d, e, f } => Affine::matrix([a, b, c, d, e, f]),
            TransformListToken::Translate { tx, ty } => Affine::shift(Vector::new(tx, ty)),
            TransformListToken::Scale { sx, sy } => Affine::scale(sx, sy),
            TransformListToken::Rotate { angle } => Affine::turn(rad(angle)),
            TransformListToken::SkewX { angle } => Affine::slant(rad(angle), 0.0),
            TransformListToken::SkewY { angle } => Affine::slant(0.0, rad(angle)),
        };
        map = next.then(&map);
    }
    Some(map).filter(Affine::is_finite)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn transforms_map_from_the_innermost_outwards() {
        let check = |text: &str, to: Pair| {
            let found = placed(&transform(text).expect("a transform"), [3.0, 4.0]);
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
            assert_eq!(transform(text), None, "{text}");
        }
    }
}
