//! The smoothest curve inside a tolerance band: a degree-5 B-spline r(u) over the chord length that minimises the integral of
//! |r'''|^2, with its deviation below the tolerance at dense samples and fixed end points.
//!
//! Jerk along a path contains k'' v^3 (k = curvature), so the path must be smooth to the third derivative of its direction;
//! arcs, lines and cubic fits are not. The method has two phases: penalised least squares gives a strictly feasible start, then
//! a barrier with Newton steps ([`barrier`]) brings it to the optimum, window by window. All matrices are banded, so time and
//! memory are linear in the number of knots.

use std::ops::Range;

use super::band::{Section, ToleranceBand};
use super::knots;
use crate::geom::spline::{self, Piecewise};
use crate::geom::{Point, Vector};
use crate::plan::solver::banded::BandMatrix;
use crate::plan::solver::barrier::{self, Forces, Outside, Schedule, Wall};
use crate::plan::solver::windows::{self, Chain, LENGTH_FELT, Windows};

/// Order of the spline: degree 5, so that curvature has two continuous derivatives and a third one almost everywhere.
const ORDER: usize = 6;
/// Half bandwidth + 1 of the systems in one coordinate, and in both interleaved.
const BAND: usize = ORDER;
const BAND_XY: usize = 2 * ORDER;
/// Order of the derivative whose square is minimised: 3 beat 2 and 4 in program time.
const PENALTY_ORDER: usize = 3;
/// Fraction of the tolerance that the samples may use; the rest covers the curve between them.
const SHARE: f64 = 0.94;
/// Reduction of that fraction when the curve leaves the band between the samples.
const SHARE_STEP: f64 = 0.03;
/// Samples per span of the spline, besides the vertices.
const SAMPLES_A_SPAN: usize = 3;
/// Samples per span in the check between them.
const CHECKS_A_SPAN: usize = 9;
/// Maximum attempts with ever finer knots, and the factor on the spacing near violations.
const ATTEMPTS: usize = 8;
const FINER: f64 = 0.6;
/// Gap of a five-hundredth of the penalty. Twice that makes random runs slower by 0.2 % on average; half of it makes the
/// contours of the benchmark scores slower again.
const SCHEDULE: Schedule =
    Schedule { start: 0.05, growth: 15.0, gap: 2e-3, decrement: 0.03, steps_a_round: 12, steps: 90 };
/// The overlap covers the influence of an end, some ten control points.
const WINDOWS: Windows = Windows { schedule: SCHEDULE, size: 3000, overlap: 60 };
/// Minimum distance of two samples, as a fraction of the length; closer ones are redundant.
const SAMPLE_EPSILON: f64 = 1e-7;

/// A smooth path: position over chord length, mm.
pub(in crate::plan) type Curve = Piecewise<ORDER, 2>;

/// No curve was found inside the band.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::plan) struct TooTight {
    /// Least deviation reached, mm.
    pub(in crate::plan) deviation: f64,
}

/// Result of the smoothing.
#[derive(Debug)]
pub(in crate::plan) struct Smooth {
    /// The curve; its parameter runs from 0 to the band's length.
    pub(in crate::plan) curve: Curve,
    /// Greatest part of a chord sagitta used by the curve, mm.
    pub(in crate::plan) sagitta: f64,
}

/// The smoothest curve inside the band.
pub(in crate::plan) fn smooth(band: &ToleranceBand) -> Result<Smooth, TooTight> {
    let mut finer = vec![1.0; band.points.len()];
    let mut worst = f64::INFINITY;
    let mut share = SHARE;
    for _ in 0..ATTEMPTS {
        let problem = Problem::new(band, knots::breaks(band, &finer), share * band.tolerance);
        let start = problem.feasible_start();
        let trouble = match start {
            Ok((control, weight)) => {
                let start = problem.relax(control, weight);
                let mut control = windows::minimise(&problem, start.clone(), WINDOWS).unwrap_or(start);
                if let Some(lap) = &band.lap {
                    control = lap.closed(control, &problem.breaks);
                }
                let curve = problem.curve(&control);
                let (violations, deviation, sagitta) = problem.check(&curve);
                if violations.is_empty() {
                    return Ok(Smooth { curve, sagitta });
                }
                worst = worst.min(deviation);
                share -= SHARE_STEP;
                violations
            }
            Err((violations, deviation)) => {
                worst = worst.min(deviation);
                violations
            }
        };
        refine(band, &mut finer, &trouble, problem.median_span());
    }
    Err(TooTight { deviation: worst })
}

