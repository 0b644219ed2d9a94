//! Arcs and Bezier curves as chords, in plotter units.
//!
//! Arcs are circular in units of the file; a scale with two factors turns them into ellipses. (Hewlett-Packard, "HP-GL/2 and HP
//! RTL Reference Guide", CI: with anisotropic scaling the figure drawn is an ellipse.)

use std::f64::consts::TAU;

use super::scale::{Pair, Stretch};

/// Maximum number of chords of one curve, so that a damaged number cannot exhaust the memory.
const MOST_CHORDS: f64 = 100_000.0;
/// Height of a triangle, in plotter units, below which its corners are collinear: a hundred times the rounding of coordinates
/// within a kilometre.
const LINE_EPSILON: f64 = 1e-6;

/// An arc of a circle, or of the ellipse that the scale turns it into.
#[derive(Debug, Clone, Copy)]
pub(super) struct Arc {
    pub(super) from: Pair,
    pub(super) centre: Pair,
    /// Sweep, rad, counter-clockwise positive, before the stretch; more than a full turn counts as a full turn.
    pub(super) sweep: f64,
    pub(super) stretch: Stretch,
}

impl Arc {
    /// The ends of its chords, each within `sagitta` of the arc. A full turn ends exactly at its start point.
    pub(super) fn flatten(&self, sagitta: f64) -> impl DoubleEndedIterator<Item = Pair> + use<> {
        let Self { from, centre, sweep, stretch } = *self;
        let start = stretch.undone(centre, from);
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
            [centre[0] + stretch.0[0] * radius * cos, centre[1] + stretch.0[1] * radius * sin]
        })
    }

    /// The arc through three points. `None` if they are collinear, or if the arc deviates from its chord by at most `sagitta`;
    /// the chord then replaces it.
    pub(super) fn through(Through { from, middle, to, stretch }: Through, sagitta: f64) -> Option<Self> {
        let (a, b) = (stretch.undone(from, middle), stretch.undone(from, to));
        let (square_a, square_b) = (a[0] * a[0] + a[1] * a[1], b[0] * b[0] + b[1] * b[1]);
        let epsilon = LINE_EPSILON * stretch.unevenness();
        if square_b.sqrt() <= epsilon && square_a.sqrt() > epsilon {
            // A full circle: the middle point is diametrically opposite.
            let centre = [f64::midpoint(from[0], middle[0]), f64::midpoint(from[1], middle[1])];
            return Some(Self { from, centre, sweep: TAU, stretch });
        }
        let doubled = 2.0 * (a[0] * b[1] - a[1] * b[0]);
        let along = a[0] * b[0] + a[1] * b[1];
        let square_c = square_a + square_b - 2.0 * along;
        // Twice the area of the triangle equals its longest side times its height.
        let height = doubled.abs() / 2.0 / square_a.max(square_b).max(square_c).sqrt();
        // The product of the sides is four times the area times the circumradius; an arc deviates from its chord b by b2 / (8
        // r).
        let deviation = square_b * doubled.abs() / (8.0 * (square_a * square_b * square_c).sqrt());
        let is_between = (0.0..=square_b).contains(&along);
        // Three equal points have no height; it is NaN.
        if height.is_nan() || height <= epsilon || is_between && deviation <= sagitta {
            return None;
        }
        let seen = [(b[1] * square_a - a[1] * square_b) / doubled, (a[0] * square_b - b[0] * square_a) / doubled];
        let angle = |p: Pair| (p[1] - seen[1]).atan2(p[0] - seen[0]);
        let turned = (angle(b) - angle([0.0, 0.0])).rem_euclid(TAU);
        let centre = [from[0] + stretch.0[0] * seen[0], from[1] + stretch.0[1] * seen[1]];
        // Counter-clockwise if the end lies left of the line from the start to the middle point.
        Some(Self { from, centre, sweep: if doubled > 0.0 { turned } else { turned - TAU }, stretch })
    }
}

/// The points of a three-point arc, in order.
#[derive(Debug, Clone, Copy)]
pub(super) struct Through {
    pub(super) from: Pair,
    pub(super) middle: Pair,
    pub(super) to: Pair,
    pub(super) stretch: Stretch,
}

/// A cubic Bezier curve, by its four control points.
#[derive(Debug, Clone, Copy)]
pub(super) struct Bezier(pub(super) [Pair; 4]);

impl Bezier {
    /// The ends of its chords, each within `sagitta` of the curve; the last one is exact. Their number is Wang's bound for
    /// equal steps: the square root of 6 m / (8 s), with m the maximum second difference of the control points. (Wang, "The
    /// subdivision method for finding the intersection between two Bezier curves or surfaces", 1984.)
    pub(super) fn flatten(&self, sagitta: f64) -> impl DoubleEndedIterator<Item = Pair> + use<> {
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
        let arc = |centre, sweep| Arc { from, centre, sweep, stretch: Stretch::NONE };
        check(arc([0.0, 0.0], TAU / 4.0), 1000.0 * TAU / 4.0);
        check(arc([0.0, 0.0], -3.0 * TAU), 1000.0 * TAU);
        let full: Vec<Pair> = arc([0.0, 0.0], TAU).flatten(SAGITTA).collect();
        assert_eq!(full.last(), Some(&from));
        assert_eq!(arc(from, 1.0).flatten(SAGITTA).count(), 0);
    }

