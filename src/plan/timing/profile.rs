//! The near time-optimal jerk-limited motion along a path: u(t) from rest to rest.
//!
//! The unknown is b(u) = (du/dt)^2, so that u'' = b'/2 and u''' = sqrt(b) b''/2, and on each axis
//!
//! - velocity: q'^2 b <= V^2
//! - acceleration: |q' b'/2 + q'' b| <= A
//! - jerk: sqrt(b) |q' b''/2 + 3/2 q'' b' + q''' b| <= J
//!
//! and |p'|^2 b <= feed^2 for the tip. From rest b ~ u^(4/3), so b = w(u) beta(u), where w carries that singularity and beta is
//! a cubic B-spline. The duration, the integral of du / sqrt(b), is minimised by a barrier with Newton steps from a strictly
//! feasible start ([`barrier`]; the change of variable after Verscheure et al., *Time-Optimal Path Tracking for Robots: A
//! Convex Optimization Approach*, 2009). A small enough constant beta is always feasible, so every run has a motion.

use std::ops::Range;

use arrayvec::ArrayVec;
use wide::f64x4;

use super::clock::Clock;
use super::feed::Feed;
use super::grid::{self, Grid};
use super::place::{BOUNDS, Bounded, LANES, Load, Loads, Model};
use crate::geom::spline::{self, Piecewise};
use crate::machine::Limits;
use crate::plan::orientation::{Walk, Way};
use crate::plan::solver::banded::BandMatrix;
use crate::plan::solver::barrier::{self, Forces, Outside, Schedule, Walls};
use crate::plan::solver::windows::{self, Chain, Windows};

/// Order of beta: cubic.
const ORDER: usize = 4;
/// Reaches a third of a thousandth of the duration in about twenty steps, whatever the size.
const SCHEDULE: Schedule =
    Schedule { start: 0.3, growth: 10.0, gap: 3e-4, decrement: 0.03, steps_a_round: 12, steps: 150 };
/// The overlap covers the influence of the rest of the run. It reaches back over the knots within which the axes come to rest:
/// at most some 270 per second of turning C, and some ten over which the barrier's own choice fades.
const WINDOWS: Windows = Windows { schedule: SCHEDULE, size: 3000, overlap: 120 };
/// Scale of the start relative to the limits.
const START_SHARE: f64 = 0.7;
/// Maximum length over which an end of a run has influence, mm.
const END_REACH: f64 = 2.0;
/// Minimum distance of two collocation places, mm; closer ones are redundant.
const PLACE_EPSILON: f64 = 1e-7;

/// No motion was found: a numerical failure, since a slow enough motion always exists.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::plan) struct NoMotion;

/// Limits of a motion: those of the axes (x, y, c) and the speed cap of the tip.
#[derive(Debug, Clone)]
pub(in crate::plan) struct Bounds {
    /// Limits of x, y, c in mm, rad, s.
    pub(in crate::plan) axes: [Limits; 3],
    /// Speed cap of the tip along the path parameter.
    pub(in crate::plan) feed: Feed,
}

/// The motion along `way` within `bounds`, from rest to rest.
pub(in crate::plan) fn profile(way: &Way, bounds: &Bounds) -> Result<Clock, NoMotion> {
    profile_on(way, bounds, 1.0)
}

/// The motion with `density` times the usual number of knots.
fn profile_on(way: &Way, bounds: &Bounds, density: f64) -> Result<Clock, NoMotion> {
    Problem::new(way, bounds, density).fastest(WINDOWS)
}

/// The weight w(u) = (g(u) g(L - u))^(4/3), g = u / (u + u0): the behaviour of b near both ends.
#[derive(Debug, Clone, Copy)]
pub(in crate::plan) struct Ends {
    /// Length of the path in the parameter, mm.
    pub(in crate::plan) length: f64,
    /// Length over which an end has influence, mm.
    pub(in crate::plan) reach: f64,
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

/// The optimisation problem of one run. Tables at its places are computed window by window: all at once would not fit into the
/// caches.
struct Problem<'a> {
    way: &'a Way<'a>,
    bounds: &'a Bounds,
    breaks: Vec<f64>,
    /// Breaks, with those at the ends repeated to the order of the spline.
    knots: Vec<f64>,
    /// Stations where the limits hold, mm from the start.
    stations: Vec<f64>,
    ends: Ends,
}