/// True if the polyline of a ring extends far enough for its curve to be closed.
pub(in crate::plan) fn has_room(band: &ToleranceBand) -> bool {
    band.lap.is_none_or(|lap| lap.has_room(&knots::breaks(band, &vec![1.0; band.points.len()])))
}

/// Reduces the spacing at the vertices near violations.
fn refine(band: &ToleranceBand, finer: &mut [f64], trouble: &[f64], median_span: f64) {
    let reach = (2.0 * median_span).max(1.0);
    for (factor, &station) in finer.iter_mut().zip(&band.stations) {
        let next = trouble.partition_point(|&u| u < station);
        let near = |u: Option<&f64>| u.is_some_and(|u| (u - station).abs() < reach);
        if near(trouble.get(next)) || next > 0 && near(trouble.get(next - 1)) {
            *factor *= FINER;
        }
    }
}

type Control = Vec<[f64; 2]>;

/// A place where the deviation is bounded.
struct Sample {
    /// Station, mm of chord length.
    u: f64,
    /// Index of the first of its control points.
    first: usize,
    /// Weights of its control points.
    weights: [f64; ORDER],
    /// Cross-section of the band.
    section: Section,
}

impl Sample {
    /// Position, given the control points from `first` on.
    fn point(&self, control: &[[f64; 2]]) -> Point {
        let control: &[[f64; 2]; ORDER] = control.first_chunk().expect("each sample has as many as the order");
        let mut point = Point::origin();
        for (weight, c) in self.weights.iter().zip(control) {
            point.x += weight * c[0];
            point.y += weight * c[1];
        }
        point
    }

    fn deviation(&self, control: &[[f64; 2]]) -> Vector {
        self.section.deviation(self.point(control)).0
    }

    /// Use of the tolerance, scaled to the full one, mm: the deviation divided by its share.
    fn used(&self, control: &[[f64; 2]]) -> f64 {
        self.deviation(control).norm() / self.section.share
    }
}

/// One attempt: a choice of knots, with everything that is constant over the iterations.
struct Problem<'a> {
    band: &'a ToleranceBand,
    breaks: Vec<f64>,
    /// Breaks, with those at the ends repeated to the order of the spline.
    knots: Vec<f64>,
    samples: Vec<Sample>,
    /// Length represented by each sample in least squares, mm.
    shares: Vec<f64>,
    /// Sum of squares of the samples, and the penalty, as matrices in one coordinate.
    squares: BandMatrix<BAND>,
    penalty: BandMatrix<BAND>,
    /// Bound on the deviation of the samples, mm.
    bound: f64,
    /// Penalty of a curve that counts as smooth: 36 t^2 / L^5, that of r = t (u/L)^3 with the tolerance t and the length L. A
    /// short run fits its band as a parabola, which has no penalty; the rest is then the barrier's choice.
    least: f64,
}

