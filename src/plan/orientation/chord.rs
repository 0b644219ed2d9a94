//! The chord mode: tip and heel both on the path, with the blade as its chord.
//!
//! The tip is at p(u), the heel at p(t) with D = p(u) - p(t), |D| = w; t is found for each u by Newton's method. With ' = d/du,
//! and p' at t meaning dp/dt, differentiating D . D = w^2 gives t' = D.p'(u) / D.p'(t), and so on for D', D'', D''' (see
//! [`Chord::at`]). The blade's angle then has c' = n.D'/w, c'' = n.D''/w, c''' = n.D'''/w + c'^3, with n the normal to the left
//! of D, and the centre is p - (r/w) D in every order. The mode needs only p''', and is smoother than the tangent mode.

use super::axes::{Axes, Blade};
use crate::geom::{Point, Rotation, Vector, angle, left, spline};
use crate::plan::spline::Curve;

/// Nodes per span; between them the heel is found by Newton's method.
const NODES_A_SPAN: usize = 8;
/// Maximum number of Newton steps; from a place between two nodes convergence is quadratic.
const NEWTON_STEPS: usize = 12;
/// Step of the heel below which Newton's method has converged, mm: rounding of places on a table of metres.
const HEEL_EPSILON: f64 = 1e-12;
/// Bisection steps between two places a few mm apart; they reach a billionth of that distance. Newton's method does the rest.
const BISECTIONS: usize = 32;
/// Minimum cosine between the blade and the path at its heel. Below it the heel darts along the path as the tip moves, and
/// derivatives grow without bound. Runs with less than 0.4 on their polyline do not get this mode; smoothing takes a little of
/// the difference.
const COSINE_MIN: f64 = 0.2;
/// Minimum cosine between the blade and the path at its tip. It keeps the heel from stopping or going back.
const FORWARD_MIN: f64 = 0.01;
/// Maximum step of the search for a heel, in widths of the blade.
const LOOK_SHARE: f64 = 1.0 / 64.0;

/// The path is too tight: the blade cannot be its chord everywhere.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::plan) struct TooTight {
    /// Position of the tip where the chord fails.
    pub(in crate::plan) at: Point,
}

/// Motion of a blade that is a chord of its path.
#[derive(Debug)]
pub(super) struct Chord {
    blade: Blade,
    nodes: Vec<Node>,
}

/// A precomputed place of the motion.
#[derive(Debug, Clone, Copy)]
struct Node {
    /// Parameters of the tip and of the heel.
    u: f64,
    t: f64,
    /// Unwrapped angle of the blade, rad.
    c: f64,
}

/// Position and derivatives of the path up to order `N - 1`, mm.
fn path<const N: usize>(curve: &Curve, u: f64) -> [Vector; N] {
    curve.derivatives::<N>(u).map(|d| Vector::new(d[0], d[1]))
}

/// Parameter of the heel at the distance `width` behind the tip at parameter `tip`; `None` when the path starts nearer.
pub(super) fn heel_behind(curve: &Curve, tip: f64, width: f64) -> Option<f64> {
    let [p] = path::<1>(curve, tip);
    let away = |t: f64| (p - path::<1>(curve, t)[0]).norm() - width;
    let step = LOOK_SHARE * width;
    let mut near = tip;
    while near > 0.0 {
        let far = (near - step).max(0.0);
        if away(far) >= 0.0 {
            return Some(root(&away, near, far));
        }
        near = far;
    }
    None
}

