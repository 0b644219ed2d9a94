//! The near time-optimal jerk-limited motion along a way: u(t) from rest to rest.
//!
//! The unknown is b(u) = (du/dt)^2, so that u'' = b'/2 and u''' = sqrt(b) b''/2, and on each axis
//!
//! - velocity: q'^2 b <= V^2
//! - acceleration: |q' b'/2 + q'' b| <= A
//! - jerk: sqrt(b) |q' b''/2 + 3/2 q'' b' + q''' b| <= J
//!
//! and |p'|^2 b <= feed^2 for the tip. From rest b ~ u^(4/3), so b = w(u) beta(u) with w carrying that singularity and
//! beta a cubic B-spline. The duration, the integral of du / sqrt(b), is minimised by a logarithmic barrier with Newton
//! steps from a strictly feasible start (Boyd & Vandenberghe, *Convex Optimization*, chapter 11; the change of variable
//! after Verscheure et al., *Time-Optimal Path Tracking for Robots: A Convex Optimization Approach*, 2009). A constant
//! beta, small enough, is always feasible, so there is no run without a motion.

use std::ops::Range;

use super::banded::Band;
use super::barrier::{self, Logs, Schedule};
use super::feed::Feed;
use super::law::Way;
use super::pace::Grid;
use super::timing::Timing;
use super::windows::{self, Chain, Windows};
use crate::geom::spline::{self, Piecewise};
use crate::machine::Limits;

/// Order of beta: cubic.
const ORDER: usize = 4;
/// Constraints at a place: the speed, and both signs of acceleration and jerk of three axes.
const BOUNDS_A_PLACE: f64 = 13.0;
/// To a thousandth of the duration; 41 to 63 steps are seen, whatever the size.
const SCHEDULE: Schedule =
    Schedule { start: 0.3, growth: 8.0, gap: 1e-3, decrement: 1.0, steps_a_round: 12, steps: 150 };
/// What follows bears on no more than the knots over which the axes come to rest: at most some 270 a second of turning C,
/// and some ten over which the barrier's own choice fades.
const WINDOWS: Windows = Windows { schedule: SCHEDULE, size: 3000, overlap: 120 };
/// How far inside the limits the start lies.
const START_SHARE: f64 = 0.7;
/// Least difference of two collocation places, mm: nearer ones say the same.
const PLACE_EPSILON: f64 = 1e-7;
/// Least derivative of an axis that bounds its speed: smaller ones allow any.
const SLOPE_EPSILON: f64 = 1e-12;

/// No motion was found: a fault of the numbers, since a slow enough motion always exists.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct NoMotion;

/// What bounds a motion: the axes' limits (x, y, c) and the greatest speed of the tip.
#[derive(Debug, Clone)]
pub(super) struct Bounds {
    /// Limits of x, y, c in mm, rad, s.
    pub(super) axes: [Limits; 3],
    /// Greatest speed of the tip, by the parameter of the way.
    pub(super) feed: Feed,
}

/// The motion along `way` within `bounds`, from rest to rest.
pub(super) fn profile(way: &Way, bounds: &Bounds) -> Result<Timing, NoMotion> {
    profile_on(way, bounds, 1.0)
}

/// The same with `density` times as many knots.
fn profile_on(way: &Way, bounds: &Bounds, density: f64) -> Result<Timing, NoMotion> {
    Problem::new(way, bounds, density).fastest(WINDOWS)
}

/// The weight w(u) = (g(u) g(L - u))^(4/3), g = u / (u + u0): the behaviour of b near both ends.
#[derive(Debug, Clone, Copy)]
pub(super) struct Ends {
    /// Length of the way in the parameter, mm.
    pub(super) length: f64,
    /// Length over which an end is felt, mm.
    pub(super) reach: f64,
}