/// A place where the limits hold.
struct LimitPlace {
    /// Index of the first of its four control values.
    first: usize,
    /// b, b' and b'', as rows over four control values.
    rows: [[f64; ORDER]; 3],
}

/// A set of places where the limits hold, evaluated at once.
struct LimitPlaces {
    /// At least one, at most [`LANES`].
    all: ArrayVec<LimitPlace, LANES>,
    loads: Loads,
}

/// Quadrature nodes of a span in the integral for the duration.
struct Nodes {
    /// Index of the first of its four control values.
    first: usize,
    /// b at all nodes, as a row over four control values.
    row: [f64x4; ORDER],
    weight: f64x4,
}

/// The first four control values of a slice.
fn four(control: &[[f64; 1]]) -> [f64; ORDER] {
    control.as_flattened().first_chunk().copied().expect("each span has four control values")
}

fn dot(a: &[f64; ORDER], control: &[f64; ORDER]) -> f64 {
    a[0] * control[0] + a[1] * control[1] + a[2] * control[2] + a[3] * control[3]
}

impl<'a> Problem<'a> {
    fn new(way: &'a Way<'a>, bounds: &'a Bounds, density: f64) -> Self {
        let length = way.to - way.from;
        let ends = Ends { length, reach: END_REACH.min(length / 8.0) };
        let inside = |u: &f64| *u > way.from && *u < way.to;
        let changes: Vec<f64> = bounds.feed.changes().iter().copied().filter(inside).map(|u| u - way.from).collect();
        let mut path_breaks: Vec<f64> =
            way.breaks().iter().map(|b| b - way.from).chain(changes.iter().copied()).collect();
        path_breaks.sort_by(f64::total_cmp);
        let breaks = grid::breaks(way, &path_breaks, &changes, &Grid { reach: ends.reach, density });
        let knots = spline::clamped_knots::<ORDER>(&breaks);
        let stations = grid::places(&breaks, &path_breaks, PLACE_EPSILON);
        Self { way, bounds, breaks, knots, stations, ends }
    }

    /// The limits at a station.
    fn load(&self, walk: &mut Walk, s: f64) -> Load {
        let u = self.way.from + s;
        Load::new(&walk.at(u), &self.bounds.axes, self.bounds.feed.at(u))
    }

    /// b, b' and b'' at a station, as rows over the four control values of its span.
    fn rows(&self, span: usize, s: f64) -> [[f64; ORDER]; 3] {
        let [w, w1, w2] = self.ends.weight(s);
        let [n0, n1, n2] = spline::basis::<ORDER, 3>(&self.knots, span, s);
        [
            n0.map(|n0| w * n0),
            std::array::from_fn(|i| w1 * n0[i] + w * n1[i]),
            std::array::from_fn(|i| w2 * n0[i] + 2.0 * w1 * n1[i] + w * n2[i]),
        ]
    }

    /// The collocation places of some spans.
    fn places(&self, spans: Range<usize>) -> Vec<LimitPlaces> {
        let last = self.breaks.len() - 1;
        let first = |span: usize| match span {
            0 => 0,
            _ if span == last => self.stations.len(),
            _ => self.stations.partition_point(|&s| s < self.breaks[span]),
        };
        let stations = &self.stations[first(spans.start)..first(spans.end)];
        let mut walk = self.way.walk(self.way.from + self.breaks[spans.start]);
        let mut span = spans.start;
        let mut places = Vec::with_capacity(stations.len().div_ceil(LANES));
        for stations in stations.chunks(LANES) {
            let (mut all, mut loads) = (ArrayVec::new(), ArrayVec::<Load, LANES>::new());
            for &s in stations {
                while span + 1 < last && self.breaks[span + 1] <= s {
                    span += 1;
                }
                all.push(LimitPlace { first: span, rows: self.rows(span, s) });
                loads.push(self.load(&mut walk, s));
            }
            places.push(LimitPlaces { all, loads: Loads::of(&loads) });
        }
        places
    }

