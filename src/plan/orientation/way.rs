//! Machine coordinates along a path: with an eccentric knife the axes do not follow the tip.
//!
//! The centre is q(u) = p(u) - r (cos c, sin c), with c the blade's angle. In the chord mode ([`Chord`]) the heel is on the
//! path too. In the tangent mode c is the path's tangent; after a plunge as a chord it fades from the chord to the tangent over
//! the next blade width. Derivatives to third order are closed forms: with X = x' y'' - y' x'' and n = x'^2 + y'^2, c' = X / n,
//! c'' = X' / n - X n' / n^2, c''' = X'' / n - 2 X' n' / n^2 - X n'' / n^2 + 2 X n'^2 / n^3.

use super::axes::{Axes, Blade};
use super::chord::{self, Chord, TooTight};
use super::fade::Fade;
use crate::geom::{Point, Rotation, Vector, angle, cross, left, spline};
use crate::ir::toolpath::{OrientationMode, Pose};
use crate::plan::spline::Curve;

/// Samples per span in searches for a place or an angle along the curve.
const SEARCH_A_SPAN: usize = 8;
/// Bisection steps that locate the plunge, down to rounding for any span.
const BISECTIONS: usize = 60;

/// Motion of the axes along a curve, from the plunge to the lift.
#[derive(Debug)]
pub(in crate::plan) struct Way<'a> {
    curve: &'a Curve,
    /// Parameters at the plunge and at the lift.
    pub(in crate::plan) from: f64,
    pub(in crate::plan) to: f64,
    blade: Blade,
    /// Unwrapped tangent angle at the start of each span, rad.
    tangents: Vec<f64>,
    /// Lead of the tangent over the blade after a plunge as a chord; `None` without such a plunge.
    fade: Option<Fade>,
    /// The chord motion, in the chord mode.
    chord: Option<Chord>,
}

/// Boundary conditions of a motion along a curve.
#[derive(Debug, Clone, Copy)]
pub(in crate::plan) struct Course {
    /// Orientation mode of the blade.
    pub(in crate::plan) orientation: OrientationMode,
    /// Entry of the blade into the path.
    pub(in crate::plan) entry: Entry,
    /// Parameter at the lift.
    pub(in crate::plan) to: f64,
    pub(in crate::plan) blade: Blade,
    /// Reference for the turns of C: it starts at the equivalent of its heading nearest to this.
    pub(in crate::plan) near: Rotation,
}

/// Entry of the blade into a path.
#[derive(Debug, Clone, Copy)]
pub(in crate::plan) enum Entry {
    /// As a chord, with the heel at the start of the curve.
    Plunge,
    /// In its orientation mode, with the tip at this parameter.
    Steady(f64),
}

/// Length below which there is no motion, mm: below the resolution of a machine and any tolerance. The blade then only plunges,
/// in any orientation mode.
pub(in crate::plan) const WAY_EPSILON: f64 = 1e-3;

impl<'a> Way<'a> {
    /// The motion along a curve for the given conditions.
    pub(in crate::plan) fn new(curve: &'a Curve, course: &Course) -> Result<Self, TooTight> {
        let Course { orientation, entry, to, blade, near } = *course;
        let tangents = tangents(curve);
        let mut way = Self { curve, from: 0.0, to, blade, tangents, fade: None, chord: None };
        match entry {
            Entry::Steady(from) => way.from = from,
            Entry::Plunge => way.enter_as_chord(blade.width),
        }
        match orientation {
            OrientationMode::Chord if blade.width > 0.0 && to - way.from >= WAY_EPSILON => {
                let heel = match entry {
                    Entry::Plunge => Some(0.0),
                    Entry::Steady(from) => chord::heel_behind(curve, from, blade.width),
                };
                let heel = heel.ok_or(TooTight { at: way.point(way.from) })?;
                way.chord = Some(Chord::new(curve, [heel, way.from, to], blade)?);
            }
            OrientationMode::Chord | OrientationMode::Tangent => {}
        }
        let start = way.at(way.from).q[0][2];
        let turns = near.nearest(Rotation(start).heading()).0 - start;
        way.tangents.iter_mut().for_each(|tangent| *tangent += turns);
        if let Some(chord) = &mut way.chord {
            chord.turn(turns);
        }
        Ok(way)
    }

    /// Angle from the blade to the tangent at a plunge as a chord, rad; 0 without one.
    pub(in crate::plan) fn lead(&self) -> f64 {
        self.fade.as_ref().map_or(0.0, Fade::lead)
    }