impl Ends {
    /// w and its first two derivatives at `s` from the start, inside the run.
    fn weight(&self, s: f64) -> [f64; 3] {
        let Self { length, reach } = *self;
        let (a, b) = (s, length - s);
        let product = a * b / ((a + reach) * (b + reach));
        let w = product * product.cbrt();
        let log1 = |s: f64| reach / (s * (s + reach));
        let log2 = |s: f64| -reach * (2.0 * s + reach) / (s * (s + reach)).powi(2);
        let l1 = 4.0 / 3.0 * (log1(a) - log1(b));
        let l2 = 4.0 / 3.0 * (log2(a) + log2(b));
        [w, w * l1, w * (l1 * l1 + l2)]
    }
}

/// What holds at one place of the run, as rows over the four control values that matter there.
struct Place {
    first: usize,
    /// b.
    square: [f64; ORDER],
    /// 1 / (greatest b that the speeds allow).
    speed: f64,
    /// Acceleration of each axis in parts of its limit.
    acceleration: [[f64; ORDER]; 3],
    /// Jerk of each axis in parts of its limit, without the factor sqrt(b).
    jerk: [[f64; ORDER]; 3],
}

/// A node of the integral for the duration.
struct Node {
    first: usize,
    square: [f64; ORDER],
    weight: f64,
}

struct Problem {
    breaks: Vec<f64>,
    start: f64,
    ends: Ends,
    places: Vec<Place>,
    nodes: Vec<Node>,
}

fn dot(a: &[f64; ORDER], control: &[[f64; 1]]) -> f64 {
    a[0] * control[0][0] + a[1] * control[1][0] + a[2] * control[2][0] + a[3] * control[3][0]
}

impl Problem {
    fn new(way: &Way, bounds: &Bounds, density: f64) -> Self {
        let length = way.to - way.from;
        let ends = Ends { length, reach: END_REACH.min(length / 8.0) };
        let inside = |u: &f64| *u > way.from && *u < way.to;
        let changes: Vec<f64> = bounds.feed.changes().iter().copied().filter(inside).map(|u| u - way.from).collect();
        let mut path_breaks: Vec<f64> =
            way.breaks().iter().map(|b| b - way.from).chain(changes.iter().copied()).collect();
        path_breaks.sort_by(f64::total_cmp);
        let breaks = super::pace::breaks(way, &path_breaks, &changes, &Grid { reach: ends.reach, density });
        let knots = spline::clamped_knots::<ORDER>(&breaks);
        let mut span = 0;
        let mut span_of = |s: f64| {
            while span + 2 < breaks.len() && breaks[span + 1] <= s {
                span += 1;
            }
            span
        };
        let places = super::pace::places(&breaks, &path_breaks, PLACE_EPSILON)
            .into_iter()
            .map(|s| Place::new(way, bounds, &ends, &knots, span_of(s), s))
            .collect();
        let mut nodes = Vec::with_capacity(4 * breaks.len());
        for (span, cell) in super::pace::cells(&breaks, length).enumerate() {
            for (s, weight) in cell.gauss_4() {
                let [beta] = spline::basis::<ORDER, 1>(&knots, span, s);
                let w = ends.weight(s)[0];
                nodes.push(Node { first: span, square: beta.map(|v| w * v), weight });
            }
        }
        Self { breaks, start: way.from, ends, places, nodes }
    }

    /// A constant beta well inside every limit.
    fn feasible_start(&self) -> Vec<[f64; 1]> {
        let ones = [[1.0]; ORDER];
        let mut scale = f64::INFINITY;
        for place in &self.places {
            let b = dot(&place.square, &ones);
            scale = scale.min(1.0 / (b * place.speed));
            for (a, j) in place.acceleration.iter().zip(&place.jerk) {
                scale = scale.min(1.0 / dot(a, &ones).abs());
                scale = scale.min((dot(j, &ones).abs() * b.sqrt()).powf(-2.0 / 3.0));
            }
        }
        vec![[START_SHARE * scale]; spline::control_count::<ORDER>(&self.breaks)]
    }

