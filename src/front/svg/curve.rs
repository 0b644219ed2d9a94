//! Conversion of curves to chords, in mm.

use std::f64::consts::TAU;

use super::path::Arc;
use super::transform::{Pair, led, placed};
use crate::geom::affine::Affine;

/// Maximum number of chords of one curve, so that a damaged number cannot exhaust the memory.
const MOST_CHORDS: f64 = 100_000.0;

/// A curve, mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Curve {
    /// Control points of a cubic Bezier curve.
    Cubic([Pair; 4]),
    /// Arc of an ellipse.
    Elliptic(Elliptic),
}

/// Arc of an ellipse: `centre + cos(a) first + sin(a) second`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Elliptic {
    pub(super) centre: Pair,
    /// Two conjugate semi-axes.
    pub(super) axes: [Pair; 2],
    /// Start angle, rad.
    pub(super) start: f64,
    /// Sweep, rad.
    pub(super) sweep: f64,
    /// Exact end point.
    pub(super) to: Pair,
}

impl Curve {
    /// Number of chords of equal steps within `sagitta` mm of the curve.
    pub(super) fn chords(&self, sagitta: f64) -> usize {
        let needed = match self {
            // Wang's bound: the square root of 6 m / (8 s), with m the maximum second difference of the control points.
            Self::Cubic(p) => {
                let bend = |i: usize, axis: usize| p[i][axis] - 2.0 * p[i + 1][axis] + p[i + 2][axis];
                let second = |i: usize| bend(i, 0).hypot(bend(i, 1));
                (0.75 * second(0).max(second(1)) / sagitta).sqrt()
            }
            // A chord over the step a deviates by at most r (1 - cos(a / 2)), with r the semi-major axis.
            Self::Elliptic(arc) => {
                let share = sagitta / longest(arc.axes);
                let step = if share < 1.0 { 4.0 * (share / 2.0).sqrt().asin() } else { TAU / 4.0 };
                arc.sweep.abs() / step.min(TAU / 4.0)
            }
        };
        // NaN gives one chord.
        if needed.is_nan() { 1 } else { needed.ceil().clamp(1.0, MOST_CHORDS) as usize }
    }

    /// Point at the end of a chord, counted from 1.
    pub(super) fn place(&self, chord: usize, chords: usize) -> Pair {
        let share = chord as f64 / chords as f64;
        match self {
            Self::Cubic(p) if chord == chords => p[3],
            Self::Elliptic(arc) if chord == chords => arc.to,
            Self::Cubic(p) => {
                let (t, u) = (share, 1.0 - share);
                [0, 1].map(|axis| {
                    u * u * u * p[0][axis] + 3.0 * u * t * (u * p[1][axis] + t * p[2][axis]) + t * t * t * p[3][axis]
                })
            }
            Self::Elliptic(arc) => {
                let (sin, cos) = (arc.start + share * arc.sweep).sin_cos();
                [0, 1].map(|axis| arc.centre[axis] + cos * arc.axes[0][axis] + sin * arc.axes[1][axis])
            }
        }
    }
}

/// Semi-major axis of the ellipse with two conjugate semi-axes: the larger singular value of their matrix, mm.
fn longest([u, v]: [Pair; 2]) -> f64 {
    let (sum, product) = (u[0] * u[0] + u[1] * u[1] + v[0] * v[0] + v[1] * v[1], u[0] * v[1] - u[1] * v[0]);
    f64::midpoint(sum, ((sum + 2.0 * product) * (sum - 2.0 * product)).max(0.0).sqrt()).sqrt()
}