    #[test]
    fn a_stretched_arc_is_an_ellipse_and_its_chords_keep_to_it() {
        let through = [[1000.0, 0.0], [0.0, -250.0], [-1000.0, 0.0]];
        for stretch in [[1.0, 0.25], [1.0, -0.25], [-1.0, 0.25]] {
            let (from, stretch) = ([1000.0, 0.0], Stretch(stretch));
            let [_, middle, to] = through;
            let arc = Arc::through(Through { from, middle, to, stretch }, SAGITTA).expect("an arc");
            assert!(arc.centre[0].hypot(arc.centre[1]) < 1e-9 && (arc.sweep.abs() - TAU / 2.0).abs() < 1e-9, "{arc:?}");
            let mut before = from;
            for to in arc.flatten(SAGITTA) {
                assert!(((to[0] / 1000.0).hypot(to[1] / 250.0) - 1.0).abs() < 1e-12 && to[1] < 1e-9, "{to:?}");
                // The deviation of an ellipse from its chord is largest midway between the angles of its ends.
                let (sin, cos) = (before[1] / 250.0 + to[1] / 250.0, before[0] / 1000.0 + to[0] / 1000.0);
                let (sin, cos) = (sin / sin.hypot(cos), cos / sin.hypot(cos));
                let (way, deviation) =
                    ([to[0] - before[0], to[1] - before[1]], [1000.0 * cos - before[0], 250.0 * sin - before[1]]);
                let off = (way[0] * deviation[1] - way[1] * deviation[0]).abs() / way[0].hypot(way[1]);
                assert!(off <= SAGITTA + 1e-9, "{off}");
                before = to;
            }
            assert!((before[0] + 1000.0).abs() < 1e-9);
        }
    }

    #[test]
    fn three_points_make_an_arc() {
        let through = |from, middle, to| Arc::through(Through { from, middle, to, stretch: Stretch::NONE }, SAGITTA);
        let arc = through([1000.0, 0.0], [0.0, 1000.0], [-1000.0, 0.0]).expect("an arc");
        assert!(arc.centre[0].hypot(arc.centre[1]) < 1e-9 && (arc.sweep - TAU / 2.0).abs() < 1e-9, "{arc:?}");
        let arc = through([1000.0, 0.0], [0.0, -1000.0], [0.0, 1000.0]).expect("an arc");
        assert!((arc.sweep + 0.75 * TAU).abs() < 1e-9, "{arc:?}");
        let arc = through([1000.0, 0.0], [-1000.0, 0.0], [1000.0, 0.0]).expect("a circle");
        assert!((arc.sweep - TAU).abs() < 1e-9 && arc.centre == [0.0, 0.0], "{arc:?}");
    }

    #[test]
    fn places_on_a_line_make_no_arc_however_they_are_rounded() {
        let through = |from, middle, to| Arc::through(Through { from, middle, to, stretch: Stretch::NONE }, SAGITTA);
        assert!(through([0.0, 0.0], [1.0, 1.0], [2.0, 2.0]).is_none());
        assert!(through([0.0, 0.0], [0.0, 0.0], [0.0, 0.0]).is_none());
        assert!(through([0.0, 0.0], [500.0, 0.4], [1000.0, 0.0]).is_none());
        assert!(through([0.0, 0.0], [500.0, 0.6], [1000.0, 0.0]).is_some());
        let mut random = fastrand::Rng::with_seed(1);
        for _ in 0..10_000 {
            let (scale, offset) = (40.0 * random.f64(), 10_000.0 * random.f64());
            let [x, y, way, rise] = std::array::from_fn(|_| f64::from(random.i32(-1000..1000)));
            let at = |i: i32| [offset + (x + way * f64::from(i)) * scale, offset + (y + rise * f64::from(i)) * scale];
            let [from, middle] = [random.i32(-9..9), random.i32(-9..9)];
            let to = loop {
                let to = random.i32(-9..9);
                if to != from {
                    break to;
                }
            };
            let [from, middle, to] = [from, middle, to].map(at);
            assert!(through(from, middle, to).is_none(), "{from:?} {middle:?} {to:?}");
        }
    }

    #[test]
    fn a_bezier_is_as_long_as_its_arc() {
        // A quarter of a circle; the control points are 0.5523 of the radius from the ends.
        let quarter = Bezier([[1000.0, 0.0], [1000.0, 552.3], [552.3, 1000.0], [0.0, 1000.0]]);
        let found = length([1000.0, 0.0], quarter.flatten(0.01));
        assert!((found - 1000.0 * TAU / 4.0).abs() < 0.5, "{found}");
        let straight = Bezier([[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [3.0, 0.0]]);
        assert_eq!(straight.flatten(0.01).collect::<Vec<_>>(), [[3.0, 0.0]]);
    }
}