    fn fastest(&self, windows: Windows) -> Result<Timing, NoMotion> {
        let control = windows::minimise(self, self.feasible_start(), windows).ok_or(NoMotion)?;
        Ok(self.timing(&control))
    }

    /// The motion as time over the parameter.
    fn timing(&self, control: &[[f64; 1]]) -> Timing {
        let beta = Piecewise::<ORDER, 1>::from_control(self.breaks.clone(), control);
        let pace = |span: usize, s: f64| {
            let [w, w1, _] = self.ends.weight(s);
            let [[v], [v1]] = beta.derivatives_on::<2>(span, s);
            (w * v, w1 * v + w * v1)
        };
        Timing::new(self.start, &self.breaks, pace)
    }
}

impl Chain<1> for Problem {
    type Part<'a>
        = Part<'a>
    where
        Self: 'a;

    fn free(&self) -> Range<usize> {
        0..spline::control_count::<ORDER>(&self.breaks)
    }

    fn part(&self, free: Range<usize>) -> (Part<'_>, Range<usize>) {
        let spans = free.start.saturating_sub(ORDER - 1)..free.end.min(self.breaks.len() - 1);
        let place = |span: usize| self.places.partition_point(|place| place.first < span);
        let node = |span: usize| self.nodes.partition_point(|node| node.first < span);
        let places = &self.places[place(spans.start)..place(spans.end)];
        let nodes = &self.nodes[node(spans.start)..node(spans.end)];
        let near = spans.start..spans.end + ORDER - 1;
        (Part { places, nodes, near: near.clone(), free }, near)
    }
}

/// Some control values of a problem, the others standing still.
struct Part<'a> {
    /// The places and the nodes on which they bear.
    places: &'a [Place],
    nodes: &'a [Node],
    /// The control values that are known, and those of them that are free.
    near: Range<usize>,
    free: Range<usize>,
}

impl barrier::Problem<1> for Part<'_> {
    fn constraints(&self) -> f64 {
        BOUNDS_A_PLACE * self.places.len() as f64
    }

    fn objective(&self, control: &[[f64; 1]]) -> f64 {
        self.nodes.iter().map(|n| n.weight / dot(&n.square, &control[n.first - self.near.start..]).sqrt()).sum()
    }

    fn value(&self, control: &[[f64; 1]], weight: f64) -> f64 {
        let mut duration = 0.0;
        for node in self.nodes {
            let b = dot(&node.square, &control[node.first - self.near.start..]);
            if b <= 0.0 || b.is_nan() {
                return f64::INFINITY;
            }
            duration += node.weight / b.sqrt();
        }
        let mut logs = Logs::new();
        for place in self.places {
            let near = &control[place.first - self.near.start..];
            let b = dot(&place.square, near);
            let speed = 1.0 - b * place.speed;
            if b <= 0.0 || speed <= 0.0 || b.is_nan() {
                return f64::INFINITY;
            }
            let mut slack = speed;
            for row in &place.acceleration {
                let a = dot(row, near);
                if a.abs() >= 1.0 {
                    return f64::INFINITY;
                }
                slack *= 1.0 - a * a;
            }
            for row in &place.jerk {
                let square = b * dot(row, near).powi(2);
                if square >= 1.0 {
                    return f64::INFINITY;
                }
                slack *= 1.0 - square;
            }
            logs.add(slack);
        }
        weight * duration - logs.sum()
    }

    /// The Hessian is exact for the duration and takes g g^T terms for the bounds, so it is positive definite everywhere.
    fn newton(&self, control: &[[f64; 1]], weight: f64) -> Option<(Vec<[f64; 1]>, f64)> {
        let mut hessian = Band::<ORDER>::zero(control.len());
        let mut gradient = vec![0.0; control.len()];
        let mut add = |hessian: &mut Band<ORDER>, first: usize, row: &[f64; ORDER], slope: f64, bend: f64| {
            for (g, r) in gradient[first..].iter_mut().zip(row) {
                *g += slope * r;
            }
            hessian.add_square(first, row, bend);
        };
        for node in self.nodes {
            let first = node.first - self.near.start;
            let b = dot(&node.square, &control[first..]);
            let slope = -0.5 * weight * node.weight / (b * b.sqrt());
            add(&mut hessian, first, &node.square, slope, -1.5 * slope / b);
        }
        for place in self.places {
            let first = place.first - self.near.start;
            let near = &control[first..];
            let b = dot(&place.square, near);
            let root = b.sqrt();
            let speed = place.speed / (1.0 - b * place.speed);
            add(&mut hessian, first, &place.square, speed, speed * speed);
            for row in &place.acceleration {
                let (slope, bend) = two_sided(dot(row, near));
                add(&mut hessian, first, row, slope, bend);
            }
            for row in &place.jerk {
                let half = dot(row, near);
                let (slope, bend) = two_sided(root * half);
                // Gradient of sqrt(b) * (row . control).
                let share = 0.5 * half / root;
                let full: [f64; ORDER] = std::array::from_fn(|i| root * row[i] + share * place.square[i]);
                add(&mut hessian, first, &full, slope, bend);
            }
        }
        let (before, behind) = (self.free.start - self.near.start, self.free.end - self.near.start);
        for fixed in (0..before).chain(behind..control.len()) {
            hessian.fix(fixed, |_, _| {});
            gradient[fixed] = 0.0;
        }
        let mut step: Vec<[f64; 1]> = gradient.iter().map(|g| [-g]).collect();
        hessian.factor().ok()?.solve(&mut step);
        let decrement = -step.iter().zip(&gradient).map(|(s, g)| s[0] * g).sum::<f64>();
        decrement.is_finite().then_some((step, decrement))
    }
}

