//! Fade of the blade from the chord at the plunge to the tangent of its path, as smooth as the path itself.
//!
//! The lead is the angle from the blade to the tangent. After a length s of the tip's path it is the lead at the plunge times
//! [`left_of`] s / l, with l the length of the fade. s is measured along the curve and not by its parameter: on a tight curve
//! the difference exceeds the permitted heading error.

use crate::geom::fade::left_of;
use crate::geom::{Vector, spline};
use crate::plan::spline::Curve;

/// Positive nodes and weights of Gauss-Legendre quadrature with five points, and those of the middle. They measure a span of a
/// smooth curve to within rounding.
const GAUSS_5: [(f64, f64); 3] = [
    (0.0, 0.568_888_888_888_888_9),
    (0.538_469_310_105_683_1, 0.478_628_670_499_366_47),
    (0.906_179_845_938_664, 0.236_926_885_056_189_08),
];
/// Bisection steps that locate the end of a fade, down to rounding for any span.
const BISECTIONS: usize = 60;

/// Lead of the path's tangent over the blade after a plunge, by the parameter of its curve.
#[derive(Debug)]
pub(super) struct Fade {
    /// Parameters of the plunge and of the breaks of the curve up to the end of the fade.
    breaks: Vec<f64>,
    /// Length of the tip's path up to each of them, mm.
    ways: Vec<f64>,
    /// Parameter at the end of the fade.
    to: f64,
    /// Lead at the plunge, rad.
    lead: f64,
    /// Length of the fade, mm.
    length: f64,
}

/// Speed of the tip along its curve and its first two derivatives, by the parameter.
pub(super) type Pace = [f64; 3];

impl Fade {
    /// The fade of `lead` over at most `length` mm of the curve between two parameters.
    pub(super) fn new(curve: &Curve, [from, to]: [f64; 2], lead: f64, length: f64) -> Self {
        let mut fade = Self { breaks: vec![from], ways: vec![0.0], to, lead, length };
        let inner = curve.breaks().iter().copied().filter(|&b| b > from && b < to);
        for end in inner.chain(std::iter::once(to)) {
            let (last, way) = (fade.breaks[fade.breaks.len() - 1], fade.ways[fade.ways.len() - 1]);
            let part = way_between(curve, [last, end]);
            if way + part >= length {
                fade.to = end_of(curve, [last, end], length - way);
                return fade;
            }
            fade.breaks.push(end);
            fade.ways.push(way + part);
        }
        fade.length = fade.ways[fade.ways.len() - 1];
        fade
    }

    /// Lead at the plunge, rad.
    pub(super) fn lead(&self) -> f64 {
        self.lead
    }

    /// Remaining lead at a parameter, rad, and its derivatives up to the third; `None` when none remains.
    pub(super) fn at(&self, curve: &Curve, u: f64, [s1, s2, s3]: Pace) -> Option<[f64; 4]> {
        if u >= self.to || self.lead == 0.0 {
            return None;
        }
        let i = self.breaks.partition_point(|&b| b <= u).max(1) - 1;
        let way = self.ways[i] + way_between(curve, [self.breaks[i], u]);
        let [f, f1, f2, f3] = left_of(way / self.length);
        let [f1, f2, f3] = [f1 / self.length, f2 / self.length.powi(2), f3 / self.length.powi(3)];
        // Chain rule for f(s(u)).
        let d = [f, f1 * s1, f2 * s1 * s1 + f1 * s2, f3 * s1.powi(3) + 3.0 * f2 * s1 * s2 + f1 * s3];
        Some(d.map(|value| self.lead * value))
    }
}

/// The parameter in an interval at which the length from its start is `way`, mm.
fn end_of(curve: &Curve, [from, to]: [f64; 2], way: f64) -> f64 {
    let (mut low, mut high) = (from, to);
    for _ in 0..BISECTIONS {
        let middle = f64::midpoint(low, high);
        if way_between(curve, [from, middle]) < way {
            low = middle;
        } else {
            high = middle;
        }
    }
    high
}

/// Length of a curve between two parameters of one span, mm.
fn way_between(curve: &Curve, [from, to]: [f64; 2]) -> f64 {
    let (middle, half) = (f64::midpoint(from, to), 0.5 * (to - from));
    let span = spline::span(curve.breaks(), middle);
    let pace = |u: f64| {
        let [_, d] = curve.derivatives_on::<2>(span, u);
        Vector::new(d[0], d[1]).norm()
    };
    let pair = |(node, weight): (f64, f64)| {
        let outer = if node > 0.0 { pace(middle - half * node) } else { 0.0 };
        weight * (outer + pace(middle + half * node))
    };
    half * GAUSS_5.into_iter().map(pair).sum::<f64>()
}