/// Zero of a function between `low`, where it is negative, and `high`, where it is not.
fn root(f: &dyn Fn(f64) -> f64, mut low: f64, mut high: f64) -> f64 {
    for _ in 0..BISECTIONS {
        let middle = f64::midpoint(low, high);
        if f(middle) < 0.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    high
}

impl Chord {
    /// The motion for the tip from parameter `from`, with the heel at parameter `heel`, to parameter `to`.
    pub(super) fn new(curve: &Curve, [heel, from, to]: [f64; 3], blade: Blade) -> Result<Self, TooTight> {
        let inner = curve.breaks().windows(2).flat_map(|ends| {
            let step = (ends[1] - ends[0]) / NODES_A_SPAN as f64;
            (0..NODES_A_SPAN).map(move |i| ends[0] + step * i as f64)
        });
        let places: Vec<f64> = inner.filter(|&u| u > from && u < to).chain([to]).collect();
        let mut chord = Self { blade, nodes: Vec::with_capacity(places.len() + 1) };
        let first = Self::node(curve, [from, heel], None)?;
        chord.nodes.push(first);
        for u in places {
            let before = chord.nodes[chord.nodes.len() - 1];
            let t = chord.next_heel(curve, u, before.t)?;
            let node = Self::node(curve, [u, t], Some(before))?;
            chord.nodes.push(node);
        }
        Ok(chord)
    }

    /// The first parameter of the heel after `before` when the tip is at `u`.
    fn next_heel(&self, curve: &Curve, u: f64, before: f64) -> Result<f64, TooTight> {
        let width = self.blade.width;
        let [p] = path::<1>(curve, u);
        let near = |t: f64| width - (p - path::<1>(curve, t)[0]).norm();
        let step = LOOK_SHARE * width;
        let mut low = before;
        while low < u {
            let high = (low + step).min(u);
            if near(high) >= 0.0 {
                return Ok(root(&near, low, high));
            }
            low = high;
        }
        Err(TooTight { at: Point::from(p) })
    }

    /// The node for parameters of tip and heel; an error where the blade cannot be a chord.
    fn node(curve: &Curve, [u, t]: [f64; 2], before: Option<Node>) -> Result<Node, TooTight> {
        let [p, p1] = path::<2>(curve, u);
        let [heel, heel1] = path::<2>(curve, t);
        let d = p - heel;
        let length = d.norm();
        let is_chord =
            d.dot(&heel1) >= COSINE_MIN * length * heel1.norm() && d.dot(&p1) >= FORWARD_MIN * length * p1.norm();
        if !is_chord {
            return Err(TooTight { at: Point::from(p) });
        }
        let c = d.y.atan2(d.x);
        Ok(Node { u, t, c: before.map_or(c, |before| before.c + angle::wrap(c - before.c)) })
    }

    /// Adds an angle to the blade's angle along the whole motion, rad; it must be a whole number of turns.
    pub(super) fn turn(&mut self, by: f64) {
        self.nodes.iter_mut().for_each(|node| node.c += by);
    }

    /// Parameter of the heel, and the angle of the blade at a nearby node, rad.
    fn heel(&self, curve: &Curve, u: f64, p: Vector) -> (f64, f64) {
        let i = self.nodes.partition_point(|node| node.u <= u).clamp(1, self.nodes.len() - 1);
        let (a, b) = (self.nodes[i - 1], self.nodes[i]);
        let share = if b.u > a.u { ((u - a.u) / (b.u - a.u)).clamp(0.0, 1.0) } else { 0.0 };
        let mut t = a.t + (b.t - a.t) * share;
        for _ in 0..NEWTON_STEPS {
            let [q, q1] = path::<2>(curve, t);
            let d = p - q;
            let step = (d.norm_squared() - self.blade.width.powi(2)) / (2.0 * d.dot(&q1));
            let next = (t + step).clamp(a.t, b.t);
            let moved = (next - t).abs();
            t = next;
            if moved <= HEEL_EPSILON {
                return (t, a.c);
            }
        }
        // Fall back on bisection where Newton's method does not converge.
        let near = |t: f64| self.blade.width - (p - path::<1>(curve, t)[0]).norm();
        (root(&near, a.t, b.t), a.c)
    }

    /// State of the axes at a parameter.
    pub(super) fn at(&self, curve: &Curve, u: f64) -> Axes {
        let Blade { width, radius } = self.blade;
        let span = spline::span(curve.breaks(), u);
        let [p, p1, p2, p3] = curve.derivatives_on::<4>(span, u).map(|d| Vector::new(d[0], d[1]));
        let (t, near) = self.heel(curve, u, p);
        let [q, q1, q2, q3] = path::<4>(curve, t);
        let d = p - q;
        let slope = d.dot(&q1);
        let t1 = d.dot(&p1) / slope;
        let d1 = p1 - q1 * t1;
        let t2 = (d1.norm_squared() + d.dot(&(p2 - q2 * (t1 * t1)))) / slope;
        let d2 = p2 - q2 * (t1 * t1) - q1 * t2;
        let rest = p3 - q3 * t1.powi(3) - q2 * (3.0 * t1 * t2);
        let t3 = (3.0 * d1.dot(&d2) + d.dot(&rest)) / slope;
        let d3 = rest - q1 * t3;
        let c = near + angle::wrap(d.y.atan2(d.x) - near);
        let normal = left(Rotation(c).unit());
        let [c1, c2, n3] = [d1, d2, d3].map(|d| normal.dot(&d) / width);
        let share = radius / width;
        let row = |p: Vector, d: Vector, c: f64| {
            let centre = p - d * share;
            [centre.x, centre.y, c]
        };
        Axes { q: [row(p, d, c), row(p1, d1, c1), row(p2, d2, c2), row(p3, d3, n3 + c1.powi(3))], pace: p1.norm() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ir::toolpath::OrientationMode;
    use crate::machine::MachineProfile;
    use crate::plan::orientation::way::tests::differences_agree;
    use crate::plan::orientation::{Course, Entry, Way};
    use crate::plan::spline::ToleranceBand;
    use crate::plan::spline::smooth;

    const BLADE: Blade = Blade { width: 6.6, radius: 4.4 };

    /// A smooth curve through points given by a parameter from 0 to 1.
    fn curve(place: impl Fn(f64) -> (f64, f64)) -> Curve {
        let points = (0..=120).map(|i| place(f64::from(i) / 120.0)).map(|(x, y)| Point::new(x, y)).collect();
        smooth(&ToleranceBand::new(points, 0.02, &MachineProfile::default())).expect("a curve").curve
    }

    fn arc(radius: f64) -> Curve {
        curve(|s| (radius * (4.0 * s).sin(), radius * (1.0 - (4.0 * s).cos())))
    }

    fn way(curve: &Curve, entry: Entry) -> Result<Way<'_>, TooTight> {
        let to = curve.breaks()[curve.breaks().len() - 1] - 0.5;
        Way::new(curve, &Course { orientation: OrientationMode::Chord, entry, to, blade: BLADE, near: Rotation(9.0) })
    }

    #[test]
    fn derivatives_are_those_of_the_positions() {
        let curves = [arc(20.0), arc(6.5), curve(|s| (60.0 * s, 8.0 * (9.0 * s).sin()))];
        for (which, curve) in curves.iter().enumerate() {
            for entry in [Entry::Plunge, Entry::Steady(9.0)] {
                let way = way(curve, entry).expect("no tighter than the blade");
                differences_agree(&way, &format!("curve {which}"));
            }
        }
    }

    #[test]
    fn tip_and_heel_are_on_the_path_and_the_heel_only_goes_forward() {
        let curve = curve(|s| (60.0 * s, 8.0 * (9.0 * s).sin()));
        let way = way(&curve, Entry::Plunge).expect("no tighter than the blade");
        assert!((way.pose(way.from).ahead(BLADE.radius - BLADE.width) - way.point(0.0)).norm() < 1e-9);
        let mut from = 0.0;
        for i in 0..=200 {
            let u = way.from + (way.to - way.from) * f64::from(i) / 200.0;
            let pose = way.pose(u);
            assert!((pose.ahead(BLADE.radius) - way.point(u)).norm() < 1e-9);
            let heel = pose.ahead(BLADE.radius - BLADE.width);
            // The nearest point of the path, from the last one on.
            let places = (0..=4000).map(|k| from + 1.0 * f64::from(k) / 4000.0);
            let best = places.min_by(|&a, &b| (way.point(a) - heel).norm().total_cmp(&(way.point(b) - heel).norm()));
            from = best.expect("there are places");
            assert!((way.point(from) - heel).norm() < 5e-4, "{i}");
        }
    }

    #[test]
    fn a_ring_starts_with_its_heel_on_the_contour_behind() {
        let curve = arc(20.0);
        let way = way(&curve, Entry::Steady(9.0)).expect("no tighter than the blade");
        let heel = heel_behind(&curve, 9.0, BLADE.width).expect("there is path behind");
        assert!(way.from == 9.0 && heel < 9.0 - BLADE.width);
        assert!((way.pose(9.0).ahead(BLADE.radius - BLADE.width) - way.point(heel)).norm() < 1e-9);
    }

    #[test]
    fn a_curve_that_the_blade_cannot_be_a_chord_of_is_refused() {
        assert!(way(&arc(3.35), Entry::Plunge).is_err());
        assert!(way(&arc(3.8), Entry::Plunge).is_ok());
    }

    #[test]
    fn the_body_leaves_an_arc_by_the_sagitta_of_the_blade() {
        // R - sqrt(R^2 - w^2/4) for R = 6.5 mm.
        let curve = arc(6.5);
        let way = way(&curve, Entry::Plunge).expect("no tighter than the blade");
        let middle = way.pose(f64::midpoint(way.from, way.to)).ahead(BLADE.radius - BLADE.width / 2.0);
        let away = 6.5 - (middle - Point::new(0.0, 6.5)).norm();
        let expected = 6.5 - (6.5_f64.powi(2) - BLADE.width.powi(2) / 4.0).sqrt();
        assert!((away - expected).abs() < 0.03, "{away} {expected}");
    }
}