    /// The quadrature nodes of some spans.
    fn nodes(&self, spans: Range<usize>) -> Vec<Nodes> {
        let of_span = |span: usize| {
            let gauss = grid::cell(&self.breaks, span).gauss();
            let rows = gauss.map(|(s, _)| {
                let [beta] = spline::basis::<ORDER, 1>(&self.knots, span, s);
                let [w, ..] = self.ends.weight(s);
                beta.map(|v| w * v)
            });
            let row = std::array::from_fn(|i| f64x4::new(rows.map(|row| row[i])));
            Nodes { first: span, row, weight: f64x4::new(gauss.map(|(_, weight)| weight)) }
        };
        spans.map(of_span).collect()
    }

    /// A constant beta well inside every limit.
    fn feasible_start(&self) -> Vec<[f64; 1]> {
        let mut walk = self.way.walk(self.way.from);
        let mut used = [0.0_f64; 3];
        for &s in &self.stations {
            let parts = self.load(&mut walk, s).parts(&self.ends.weight(s));
            used = std::array::from_fn(|k| used[k].max(parts[k]));
        }
        let [speed, acceleration, jerk] = used;
        let room = (1.0 / speed).min(1.0 / acceleration).min(jerk.powf(-2.0 / 3.0));
        vec![[START_SHARE * room]; spline::control_count::<ORDER>(&self.breaks)]
    }

    fn fastest(&self, windows: Windows) -> Result<Clock, NoMotion> {
        let control = windows::minimise(self, self.feasible_start(), windows).ok_or(NoMotion)?;
        Ok(self.clock(&control))
    }

    /// The motion as time over the parameter.
    fn clock(&self, control: &[[f64; 1]]) -> Clock {
        let beta = Piecewise::<ORDER, 1>::from_control(self.breaks.clone(), control);
        let pace = |span: usize, s: f64| {
            let [w, w1, _] = self.ends.weight(s);
            let [[v], [v1]] = beta.derivatives_on::<2>(span, s);
            (w * v, w1 * v + w * v1)
        };
        Clock::new(self.way.from, &self.breaks, pace)
    }
}

impl Chain<1> for Problem<'_> {
    type Part<'a>
        = Window
    where
        Self: 'a;

    fn free(&self) -> Range<usize> {
        0..spline::control_count::<ORDER>(&self.breaks)
    }

    fn part(&self, free: Range<usize>) -> (Window, Range<usize>) {
        let spans = free.start.saturating_sub(ORDER - 1)..free.end.min(self.breaks.len() - 1);
        let near = spans.start..spans.end + ORDER - 1;
        let (places, nodes) = (self.places(spans.clone()), self.nodes(spans));
        (Window { places, nodes, near: near.clone(), free }, near)
    }
}

/// A window of a problem: some control values are free, the others fixed.
struct Window {
    /// Places and nodes that depend on the free control values.
    places: Vec<LimitPlaces>,
    nodes: Vec<Nodes>,
    /// Indices of the control values in the tables, and of the free ones among them.
    near: Range<usize>,
    free: Range<usize>,
}

/// Gradient and Hessian by the four control values of a span.
#[derive(Default)]
struct Block {
    slope: f64x4,
    /// Hessian, column by column; only the lower triangle is used.
    bend: [f64x4; ORDER],
}

impl Block {
    /// Adds the exact contribution of the nodes of a span to the duration.
    fn add_nodes(&mut self, nodes: &Nodes, control: &[f64; ORDER], weight: f64) {
        let b = nodes.paces(control);
        let slopes = f64x4::splat(-0.5 * weight) * nodes.weight / (b * b.sqrt());
        let bends = (f64x4::splat(-1.5) * slopes / b).to_array();
        let rows = nodes.row.map(f64x4::to_array);
        for (node, (slope, bend)) in slopes.to_array().into_iter().zip(bends).enumerate() {
            let row = rows.map(|row| row[node]);
            let lanes = f64x4::new(row);
            self.slope += f64x4::splat(slope) * lanes;
            let half = f64x4::splat(bend) * lanes;
            for (column, value) in self.bend.iter_mut().zip(row) {
                *column += half * f64x4::splat(value);
            }
        }
    }

    /// Adds the contribution of the limits at a place.
    fn add_place(&mut self, place: &LimitPlace, model: &Model) {
        let rows = place.rows.map(f64x4::new);
        let [g0, g1, g2] = model.slope.map(f64x4::splat);
        self.slope += g0 * rows[0] + g1 * rows[1] + g2 * rows[2];
        let [h0, h1, h2] = model.times(&rows);
        for (j, column) in self.bend.iter_mut().enumerate() {
            let [r0, r1, r2] = place.rows.map(|row| f64x4::splat(row[j]));
            *column += h0 * r0 + h1 * r1 + h2 * r2;
        }
    }