    /// Moves the start to the first point at the distance `width` from the start of the curve, and stores the lead of the
    /// tangent over the chord there.
    fn enter_as_chord(&mut self, width: f64) {
        if width <= 0.0 {
            return;
        }
        let start = self.point(0.0);
        let mut chord = self.tangents[0];
        let mut before = 0.0;
        self.from = self.to;
        'search: for ends in self.curve.breaks().windows(2) {
            for i in 1..=SEARCH_A_SPAN {
                let u = (ends[0] + (ends[1] - ends[0]) * i as f64 / SEARCH_A_SPAN as f64).min(self.to);
                let there = self.point(u) - start;
                if there.norm() >= width {
                    self.from = self.crossing(start, width, before, u);
                    break 'search;
                }
                chord += angle::wrap(there.y.atan2(there.x) - chord);
                before = u;
            }
        }
        let there = self.point(self.from) - start;
        chord += angle::wrap(there.y.atan2(there.x) - chord);
        let lead = self.tangent(self.from) - chord;
        self.fade = Some(Fade::new(self.curve, [self.from, self.to], lead, width));
    }

    /// The parameter between two others at which the distance from `start` exceeds `width`.
    fn crossing(&self, start: Point, width: f64, mut low: f64, mut high: f64) -> f64 {
        for _ in 0..BISECTIONS {
            let middle = f64::midpoint(low, high);
            if (self.point(middle) - start).norm() < width {
                low = middle;
            } else {
                high = middle;
            }
        }
        high
    }

    /// A walk along the motion that starts at a parameter.
    pub(in crate::plan) fn walk(&self, from: f64) -> Walk<'_> {
        Walk { way: self, span: spline::span(self.curve.breaks(), from) }
    }

    /// Position of the tip at a parameter.
    pub(in crate::plan) fn point(&self, u: f64) -> Point {
        let [[x, y]] = self.curve.derivatives::<1>(u);
        Point::new(x, y)
    }

    /// Unwrapped tangent angle, rad.
    fn tangent(&self, u: f64) -> f64 {
        let span = spline::span(self.curve.breaks(), u);
        let [_, d] = self.curve.derivatives_on::<2>(span, u);
        self.tangents[span] + angle::wrap(d[1].atan2(d[0]) - self.tangents[span])
    }

    /// State of the axes at a parameter.
    pub(in crate::plan) fn at(&self, u: f64) -> Axes {
        self.at_on(spline::span(self.curve.breaks(), u), u)
    }

    /// State of the axes at a parameter on a known span of the curve.
    fn at_on(&self, span: usize, u: f64) -> Axes {
        if let Some(chord) = &self.chord {
            return chord.at(self.curve, u);
        }
        let [p, p1, p2, p3, p4] = self.curve.derivatives_on::<5>(span, u).map(|d| Vector::new(d[0], d[1]));
        let n = p1.norm_squared();
        let (n1, n2) = (2.0 * p1.dot(&p2), 2.0 * (p2.norm_squared() + p1.dot(&p3)));
        let (x, x1, x2) = (cross(p1, p2), cross(p1, p3), cross(p2, p3) + cross(p1, p4));
        let tangent = self.tangents[span] + angle::wrap(p1.y.atan2(p1.x) - self.tangents[span]);
        let mut c = [
            tangent,
            x / n,
            x1 / n - x * n1 / (n * n),
            x2 / n - 2.0 * x1 * n1 / (n * n) - x * n2 / (n * n) + 2.0 * x * n1 * n1 / (n * n * n),
        ];
        let pace = n.sqrt();
        let paces = [pace, n1 / (2.0 * pace), n2 / (2.0 * pace) - n1 * n1 / (4.0 * n * pace)];
        if let Some(lead) = self.fade.as_ref().and_then(|fade| fade.at(self.curve, u, paces)) {
            for (value, lead) in c.iter_mut().zip(lead) {
                *value -= lead;
            }
        }
        if self.blade.radius == 0.0 {
            return Axes { q: [[p.x, p.y, c[0]], [p1.x, p1.y, c[1]], [p2.x, p2.y, c[2]], [p3.x, p3.y, c[3]]], pace };
        }
        let e = Rotation(c[0]).unit();
        let normal = left(e);
        let r = self.blade.radius;
        let q = p - e * r;
        let q1 = p1 - normal * (r * c[1]);
        let q2 = p2 - (normal * c[2] - e * (c[1] * c[1])) * r;
        let q3 = p3 - (normal * (c[3] - c[1].powi(3)) - e * (3.0 * c[1] * c[2])) * r;
        Axes { q: [[q.x, q.y, c[0]], [q1.x, q1.y, c[1]], [q2.x, q2.y, c[2]], [q3.x, q3.y, c[3]]], pace }
    }

    /// The pose at a parameter.
    pub(in crate::plan) fn pose(&self, u: f64) -> Pose {
        self.at(u).pose()
    }

    /// Breaks between the path's own polynomials from the plunge to the lift, both included.
    pub(in crate::plan) fn breaks(&self) -> Vec<f64> {
        let inner = self.curve.breaks().iter().copied().filter(|&b| b > self.from && b < self.to);
        std::iter::once(self.from).chain(inner).chain(std::iter::once(self.to)).collect()
    }
}

