//! Discretisation of a motion along a path: knots, collocation places and quadrature cells in the path parameter, counted from
//! the start of the run.

use crate::plan::orientation::Way;
use crate::plan::solver::windows::LENGTH_FELT;

/// Turn of C per knot, rad (4 degrees).
const TURN_A_KNOT: f64 = 0.069_813_170_079_773_18;
/// Change of C's slope per knot, rad (8 degrees).
const BEND_A_KNOT: f64 = 0.139_626_340_159_546_36;
/// Maximum number of knots per mm due to a change of slope, and in total.
const BEND_KNOTS_MAX: f64 = 20.0;
const KNOTS_MAX: f64 = 200.0;
/// Knots per unit of the logarithm of the distance from an end.
const END_KNOTS: f64 = 1.2;
/// Distance from an end below which grading stops, as a fraction of the reach of an end.
const END_NEAREST: f64 = 1e-3;
/// Distance from a change of the speed cap below which grading stops, mm.
const CHANGE_NEAREST: f64 = 0.1;
/// Maximum spacing: a fraction of the length, but at least 0.25 mm.
const SPACING_SHARE: f64 = 1.0 / 60.0;
const SPACING: f64 = 0.25;
/// Minimum number of knots.
const KNOTS_MIN: usize = 24;
/// Number of samples of the knot density: per span of the path, along the whole run, and towards each end.
const DENSITY_A_SPAN: usize = 8;
const DENSITY_OVERALL: usize = 200;
const DENSITY_AT_END: usize = 80;
/// Fractions of a knot span where limits hold, starting at its first knot; and additional fractions of the first and the last
/// span, near the ends.
const PLACES_A_SPAN: [f64; 3] = [0.0, 1.0 / 3.0, 2.0 / 3.0];
const PLACES_AT_END: [f64; 2] = [1e-3, 0.1];

/// Resolution of a motion.
#[derive(Debug, Clone, Copy)]
pub(super) struct Grid {
    /// Length over which an end of the run has influence, mm.
    pub(super) reach: f64,
    /// Factor on the usual number of knots.
    pub(super) density: f64,
}

/// The knots of a motion. They are dense where C turns or its slope changes, and graded towards the ends and the `changes` of
/// the speed cap. `path_breaks` must include those changes.
pub(super) fn breaks(way: &Way, path_breaks: &[f64], changes: &[f64], grid: &Grid) -> Vec<f64> {
    let reach = grid.reach;
    let length = way.to - way.from;
    let mut places: Vec<f64> = Vec::with_capacity(DENSITY_A_SPAN * path_breaks.len() + 400);
    for ends in path_breaks.windows(2) {
        let step = (ends[1] - ends[0]) / DENSITY_A_SPAN as f64;
        places.extend((0..DENSITY_A_SPAN).map(|i| ends[0] + step * i as f64));
    }
    places.extend((0..=DENSITY_OVERALL).map(|i| length * i as f64 / DENSITY_OVERALL as f64));
    let nearest = END_NEAREST * reach;
    for i in 0..=DENSITY_AT_END {
        let share = i as f64 / DENSITY_AT_END as f64;
        let from_end = nearest * ((1.0 + length / nearest).ln() * share).exp_m1();
        places.extend([from_end.min(length), (length - from_end).max(0.0)]);
    }
    places.sort_by(f64::total_cmp);
    places.dedup();
    let spacing = (length.min(LENGTH_FELT) * SPACING_SHARE).max(SPACING);
    let mut walk = way.walk(way.from);
    let mut density = |s: f64| {
        let [_, q1, q2, _] = walk.at(way.from + s).q;
        let turn = q1[2].abs() / TURN_A_KNOT + (q2[2].abs() / BEND_A_KNOT).sqrt().min(BEND_KNOTS_MAX);
        let end = s.min(length - s).max(nearest);
        let next = changes.partition_point(|&change| change < s);
        let away = |i: Option<usize>| i.and_then(|i| changes.get(i)).map_or(f64::INFINITY, |change| (change - s).abs());
        let change = away(Some(next)).min(away(next.checked_sub(1))).max(CHANGE_NEAREST);
        (1.0 / spacing + turn + END_KNOTS / end + END_KNOTS / change).min(KNOTS_MAX.max(END_KNOTS / end))
    };
    let mut count = Vec::with_capacity(places.len());
    let (mut total, mut before) = (0.0, (places[0], density(places[0])));
    count.push(0.0);
    for &s in &places[1..] {
        let here = density(s);
        total += f64::midpoint(before.1, here) * (s - before.0);
        count.push(total);
        before = (s, here);
    }
    let knots = ((total * grid.density) as usize + 1).max((KNOTS_MIN as f64 * grid.density) as usize);
    let mut breaks = Vec::with_capacity(knots);
    let mut at = 0;
    for i in 0..knots {
        let wanted = total * i as f64 / (knots - 1) as f64;
        while at + 2 < count.len() && count[at + 1] < wanted {
            at += 1;
        }
        let share = ((wanted - count[at]) / (count[at + 1] - count[at])).clamp(0.0, 1.0);
        breaks.push(places[at] + (places[at + 1] - places[at]) * share);
    }
    breaks[0] = 0.0;
    breaks[knots - 1] = length;
    breaks
}