impl<'a> Problem<'a> {
    fn new(band: &'a ToleranceBand, breaks: Vec<f64>, bound: f64) -> Self {
        let knots = spline::clamped_knots::<ORDER>(&breaks);
        let count = spline::control_count::<ORDER>(&breaks);
        let stations = sample_stations(band, &breaks);
        let mut samples = Vec::with_capacity(stations.len());
        let (mut span, mut chord) = (0, 0);
        for &u in &stations {
            while span + 2 < breaks.len() && breaks[span + 1] <= u {
                span += 1;
            }
            while chord + 2 < band.stations.len() && band.stations[chord + 1] <= u {
                chord += 1;
            }
            let [weights] = spline::basis::<ORDER, 1>(&knots, span, u);
            samples.push(Sample { u, first: span, weights, section: band.section(chord, u) });
        }
        let last = samples.len() - 1;
        let shares: Vec<f64> = (0..=last)
            .map(|i| {
                let share = (stations[(i + 1).min(last)] - stations[i.saturating_sub(1)]) / 2.0;
                share.max(SHARE_MIN * band.length().min(LENGTH_FELT))
            })
            .collect();
        let mut squares = BandMatrix::zero(count);
        for (sample, &share) in samples.iter().zip(&shares) {
            squares.add_square(sample.first, &sample.weights, share);
        }
        let penalty = penalty(&knots, 0..breaks.len() - 1);
        let least = 36.0 * band.tolerance.powi(2) / band.length().powi(5);
        Self { band, breaks, knots, samples, shares, squares, penalty, bound, least }
    }

    fn median_span(&self) -> f64 {
        let mut spans: Vec<f64> = self.breaks.windows(2).map(|w| w[1] - w[0]).collect();
        spans.sort_by(f64::total_cmp);
        spans[spans.len() / 2]
    }

    fn curve(&self, control: &[[f64; 2]]) -> Curve {
        Piecewise::from_control(self.breaks.clone(), control)
    }

    /// Penalised least squares through the middle of the band, with fixed ends; `None` when the system is singular.
    fn least_squares(&self, weight: f64) -> Option<Control> {
        let n = self.squares.len();
        let mut matrix = self.squares.clone();
        matrix.add(&self.penalty, weight);
        let mut x: Control = vec![[0.0; 2]; n];
        for (sample, &share) in self.samples.iter().zip(&self.shares) {
            let middle = sample.section.middle();
            for (w, value) in sample.weights.iter().zip(&mut x[sample.first..]) {
                value[0] += w * share * middle.x;
                value[1] += w * share * middle.y;
            }
        }
        for (i, end) in self.ends() {
            matrix.fix(i, |row, entry| {
                x[row][0] -= entry * end[0];
                x[row][1] -= entry * end[1];
            });
        }
        for (i, end) in self.ends() {
            x[i] = end;
        }
        matrix.factor().ok()?.solve(&mut x);
        Some(x)
    }

    /// The fixed control points: indices and positions.
    fn ends(&self) -> [(usize, [f64; 2]); 2] {
        let points = &self.band.points;
        let end = |p: Point| [p.x, p.y];
        [(0, end(points[0])), (self.squares.len() - 1, end(points[points.len() - 1]))]
    }

    fn greatest_deviation(&self, control: &[[f64; 2]]) -> f64 {
        self.samples.iter().map(|s| s.used(&control[s.first..])).fold(0.0, f64::max)
    }

    /// A curve strictly inside the band, with the weight of the penalty that gave it. The error has the stations near the bound
    /// or beyond it, and the least deviation found, mm.
    fn feasible_start(&self) -> Result<(Control, f64), (Vec<f64>, f64)> {
        let mut weight = START_WEIGHT * self.band.tolerance;
        let mut best: Option<(Control, f64)> = None;
        for _ in 0..START_ROUNDS {
            let Some(control) = self.least_squares(weight) else { break };
            let deviation = self.greatest_deviation(&control);
            if deviation < START_SHARE * self.bound {
                return Ok((control, weight));
            }
            if best.as_ref().is_none_or(|(_, least)| deviation < *least) {
                best = Some((control, deviation));
            }
            weight *= 0.1;
        }
        let Some((control, deviation)) = best else { return Err((self.band.stations.clone(), f64::INFINITY)) };
        let out = |s: &&Sample| s.used(&control[s.first..]) > TROUBLE_SHARE * self.bound;
        Err((self.samples.iter().filter(out).map(|s| s.u).collect(), deviation))
    }