/// The arc of a path from its start point, in mm. `None` for a straight line; an arc with a zero radius is one (SVG 2, B.2).
pub(super) fn arc(from: Pair, arc: Arc, map: Affine) -> Option<Curve> {
    let Arc { radii, turn, is_large, is_growing, to } = arc;
    let [rx, ry] = radii.map(f64::abs);
    if rx == 0.0 || ry == 0.0 || from == to {
        return None;
    }
    let (sin, cos) = turn.to_radians().sin_cos();
    // Half the vector between the ends, in coordinates in which the ellipse is a unit circle.
    let half = [(from[0] - to[0]) / 2.0, (from[1] - to[1]) / 2.0];
    let unit = [(cos * half[0] + sin * half[1]) / rx, (cos * half[1] - sin * half[0]) / ry];
    let square = unit[0] * unit[0] + unit[1] * unit[1];
    // Radii so large that the square underflows give a straight line.
    if square == 0.0 {
        return None;
    }
    // An ellipse too small to reach both ends is enlarged until it does.
    let grown = square.sqrt().max(1.0);
    let height = if square < 1.0 { ((1.0 - square) / square).sqrt() } else { 0.0 };
    let side = if is_large == is_growing { -height } else { height };
    let middle = [side * unit[1], -side * unit[0]];
    let angle = |sign: f64| (sign * unit[1] - middle[1]).atan2(sign * unit[0] - middle[0]);
    let (start, end) = (angle(1.0), angle(-1.0));
    let turned = (end - start).rem_euclid(TAU);
    let sweep = if is_growing { turned } else { turned - TAU };
    let axes = [[rx * grown * cos, rx * grown * sin], [-ry * grown * sin, ry * grown * cos]];
    // The centre of an enlarged ellipse is the midpoint of the ends.
    let centre = [0, 1].map(|axis| {
        f64::midpoint(from[axis], to[axis]) + (middle[0] * axes[0][axis] + middle[1] * axes[1][axis]) / grown
    });
    let [centre, to] = [centre, to].map(|at| placed(&map, at));
    Some(Curve::Elliptic(Elliptic { centre, axes: axes.map(|axis| led(&map, axis)), start, sweep, to }))
}

#[cfg(test)]
mod tests {
    use super::*;

    const SAGITTA: f64 = 0.01;

    fn check(curve: &Curve) {
        // Each chord is compared with points of the curve between its ends.
        let chords = curve.chords(SAGITTA);
        for chord in 0..chords {
            let [a, b] = [chord, chord + 1].map(|chord| curve.place(chord, chords));
            for k in 1..16 {
                let p = curve.place(16 * chord + k, 16 * chords);
                let (way, off) = ([b[0] - a[0], b[1] - a[1]], [p[0] - a[0], p[1] - a[1]]);
                let distance = (way[0] * off[1] - way[1] * off[0]).abs() / way[0].hypot(way[1]);
                assert!(distance <= SAGITTA * 1.000_001, "{curve:?}: {distance}");
            }
        }
    }

    #[test]
    fn chords_keep_to_their_curve() {
        let mut random = fastrand::Rng::with_seed(1);
        for _ in 0..200 {
            let mut number = |most: f64| most * (2.0 * random.f64() - 1.0);
            let mut pair = || [number(300.0), number(300.0)];
            check(&Curve::Cubic([pair(), pair(), pair(), pair()]));
            let (from, radii, to) = (pair(), pair(), pair());
            let map = Affine::matrix([1.0, 0.3, -0.8, 0.5, 3.0, 4.0]);
            let flags = [number(1.0) > 0.0, number(1.0) > 0.0];
            let [is_large, is_growing] = flags;
            let asked = Arc { radii, turn: number(180.0), is_large, is_growing, to };
            let found = arc(from, asked, map).expect("an arc");
            check(&found);
            let off = |a: Pair, b: Pair| (a[0] - b[0]).hypot(a[1] - b[1]);
            assert!(off(found.place(0, 7), placed(&map, from)) < 1e-9);
            let Curve::Elliptic(elliptic) = found else { panic!("an arc is elliptic") };
            let (sin, cos) = (elliptic.start + elliptic.sweep).sin_cos();
            let end = [0, 1].map(|i| elliptic.centre[i] + cos * elliptic.axes[0][i] + sin * elliptic.axes[1][i]);
            assert!(off(end, elliptic.to) < 1e-9, "{found:?}");
            let half = elliptic.sweep.abs() - TAU / 2.0;
            assert!(half.abs() < 1e-6 || (half > 0.0) == is_large, "{found:?}");
            assert_eq!(elliptic.sweep > 0.0, is_growing);
        }
    }

    #[test]
    fn an_arc_without_a_radius_or_a_way_is_none() {
        let asked = |radii, to| Arc { radii, turn: 0.0, is_large: true, is_growing: true, to };
        assert_eq!(arc([0.0; 2], asked([0.0, 5.0], [1.0, 1.0]), Affine::IDENTITY), None);
        assert_eq!(arc([0.0; 2], asked([5.0, 5.0], [0.0, 0.0]), Affine::IDENTITY), None);
    }
}