    /// The Hessian, row by row.
    fn rows(&self) -> [[f64; ORDER]; ORDER] {
        let columns = self.bend.map(f64x4::to_array);
        std::array::from_fn(|i| columns.map(|column| column[i]))
    }
}

impl barrier::Problem<1> for Window {
    /// The duration, s.
    fn objective(&self, control: &[[f64; 1]]) -> f64 {
        let times = self.nodes.iter().flat_map(|nodes| {
            let b = nodes.paces(&four(&control[nodes.first - self.near.start..]));
            (nodes.weight / b.sqrt()).to_array()
        });
        times.sum()
    }

    fn slacks(&self, control: &[[f64; 1]], slacks: &mut Vec<f64>) -> Result<(), Outside> {
        slacks.resize(BOUNDS * LANES * self.places.len() + control.len(), 0.0);
        let (of_places, positive) = slacks.split_at_mut(BOUNDS * LANES * self.places.len());
        for (places, slacks) in self.places.iter().zip(of_places.as_chunks_mut::<LANES>().0.as_chunks_mut::<BOUNDS>().0)
        {
            let here = places.loads.slacks(&places.paces(control, self.near.start));
            // The root of a negative b is NaN, so that no slack is positive.
            let is_positive = |slack: &f64x4| slack.simd_gt(f64x4::ZERO);
            if !here[1..].iter().fold(is_positive(&here[0]), |all, slack| all & is_positive(slack)).all() {
                return Err(Outside);
            }
            slacks.iter_mut().zip(here).for_each(|(slack, here)| *slack = here.to_array());
        }
        // A B-spline lies within the hull of its control values, so b is positive between the nodes too.
        positive.copy_from_slice(control.as_flattened());
        if positive.iter().all(|&value| value > 0.0) { Ok(()) } else { Err(Outside) }
    }

    fn idle(&self) -> usize {
        self.places.last().map_or(0, |places| BOUNDS * (LANES - places.all.len()))
    }