    /// Raises the weight of the penalty while the curve stays well inside the band, for a start near the optimum.
    fn relax(&self, mut control: Control, mut weight: f64) -> Control {
        for _ in 0..RELAX_ROUNDS {
            weight *= 3.0;
            let Some(next) = self.least_squares(weight) else { break };
            if self.greatest_deviation(&next) > RELAX_SHARE * self.bound {
                break;
            }
            control = next;
        }
        control
    }

    /// Checks the needed part of the curve between the samples against the full tolerance. Returns the stations of violations,
    /// the greatest deviation and the greatest sagitta used, mm.
    fn check(&self, curve: &Curve) -> (Vec<f64>, f64, f64) {
        let mut violations = Vec::new();
        let (mut deviation, mut sagitta) = (0.0_f64, 0.0_f64);
        let mut chord = 0;
        let last = self.band.lap.map_or(f64::INFINITY, |lap| lap.last);
        for (span, ends) in self.breaks.windows(2).enumerate().take_while(|(_, ends)| ends[0] <= last) {
            for i in 0..CHECKS_A_SPAN {
                let u = ends[0] + (ends[1] - ends[0]) * i as f64 / CHECKS_A_SPAN as f64;
                while chord + 2 < self.band.stations.len() && self.band.stations[chord + 1] <= u {
                    chord += 1;
                }
                let [[x, y]] = curve.derivatives_on::<1>(span, u);
                let section = self.band.section(chord, u);
                let (away, used) = section.deviation(Point::new(x, y));
                let away = away.norm() / section.share;
                deviation = deviation.max(away);
                sagitta = sagitta.max(used);
                if away > CHECK_SHARE * self.band.tolerance {
                    violations.push(u);
                }
            }
        }
        (violations, deviation, sagitta)
    }
}

/// The integral of |r'''|^2 over some spans, as a matrix of the control points with influence there.
fn penalty(knots: &[f64], spans: Range<usize>) -> BandMatrix<BAND> {
    let mut penalty = BandMatrix::zero(spans.len() + ORDER - 1);
    for span in spans.clone() {
        let ends = [knots[span + ORDER - 1], knots[span + ORDER]];
        let half = (ends[1] - ends[0]) / 2.0;
        for (node, weight) in GAUSS_3 {
            let u = f64::midpoint(ends[0], ends[1]) + half * node;
            let ders = spline::basis::<ORDER, { PENALTY_ORDER + 1 }>(knots, span, u);
            penalty.add_square(span - spans.start, &ders[PENALTY_ORDER], half * weight);
        }
    }
    penalty
}

impl Chain<2> for Problem<'_> {
    type Part<'a>
        = Window<'a>
    where
        Self: 'a;

    fn free(&self) -> Range<usize> {
        1..self.squares.len() - 1
    }

    fn part(&self, free: Range<usize>) -> (Window<'_>, Range<usize>) {
        let spans = free.start.saturating_sub(ORDER - 1)..free.end.min(self.breaks.len() - 1);
        let first = |span: usize| self.samples.partition_point(|sample| sample.first < span);
        let samples = &self.samples[first(spans.start)..first(spans.end)];
        let near = spans.start..spans.end + ORDER - 1;
        let penalty = penalty(&self.knots, spans);
        // A run in a single window uses the origin of the file.
        let origin = if free == self.free() { Point::origin() } else { samples[0].section.base };
        let (bound, least) = (self.bound, self.least);
        (Window { samples, penalty, origin, bound, least, near: near.clone(), free }, near)
    }
}

/// A window of a problem: some control points are free, the others fixed.
struct Window<'a> {
    /// Samples that depend on the free control points, and the penalty of their spans.
    samples: &'a [Sample],
    penalty: BandMatrix<BAND>,
    /// Origin of the coordinates in the penalty. In a run of kilometres the square of a coordinate would leave no digits for
    /// its bends.
    origin: Point,
    bound: f64,
    least: f64,
    /// Indices of the control points in the tables, and of the free ones among them.
    near: Range<usize>,
    free: Range<usize>,
}