/// The collocation places, where the limits hold: three per span, some near the ends, and the breaks of the path's own
/// polynomials, where the slope of the curvature jumps.
pub(super) fn places(breaks: &[f64], path_breaks: &[f64], nearest: f64) -> Vec<f64> {
    let last = breaks.len() - 1;
    let length = breaks[last];
    let (first_span, last_span) = (breaks[1], length - breaks[last - 1]);
    let mut places: Vec<f64> = breaks
        .windows(2)
        .flat_map(|ends| PLACES_A_SPAN.map(|share| ends[0] + (ends[1] - ends[0]) * share))
        .skip(1)
        .collect();
    for share in PLACES_AT_END {
        places.extend([first_span * share, length - last_span * share]);
    }
    let inner: Vec<f64> = path_breaks.iter().copied().filter(|&b| b > breaks[1] && b < breaks[last - 1]).collect();
    places.extend(inner.windows(2).map(|w| f64::midpoint(w[0], w[1])));
    places.extend(inner);
    places.sort_by(f64::total_cmp);
    places.dedup_by(|next, kept| *next - *kept <= nearest);
    places
}

/// A knot span as an interval of z, the cube root of the distance to the nearer end. In z the integrand of the duration, du /
/// sqrt(b) = 3 z^2 dz / sqrt(b), is smooth, since b ~ u^(4/3).
#[derive(Debug, Clone, Copy)]
pub(super) struct Cell {
    z: [f64; 2],
    /// Position of the end of the run when z counts backward from there; `None` when z counts from the start.
    from_end: Option<f64>,
}

/// The cell of a span.
pub(super) fn cell(breaks: &[f64], span: usize) -> Cell {
    let ends = [breaks[span], breaks[span + 1]];
    if span < breaks.len() / 2 {
        Cell { z: ends.map(f64::cbrt), from_end: None }
    } else {
        let length = breaks[breaks.len() - 1];
        Cell { z: ends.map(|end| (length - end).max(0.0).cbrt()), from_end: Some(length) }
    }
}

/// The cells of all spans, in order.
pub(super) fn cells(breaks: &[f64]) -> impl Iterator<Item = Cell> + '_ {
    (0..breaks.len() - 1).map(|span| cell(breaks, span))
}

/// Number of quadrature nodes per cell.
pub(super) const GAUSS: usize = 4;
/// Positive nodes and weights of Gauss-Legendre quadrature with four points.
const GAUSS_4: [(f64, f64); 2] =
    [(0.339_981_043_584_856_3, 0.652_145_154_862_546_1), (0.861_136_311_594_052_6, 0.347_854_845_137_453_85)];

impl Cell {
    /// The part of the cell between the fractions `a` and `b`.
    pub(super) fn part(&self, a: f64, b: f64) -> Self {
        let [z0, z1] = self.z;
        Self { z: [z0 + (z1 - z0) * a, z0 + (z1 - z0) * b], ..*self }
    }

    /// The parameter at z.
    fn place(&self, z: f64) -> f64 {
        let distance = z * z * z;
        self.from_end.map_or(distance, |end| end - distance)
    }

    /// The parameter at the cell's end.
    pub(super) fn end(&self) -> f64 {
        self.place(self.z[1])
    }

    /// Nodes and weights for an integral over the parameter.
    pub(super) fn gauss(&self) -> [(f64, f64); GAUSS] {
        let [z0, z1] = self.z;
        let (middle, half) = (f64::midpoint(z0, z1), (z1 - z0) / 2.0);
        let node = |x: f64, weight: f64| {
            let z = middle + half * x;
            (self.place(z), 3.0 * z * z * weight * half.abs())
        };
        let [(a, wa), (b, wb)] = GAUSS_4;
        [node(-b, wb), node(-a, wa), node(a, wa), node(b, wb)]
    }
}
