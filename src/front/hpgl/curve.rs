//! Arcs and Bezier curves as chords, in units of the plotter.

use std::f64::consts::TAU;

use super::scale::Pair;

/// The most chords of one curve: a damaged number must not fill the memory.
const MOST_CHORDS: f64 = 100_000.0;

/// An arc.
#[derive(Debug, Clone, Copy)]
pub(super) struct Arc {
    pub(super) from: Pair,
    pub(super) centre: Pair,
    /// rad, counter-clockwise positive; more than a full turn is a full turn.
    pub(super) sweep: f64,
}

impl Arc {
    /// The ends of its chords, none farther from it than `sagitta`. A full turn ends where it starts, to the bit.
    pub(super) fn flatten(&self, sagitta: f64) -> impl Iterator<Item = Pair> + use<> {
        let Self { from, centre, sweep } = *self;
        let start = [from[0] - centre[0], from[1] - centre[1]];
        let radius = start[0].hypot(start[1]);
        let is_full = sweep.abs() >= TAU;
        let sweep = sweep.clamp(-TAU, TAU);
        // The sagitta of a chord over the angle a is r (1 - cos(a / 2)).
        let step = 2.0 * (1.0 - (sagitta / radius).min(0.5)).acos();
        let chords =
            if radius > 0.0 && sweep != 0.0 { (sweep.abs() / step).ceil().clamp(1.0, MOST_CHORDS) } else { 0.0 };
        let zero = start[1].atan2(start[0]);
        (1..=chords as u32).map(move |i| {
            if is_full && f64::from(i) == chords {
                return from;
            }
            let (sin, cos) = (zero + sweep * f64::from(i) / chords).sin_cos();
            [centre[0] + radius * cos, centre[1] + radius * sin]
        })
    }

    /// The arc from `from` by way of `middle` to `to`; `None` when the three lie on a line.
    pub(super) fn through(from: Pair, middle: Pair, to: Pair) -> Option<Self> {
        if from == to && middle != from {
            // A full circle: the middle lies opposite.
            let centre = [f64::midpoint(from[0], middle[0]), f64::midpoint(from[1], middle[1])];
            return Some(Self { from, centre, sweep: TAU });
        }
        let (a, b) = ([middle[0] - from[0], middle[1] - from[1]], [to[0] - from[0], to[1] - from[1]]);
        let doubled = 2.0 * (a[0] * b[1] - a[1] * b[0]);
        let (square_a, square_b) = (a[0] * a[0] + a[1] * a[1], b[0] * b[0] + b[1] * b[1]);
        let centre = [
            from[0] + (b[1] * square_a - a[1] * square_b) / doubled,
            from[1] + (a[0] * square_b - b[0] * square_a) / doubled,
        ];
        if !(centre[0].is_finite() && centre[1].is_finite()) {
            return None;
        }
        let angle = |p: Pair| (p[1] - centre[1]).atan2(p[0] - centre[0]);
        let turned = (angle(to) - angle(from)).rem_euclid(TAU);
        // Counter-clockwise when the end lies left of the way from the start to the middle.
        Some(Self { from, centre, sweep: if doubled > 0.0 { turned } else { turned - TAU } })
    }
}

/// A cubic Bezier curve by its four control points.
#[derive(Debug, Clone, Copy)]
pub(super) struct Bezier(pub(super) [Pair; 4]);

impl Bezier {
    /// The ends of its chords, none farther from it than `sagitta`, the last one exact. Their number is Wang's bound for
    /// equal steps: the root of 6 m / (8 s), m the greatest second difference of the control points. (Wang, "The
    /// subdivision method for finding the intersection between two Bezier curves or surfaces", 1984.)
    pub(super) fn flatten(&self, sagitta: f64) -> impl Iterator<Item = Pair> + use<> {
        let p = self.0;
        let second = |i: usize| {
            let bend = |axis: usize| p[i][axis] - 2.0 * p[i + 1][axis] + p[i + 2][axis];
            bend(0).hypot(bend(1))
        };
        let chords = (6.0 * second(0).max(second(1)) / (8.0 * sagitta)).sqrt().ceil().clamp(1.0, MOST_CHORDS);
        (1..=chords as u32).map(move |i| {
            if f64::from(i) == chords {
                return p[3];
            }
            let t = f64::from(i) / chords;
            let u = 1.0 - t;
            let at = |axis: usize| {
                u * u * u * p[0][axis] + 3.0 * u * t * (u * p[1][axis] + t * p[2][axis]) + t * t * t * p[3][axis]
            };
            [at(0), at(1)]
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SAGITTA: f64 = 0.5;

    fn length(from: Pair, points: impl Iterator<Item = Pair>) -> f64 {
        let mut at = from;
        points.fold(0.0, |sum, to| {
            let step = (to[0] - at[0]).hypot(to[1] - at[1]);
            at = to;
            sum + step
        })
    }

    #[test]
    fn chords_keep_to_the_arc_and_end_on_it() {
        let check = |arc: Arc, around: f64| {
            let radius = arc.from[0].hypot(arc.from[1]);
            let points: Vec<Pair> = arc.flatten(SAGITTA).collect();
            assert!(points.iter().all(|p| (p[0].hypot(p[1]) - radius).abs() < 1e-9), "{arc:?}");
            let found = length(arc.from, points.into_iter());
            assert!((found - around).abs() < 1e-2 * around && found <= around, "{found} instead of {around}");
        };
        let from = [1000.0, 0.0];
        check(Arc { from, centre: [0.0, 0.0], sweep: TAU / 4.0 }, 1000.0 * TAU / 4.0);
        check(Arc { from, centre: [0.0, 0.0], sweep: -3.0 * TAU }, 1000.0 * TAU);
        let full: Vec<Pair> = Arc { from, centre: [0.0, 0.0], sweep: TAU }.flatten(SAGITTA).collect();
        assert_eq!(full.last(), Some(&from));
        assert_eq!(Arc { from, centre: from, sweep: 1.0 }.flatten(SAGITTA).count(), 0);
    }

    #[test]
    fn three_points_make_an_arc() {
        let arc = Arc::through([1000.0, 0.0], [0.0, 1000.0], [-1000.0, 0.0]).expect("an arc");
        assert!(arc.centre[0].hypot(arc.centre[1]) < 1e-9 && (arc.sweep - TAU / 2.0).abs() < 1e-9, "{arc:?}");
        let arc = Arc::through([1000.0, 0.0], [0.0, -1000.0], [0.0, 1000.0]).expect("an arc");
        assert!((arc.sweep + 0.75 * TAU).abs() < 1e-9, "{arc:?}");
        assert!(Arc::through([0.0, 0.0], [1.0, 1.0], [2.0, 2.0]).is_none());
    }

    #[test]
    fn a_bezier_is_as_long_as_its_arc() {
        // A quarter of a circle, 0.5523 of the radius to each control point.
        let quarter = Bezier([[1000.0, 0.0], [1000.0, 552.3], [552.3, 1000.0], [0.0, 1000.0]]);
        let found = length([1000.0, 0.0], quarter.flatten(0.01));
        assert!((found - 1000.0 * TAU / 4.0).abs() < 0.5, "{found}");
        let straight = Bezier([[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [3.0, 0.0]]);
        assert_eq!(straight.flatten(0.01).collect::<Vec<_>>(), [[3.0, 0.0]]);
    }
}