    fn newton(&self, control: &[[f64; 1]], forces: &Forces) -> Option<(Vec<[f64; 1]>, f64)> {
        let mut hessian = BandMatrix::<ORDER>::zero(control.len());
        let mut gradient = vec![0.0; control.len()];
        let [walls, positive] = forces.walls.split_at(BOUNDS * LANES * self.places.len());
        for (i, wall) in positive.iter().enumerate() {
            hessian.add_entry(i, i, wall.bend());
            gradient[i] -= wall.slope;
        }
        let mut add = |first: usize, block: &Block| {
            hessian.add_block(first, &block.rows());
            gradient[first..].iter_mut().zip(block.slope.to_array()).for_each(|(sum, slope)| *sum += slope);
        };
        for nodes in &self.nodes {
            let first = nodes.first - self.near.start;
            let mut block = Block::default();
            block.add_nodes(nodes, &four(&control[first..]), forces.weight);
            add(first, &block);
        }
        let mut open: Option<(usize, Block)> = None;
        for (places, [slopes, shares]) in self.places.iter().zip(bounded(walls)) {
            let models = places.loads.models(&places.paces(control, self.near.start), &slopes, &shares);
            for (lane, place) in places.all.iter().enumerate() {
                if let Some((first, block)) = open.take_if(|(first, _)| *first != place.first) {
                    add(first - self.near.start, &block);
                }
                open.get_or_insert_with(|| (place.first, Block::default())).1.add_place(place, &models.at(lane));
            }
        }
        if let Some((first, block)) = open {
            add(first - self.near.start, &block);
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

/// The walls of the places that are evaluated together: their slopes and their shares.
fn bounded(walls: Walls<'_>) -> impl Iterator<Item = [Bounded; 2]> {
    let of_lanes = |values: &[[f64; LANES]; BOUNDS]| values.map(f64x4::new);
    let [slopes, shares] = [walls.slopes, walls.shares].map(|values| values.as_chunks().0.as_chunks().0.iter());
    slopes.zip(shares).map(move |(slopes, shares)| [of_lanes(slopes), of_lanes(shares)])
}

impl LimitPlaces {
    /// b, b' and b'' at each place; 1 in unused lanes.
    fn paces(&self, control: &[[f64; 1]], near: usize) -> [f64x4; 3] {
        let mut paces = [[1.0; LANES]; 3];
        for (lane, place) in self.all.iter().enumerate() {
            let control = four(&control[place.first - near..]);
            for (pace, row) in paces.iter_mut().zip(&place.rows) {
                pace[lane] = dot(row, &control);
            }
        }
        paces.map(f64x4::new)
    }
}

impl Nodes {
    /// b at each node.
    fn paces(&self, control: &[f64; ORDER]) -> f64x4 {
        let [c0, c1, c2, c3] = control.map(f64x4::splat);
        self.row[0] * c0 + self.row[1] * c1 + self.row[2] * c2 + self.row[3] * c3
    }
}

#[cfg(test)]
mod tests {
    use rand::{RngExt, SeedableRng};
    use rand_chacha::ChaCha8Rng;

    use super::*;
    use crate::geom::{Heading, Point, Rotation};
    use crate::ir::toolpath::OrientationMode;
    use crate::machine::MachineProfile;
    use crate::plan::orientation::{Blade, Course, Entry};
    use crate::plan::spline::ToleranceBand;
    use crate::plan::spline::{Curve, smooth};

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

    /// A path along a curve, with bounds; the blade's radius alternates between 0 and 4.4 mm.
    fn task(curve: &Curve, seed: u64) -> (Way<'_>, Bounds) {
        let end = curve.breaks()[curve.breaks().len() - 1];
        let blade = Blade { width: 6.6, radius: [0.0, 4.4][(seed % 2) as usize] };
        let (entry, near) = (Entry::Steady(0.0), Rotation(0.0));
        let course = Course { orientation: OrientationMode::Tangent, entry, to: end, blade, near };
        let way = Way::new(curve, &course).expect("a tangent is everywhere");
        let axes = MachineProfile::default().axes.limits();
        (way, Bounds { axes, feed: Feed::new(&[0.0, end], &[760.0]) })
    }

    #[test]
    fn window_by_window_a_run_takes_as_long_as_at_once() {
        let whole = Windows { size: usize::MAX, ..WINDOWS };
        let small = Windows { size: 2 * WINDOWS.overlap, ..WINDOWS };
        let mut divided = 0;
        for seed in 0..6 {
            let mut random = ChaCha8Rng::seed_from_u64(seed);
            let mut points = path(&mut random);
            for _ in 0..3 {
                let (more, from) = (path(&mut random), points[points.len() - 1]);
                points.extend(more[1..].iter().map(|point| from + point.coords));
            }
            let curve = smooth(&ToleranceBand::new(points, 0.05, &MachineProfile::default())).expect("a curve").curve;
            let (way, bounds) = task(&curve, seed);
            let problem = Problem::new(&way, &bounds, 1.0);
            divided += u64::from(problem.free().len() > small.size);
            let [at_once, by_window] = [whole, small].map(|w| problem.fastest(w).expect("a motion").duration());
            assert!((by_window / at_once - 1.0).abs() < 1e-3, "seed {seed}: {by_window} s against {at_once} s");
        }
        assert!(divided > 2, "only {divided} of them are divided");
    }

    /// Expects that twice the knots make no run faster by more than a fiftieth.
    fn check_knots(seeds: impl Iterator<Item = u64>) {
        let profile = MachineProfile::default();
        let slower = |seed: u64| {
            let points = path(&mut ChaCha8Rng::seed_from_u64(seed));
            let curve = smooth(&ToleranceBand::new(points, 0.05, &profile)).expect("a curve").curve;
            let (way, bounds) = task(&curve, seed);
            let duration = |density| profile_on(&way, &bounds, density).expect("a motion").duration();
            (duration(1.0) / duration(2.0), seed)
        };
        let worst = seeds.map(slower).max_by(|a, b| a.0.total_cmp(&b.0)).expect("runs");
        assert!(worst.0 <= 1.02, "seed {} is {} times slower than with twice the knots", worst.1, worst.0);
    }

    #[test]
    fn twice_the_knots_make_no_run_of_a_point_faster_by_more_than_a_fiftieth() {
        check_knots((0..100).step_by(2));
    }

    #[test]
    fn twice_the_knots_make_no_run_of_a_blade_faster_by_more_than_a_fiftieth() {
        check_knots((1..100).step_by(2));
    }
}