impl Window<'_> {
    /// The control points relative to the origin, and their product with the penalty.
    fn penalised(&self, control: &[[f64; 2]]) -> (Control, Control) {
        let control: Control = control.iter().map(|c| [c[0] - self.origin.x, c[1] - self.origin.y]).collect();
        let product = self.penalty.times(&control);
        (control, product)
    }
}

impl barrier::Problem<2> for Window<'_> {
    /// Half of the integral of |r'''|^2, plus the negligible penalty of a smooth curve.
    fn objective(&self, control: &[[f64; 2]]) -> f64 {
        let (control, product) = self.penalised(control);
        let penalty: f64 = product.iter().zip(&control).map(|(p, c)| p[0] * c[0] + p[1] * c[1]).sum();
        0.5 * (penalty + self.least)
    }

    fn slacks(&self, control: &[[f64; 2]], slacks: &mut Vec<f64>) -> Result<(), Outside> {
        let square = self.bound * self.bound;
        slacks.clear();
        for sample in self.samples {
            let share = sample.section.share;
            let slack =
                square * share * share - sample.deviation(&control[sample.first - self.near.start..]).norm_squared();
            if slack <= 0.0 || slack.is_nan() {
                return Err(Outside);
            }
            slacks.push(slack);
        }
        Ok(())
    }

    fn newton(&self, control: &[[f64; 2]], forces: &Forces) -> Option<(Vec<[f64; 2]>, f64)> {
        let n = self.penalty.len();
        let mut hessian = BandMatrix::<BAND_XY>::zero(2 * n);
        for i in 0..n {
            for k in 0..BAND.min(i + 1) {
                let entry = forces.weight * self.penalty.entry(i, i - k);
                hessian.add_entry(2 * i, 2 * (i - k), entry);
                hessian.add_entry(2 * i + 1, 2 * (i - k) + 1, entry);
            }
        }
        let mut gradient: Vec<[f64; 1]> = Vec::with_capacity(2 * n);
        for product in self.penalised(control).1 {
            gradient.extend(product.map(|v| [forces.weight * v]));
        }
        let mut walls = forces.walls.iter();
        for samples in self.samples.chunk_by(|a, b| a.first == b.first) {
            let first = samples[0].first - self.near.start;
            let mut block = Block::default();
            for (sample, wall) in samples.iter().zip(walls.by_ref()) {
                block.add(sample, &control[first..], &wall);
            }
            hessian.add_block(2 * first, &block.lower_half());
            for (sum, slope) in gradient[2 * first..].iter_mut().zip(block.slope.as_flattened()) {
                sum[0] += slope;
            }
        }
        let (before, behind) = (2 * (self.free.start - self.near.start), 2 * (self.free.end - self.near.start));
        for fixed in (0..before).chain(behind..2 * n) {
            hessian.fix(fixed, |_, _| {});
            gradient[fixed][0] = 0.0;
        }
        let mut step: Vec<[f64; 1]> = gradient.iter().map(|g| [-g[0]]).collect();
        hessian.factor().ok()?.solve(&mut step);
        let decrement = -step.iter().zip(&gradient).map(|(s, g)| s[0] * g[0]).sum::<f64>();
        (decrement.is_finite()).then(|| (step.chunks_exact(2).map(|s| [s[0][0], s[1][0]]).collect(), decrement))
    }
}

/// Gradient and Hessian of the barrier by the control points of a span.
#[derive(Default)]
struct Block {
    slope: [[f64; 2]; ORDER],
    /// Second derivatives of each pair of control points by x and x, x and y, y and y: the lower triangle.
    bend: [[[f64; 3]; ORDER]; ORDER],
}