/// Slope and bend of -log(1 - a^2).
fn two_sided(a: f64) -> (f64, f64) {
    let slack = 1.0 - a * a;
    (2.0 * a / slack, 2.0 * (1.0 + a * a) / (slack * slack))
}

/// Length over which an end of a run is felt at most, mm.
const END_REACH: f64 = 2.0;

impl Place {
    fn new(way: &Way, bounds: &Bounds, ends: &Ends, knots: &[f64], span: usize, s: f64) -> Self {
        let [w, w1, w2] = ends.weight(s);
        let [n0, n1, n2] = spline::basis::<ORDER, 3>(knots, span, s);
        let b0: [f64; ORDER] = std::array::from_fn(|i| w * n0[i]);
        let b1: [f64; ORDER] = std::array::from_fn(|i| w1 * n0[i] + w * n1[i]);
        let b2: [f64; ORDER] = std::array::from_fn(|i| w2 * n0[i] + 2.0 * w1 * n1[i] + w * n2[i]);
        let axes = way.at(way.from + s);
        let [_, q1, q2, q3] = axes.q;
        let mut speed = (axes.pace / bounds.feed.at(way.from + s)).powi(2);
        for (q1, limits) in q1.iter().zip(&bounds.axes) {
            speed = speed.max((q1.abs().max(SLOPE_EPSILON) / limits.speed).powi(2));
        }
        let sum = |limit: f64, terms: [(f64, &[f64; ORDER]); 3]| -> [f64; ORDER] {
            std::array::from_fn(|i| terms.iter().map(|(factor, b)| factor * b[i]).sum::<f64>() / limit)
        };
        let acceleration =
            std::array::from_fn(|k| sum(bounds.axes[k].acceleration, [(0.5 * q1[k], &b1), (q2[k], &b0), (0.0, &b2)]));
        let jerk =
            std::array::from_fn(|k| sum(bounds.axes[k].jerk, [(0.5 * q1[k], &b2), (1.5 * q2[k], &b1), (q3[k], &b0)]));
        Self { first: span, square: b0, speed, acceleration, jerk }
    }
}