/// Places along a motion at ascending parameters. In the tangent mode each is found without a search, however long the motion.
#[derive(Debug)]
pub(in crate::plan) struct Walk<'a> {
    way: &'a Way<'a>,
    span: usize,
}

impl Walk<'_> {
    /// The span of the curve at a parameter, which must not be before the last one.
    fn reach(&mut self, u: f64) -> usize {
        let breaks = self.way.curve.breaks();
        while self.span + 2 < breaks.len() && breaks[self.span + 1] <= u {
            self.span += 1;
        }
        self.span
    }

    /// State of the axes at a parameter.
    pub(in crate::plan) fn at(&mut self, u: f64) -> Axes {
        let span = self.reach(u);
        self.way.at_on(span, u)
    }

    /// Position of the tip at a parameter.
    pub(in crate::plan) fn point(&mut self, u: f64) -> Point {
        let span = self.reach(u);
        let [[x, y]] = self.way.curve.derivatives_on::<1>(span, u);
        Point::new(x, y)
    }
}

/// Unwrapped tangent angle at the start of each span, rad.
fn tangents(curve: &Curve) -> Vec<f64> {
    let mut angles = Vec::with_capacity(curve.breaks().len() - 1);
    let mut angle = f64::NAN;
    for (span, ends) in curve.breaks().windows(2).enumerate() {
        for i in 0..SEARCH_A_SPAN {
            let u = ends[0] + (ends[1] - ends[0]) * i as f64 / SEARCH_A_SPAN as f64;
            let [_, d] = curve.derivatives_on::<2>(span, u);
            let here = d[1].atan2(d[0]);
            angle = if angle.is_nan() { here } else { angle + angle::wrap(here - angle) };
            if i == 0 {
                angles.push(angle);
            }
        }
    }
    angles
}

#[cfg(test)]
pub(in crate::plan) mod tests {
    use super::*;
    use crate::machine::MachineProfile;
    use crate::plan::spline::ToleranceBand;
    use crate::plan::spline::smooth;

    fn arc() -> Curve {
        let points =
            (0..=60).map(|i| f64::from(i) / 20.0).map(|a| Point::new(20.0 * a.cos(), 20.0 * a.sin())).collect();
        smooth(&ToleranceBand::new(points, 0.05, &MachineProfile::default())).expect("an arc").curve
    }

    fn way(curve: &Curve, entry: Entry, near: Rotation) -> Way<'_> {
        let blade = Blade { width: 6.6, radius: 4.4 };
        Way::new(curve, &Course { orientation: OrientationMode::Tangent, entry, to: 59.0, blade, near })
            .expect("a tangent is everywhere")
    }

    /// Checks the derivatives of a motion against finite differences.
    pub(in crate::plan) fn differences_agree(way: &Way, what: &str) {
        let h = 1e-4;
        for i in 1..40 {
            let u = way.from + (way.to - way.from) * f64::from(i) / 40.0;
            let [before, here, after] = [u - h, u, u + h].map(|u| way.at(u).q);
            for k in 0..3 {
                for axis in 0..3 {
                    let numeric = (after[k][axis] - before[k][axis]) / (2.0 * h);
                    let off = (numeric - here[k + 1][axis]).abs();
                    assert!(off < 1e-3 * (1.0 + numeric.abs()), "{what}, order {k}, axis {axis}, {u}");
                }
            }
        }
    }

    #[test]
    fn derivatives_are_those_of_the_positions() {
        let curve = arc();
        for entry in [Entry::Plunge, Entry::Steady(3.0)] {
            let way = way(&curve, entry, Rotation(9.0));
            assert!((way.at(way.from).q[0][2] - 9.0).abs() <= std::f64::consts::PI);
            differences_agree(&way, "the tangent mode");
        }
    }

    #[test]
    fn a_walk_finds_what_a_search_finds() {
        let curve = arc();
        let way = way(&curve, Entry::Plunge, Rotation(9.0));
        let mut walk = way.walk(way.from + 5.0);
        for i in 0..=300 {
            let u = (way.from + 5.0 + 0.2 * f64::from(i)).min(way.to);
            assert_eq!(walk.at(u).q, way.at(u).q, "{u}");
            assert_eq!(walk.point(u), way.point(u), "{u}");
        }
    }

    #[test]
    fn a_chord_plunge_has_its_heel_at_the_start_and_ends_tangent() {
        let curve = arc();
        let way = way(&curve, Entry::Plunge, Rotation(0.0));
        let pose = way.pose(way.from);
        assert!((pose.ahead(4.4) - way.point(way.from)).norm() < 1e-9);
        assert!((pose.ahead(4.4 - 6.6) - way.point(0.0)).norm() < 1e-6);
        let later = way.from + 6.7;
        assert!((way.pose(later).c.0 - way.tangent(later)).abs() < 1e-12);
    }
}