impl Block {
    /// Adds the contribution of a sample. With e its deviation, s its slack and P the projection that removes the free
    /// direction, the gradient is 2 e / s and the Hessian is z (2 P + 4 e e^T / s).
    fn add(&mut self, sample: &Sample, near: &[[f64; 2]], wall: &Wall) {
        let point = sample.point(near);
        let e = sample.section.deviation(point).0;
        let force = 2.0 * wall.slope;
        let (plain, steep) = (force * wall.share, 4.0 * wall.bend());
        let mut bend = [plain + steep * e.x * e.x, steep * e.x * e.y, plain + steep * e.y * e.y];
        if let Some(free) = sample.section.free_direction(point) {
            bend[0] -= plain * free.x * free.x;
            bend[1] -= plain * free.x * free.y;
            bend[2] -= plain * free.y * free.y;
        }
        let slope = [force * e.x, force * e.y];
        for i in 0..ORDER {
            let wi = sample.weights[i];
            self.slope[i][0] += wi * slope[0];
            self.slope[i][1] += wi * slope[1];
            let bend = bend.map(|value| wi * value);
            for j in 0..=i {
                for (sum, value) in self.bend[i][j].iter_mut().zip(bend) {
                    *sum += sample.weights[j] * value;
                }
            }
        }
    }

    /// The Hessian with x and y interleaved.
    fn lower_half(&self) -> [[f64; BAND_XY]; BAND_XY] {
        let mut half = [[0.0; BAND_XY]; BAND_XY];
        for i in 0..ORDER {
            for j in 0..=i {
                let [xx, xy, yy] = self.bend[i][j];
                half[2 * i][2 * j] = xx;
                half[2 * i][2 * j + 1] = xy;
                half[2 * i + 1][2 * j] = xy;
                half[2 * i + 1][2 * j + 1] = yy;
            }
        }
        half
    }
}

/// Nodes and weights of Gauss-Legendre quadrature with three points: exact for the square of a third derivative.
const GAUSS_3: [(f64, f64); 3] =
    [(-0.774_596_669_241_483_4, 5.0 / 9.0), (0.0, 8.0 / 9.0), (0.774_596_669_241_483_4, 5.0 / 9.0)];
/// Minimum weight of a sample in least squares, as a fraction of the length, so that every sample counts.
const SHARE_MIN: f64 = 1e-6;
/// Initial weight of the penalty relative to the tolerance, the number of rounds that lower it tenfold, and the fraction of the
/// bound below which the start must lie.
const START_WEIGHT: f64 = 1e-6;
const START_ROUNDS: usize = 14;
const START_SHARE: f64 = 0.999;
/// Fraction of the bound beyond which a sample requests finer knots near it.
const TROUBLE_SHARE: f64 = 0.94;
/// Maximum number of rounds that raise the weight threefold, and the fraction of the bound below which they must stay.
const RELAX_ROUNDS: usize = 80;
const RELAX_SHARE: f64 = 0.8;
/// Fraction of the tolerance that the curve may use anywhere; the rest covers rounding of the output.
const CHECK_SHARE: f64 = 0.995;

