//! How the blade comes from the chord that it plunged as to the tangent of its path: over a way of its tip, as smoothly as
//! the path itself.
//!
//! The lead of the tangent over the blade is what it was at the plunge times what is [`left_of`] it at s / l, s the way
//! of the tip and l the length of the fade. s is measured along the curve and not by its parameter: on a tight curve
//! the two differ by more than a heading may be off.

use crate::geom::fade::left_of;
use crate::geom::{Vector, spline};
use crate::plan::spline::Curve;

/// Positive nodes and weights of Gauss-Legendre quadrature with five points, and those of the middle: a span of a smooth
/// curve is measured to rounding.
const GAUSS_5: [(f64, f64); 3] = [
    (0.0, 0.568_888_888_888_888_9),
    (0.538_469_310_105_683_1, 0.478_628_670_499_366_47),
    (0.906_179_845_938_664, 0.236_926_885_056_189_08),
];
/// Halvings that place the end of a fade: down to rounding from any span.
const BISECTIONS: usize = 60;

/// The lead of a path's tangent over the blade behind a plunge, by the parameter of its curve.
#[derive(Debug)]
pub(super) struct Fade {
    /// Parameters where it is measured from: the plunge, and the breaks of the curve up to the end of the fade.
    breaks: Vec<f64>,
    /// Way of the tip up to each of them, mm.
    ways: Vec<f64>,
    /// Parameter at its end.
    to: f64,
    /// The lead at the plunge, rad.
    lead: f64,
    /// Way over which it fades, mm.
    length: f64,
}

/// Speed of the tip along its curve and its derivatives, by the parameter.
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

    /// The lead at the plunge, rad.
    pub(super) fn lead(&self) -> f64 {
        self.lead
    }

    /// What is left of the lead at a parameter, rad, and its derivatives up to the third; `None` when nothing is.
    pub(super) fn at(&self, curve: &Curve, u: f64, [s1, s2, s3]: Pace) -> Option<[f64; 4]> {
        if u >= self.to || self.lead == 0.0 {
            return None;
        }
        let i = self.breaks.partition_point(|&b| b <= u).max(1) - 1;
        let way = self.ways[i] + way_between(curve, [self.breaks[i], u]);
        let [f, f1, f2, f3] = left_of(way / self.length);
        let [f1, f2, f3] = [f1 / self.length, f2 / self.length.powi(2), f3 / self.length.powi(3)];
        // The chain rule for f(s(u)).
        let d = [f, f1 * s1, f2 * s1 * s1 + f1 * s2, f3 * s1.powi(3) + 3.0 * f2 * s1 * s2 + f1 * s3];
        Some(d.map(|value| self.lead * value))
    }
}

/// The parameter between two at which the way from the first is `way`.
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

/// The way along a curve between two parameters of one span, mm.
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