#[cfg(test)]
mod tests {
    use rand::{RngExt, SeedableRng};
    use rand_chacha::ChaCha8Rng;

    use super::*;
    use crate::geom::{Heading, Point, Rotation};
    use crate::ir::toolpath::Law;
    use crate::machine::MachineProfile;
    use crate::plan::law::{Blade, Course, Entry};
    use crate::plan::smooth::{Curve, smooth};
    use crate::plan::tube::Tube;

    /// A path of straights and bends from 0.3 mm to 3 m.
    fn path(random: &mut ChaCha8Rng) -> Vec<Point> {
        let length = 0.3 * 10_f64.powf(random.random_range(0.0..4.0));
        let chords = random.random_range(2..40);
        let mut heading = random.random_range(-3.0..3.0);
        let mut points = vec![Point::origin()];
        for _ in 0..chords {
            heading += random.random_range(-0.7..0.7) * random.random_range(0.0_f64..1.0).powi(3);
            let share = random.random_range(0.2..1.8);
            points.push(points[points.len() - 1] + Heading::new(heading).unit() * (share * length / f64::from(chords)));
        }
        points
    }

    /// A way along a curve and its bounds; the blade's radius is 0 or 4.4 mm in turn.
    fn task(curve: &Curve, seed: u64) -> (Way<'_>, Bounds) {
        let end = curve.breaks()[curve.breaks().len() - 1];
        let blade = Blade { width: 6.6, radius: [0.0, 4.4][(seed % 2) as usize] };
        let (entry, near) = (Entry::Steady(0.0), Rotation(0.0));
        let course = Course { law: Law::Tangent, entry, to: end, blade, near };
        let way = Way::new(curve, &course).expect("a tangent is everywhere");
        let axes = MachineProfile::default().axes.limits();
        (way, Bounds { axes, feed: Feed::new(&[0.0, end], &[760.0]) })
    }

    #[test]
    fn window_by_window_a_run_takes_as_long_as_at_once() {
        let whole = Windows { size: usize::MAX, ..WINDOWS };
        let small = Windows { size: 2 * WINDOWS.overlap, ..WINDOWS };
        let mut divided = 0;
        for seed in 0..60 {
            let mut random = ChaCha8Rng::seed_from_u64(seed);
            let mut points = path(&mut random);
            for _ in 0..3 {
                let (more, from) = (path(&mut random), points[points.len() - 1]);
                points.extend(more[1..].iter().map(|point| from + point.coords));
            }
            let curve = smooth(&Tube::new(points, 0.05, &MachineProfile::default())).expect("a curve").curve;
            let (way, bounds) = task(&curve, seed);
            let problem = Problem::new(&way, &bounds, 1.0);
            divided += u32::from(problem.free().len() > small.size);
            let [at_once, by_window] = [whole, small].map(|w| problem.fastest(w).expect("a motion").duration());
            assert!((by_window / at_once - 1.0).abs() < 1e-3, "seed {seed}: {by_window} s against {at_once} s");
        }
        assert!(divided > 20, "only {divided} of them are divided");
    }

    #[test]
    fn twice_the_knots_make_no_run_faster_by_more_than_a_fiftieth() {
        let profile = MachineProfile::default();
        let slower = |seed: u64| {
            let points = path(&mut ChaCha8Rng::seed_from_u64(seed));
            let curve = smooth(&Tube::new(points, 0.05, &profile)).expect("a curve").curve;
            let (way, bounds) = task(&curve, seed);
            let duration = |density| profile_on(&way, &bounds, density).expect("a motion").duration();
            (duration(1.0) / duration(2.0), seed)
        };
        let worst = (0..1000).map(slower).max_by(|a, b| a.0.total_cmp(&b.0)).expect("runs");
        assert!(worst.0 <= 1.02, "seed {} is {} times slower than with twice the knots", worst.1, worst.0);
    }
}