/// The vertices and [`SAMPLES_A_SPAN`] places per span, in order, at least [`SAMPLE_EPSILON`] apart.
fn sample_stations(band: &ToleranceBand, breaks: &[f64]) -> Vec<f64> {
    let inner = breaks
        .windows(2)
        .flat_map(|ends| (0..SAMPLES_A_SPAN).map(|i| ends[0] + (ends[1] - ends[0]) * i as f64 / SAMPLES_A_SPAN as f64));
    let mut stations: Vec<f64> = inner.chain(band.stations.iter().copied()).collect();
    stations.sort_by(f64::total_cmp);
    let least = SAMPLE_EPSILON * band.length().min(LENGTH_FELT);
    stations.dedup_by(|next, kept| *next - *kept <= least);
    let last = stations.len() - 1;
    stations[last] = band.length();
    stations
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::machine::MachineProfile;

    fn check(points: Vec<Point>, tolerance: f64) -> Smooth {
        let band = ToleranceBand::new(points, tolerance, &MachineProfile::default());
        let smooth = smooth(&band).expect("a curve inside the band");
        let n = 5000;
        for i in 0..=n {
            let u = band.length() * f64::from(i) / f64::from(n);
            let [[x, y]] = smooth.curve.derivatives::<1>(u);
            let away = band.section(band.chord(u), u).deviation(Point::new(x, y)).0.norm();
            assert!(away <= tolerance, "{away} at {u}");
        }
        smooth
    }

    fn points(coordinates: &[(f64, f64)]) -> Vec<Point> {
        coordinates.iter().map(|&(x, y)| Point::new(x, y)).collect()
    }

    #[test]
    fn a_lone_kink_is_rounded_inside_the_tolerance() {
        for degrees in [1.0_f64, 10.0, 30.0, 44.9] {
            let (sin, cos) = degrees.to_radians().sin_cos();
            check(points(&[(0.0, 0.0), (300.0, 0.0), (300.0 + 200.0 * cos, 200.0 * sin)]), 0.05);
        }
    }

    #[test]
    fn a_staircase_of_file_units_becomes_smooth() {
        let mut stairs = vec![(0.0, 0.0)];
        for i in 0..40 {
            let (x, y) = stairs[stairs.len() - 1];
            stairs.push((x + 2.0, y + if i % 3 == 0 { 0.254 } else { 0.0 }));
        }
        check(points(&stairs), 0.18);
    }

    #[test]
    fn the_flattened_circle_becomes_nearly_the_circle() {
        let ring: Vec<Point> = (0..=40)
            .map(|i| std::f64::consts::TAU * f64::from(i) / 15.0)
            .map(|a| Point::new(6.4 * a.cos(), 6.4 * a.sin()))
            .collect();
        let smooth = check(ring, 0.071);
        assert!(smooth.sagitta > 0.1);
        let [p, d1, d2] = smooth.curve.derivatives::<3>(50.0);
        let curvature = (d1[0] * d2[1] - d1[1] * d2[0]) / d1[0].hypot(d1[1]).powi(3);
        assert!((p[0].hypot(p[1]) - 6.4).abs() < 0.15 && (curvature - 1.0 / 6.4).abs() < 0.01, "{curvature}");
    }

    #[test]
    fn window_by_window_a_curve_is_as_smooth_as_at_once() {
        let mut at_once = None;
        // Again far from the origin of the file, like the end of a run of kilometres.
        for away in [0.0, 1e6] {
            let wave = |i: i32| (away + 2.0 * f64::from(i), 5.0 * (0.2 * f64::from(i)).sin());
            let band =
                ToleranceBand::new(points(&(0..400).map(wave).collect::<Vec<_>>()), 0.05, &MachineProfile::default());
            let problem = Problem::new(&band, knots::breaks(&band, &[1.0; 400]), SHARE * band.tolerance);
            let (control, weight) = problem.feasible_start().expect("a start");
            let start = problem.relax(control, weight);
            let bend = |windows| {
                let control = windows::minimise(&problem, start.clone(), windows).expect("a curve");
                assert!(problem.check(&problem.curve(&control)).0.is_empty(), "it leaves its band");
                let from: Control = control.iter().map(|c| [c[0] - away, c[1]]).collect();
                barrier::Problem::objective(&problem.part(problem.free()).0, &from)
            };
            let small = Windows { size: 2 * WINDOWS.overlap, ..WINDOWS };
            let at_once = *at_once.get_or_insert_with(|| bend(WINDOWS));
            let by_window = bend(small);
            assert!(problem.free().len() > 3 * WINDOWS.overlap);
            assert!((by_window / at_once - 1.0).abs() < SCHEDULE.gap, "{away}: {by_window} against {at_once}");
        }
    }
}
