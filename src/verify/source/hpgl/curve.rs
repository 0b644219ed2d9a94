//! Arcs and Bezier curves, by other formulas than the reader's and with finer chords.
//!
//! An arc is circular in the numbers of the file; under a scale with two factors it is an ellipse on the table.

use std::f64::consts::TAU;

use super::scan::{Chords, Gathered, Place, Scan};
use crate::geom::moments::Moments;

/// Number of chords here per chord of the reader, and maximum number of the reader's chords.
const FINER: usize = 4;
const MOST_CHORDS: f64 = 100_000.0;
/// Rounding error of a number of chords, relative.
const COUNT_EPSILON: f64 = 1e-9;
/// Permitted excess of the length here over the reader's, relative to the shortfall of chords of the greatest length.
const LACKING: f64 = 1.5;
/// Permitted difference of moments, relative to the shortfall of the chords that the reader should have; then where rounding
/// decides between two numbers of chords.
const LACKING_MOMENTS: f64 = 0.1;
const DOUBTFUL_MOMENTS: f64 = 1.0;
/// Height of a triangle, in plotter units, below which its corners are collinear.
const STRAIGHT: f64 = 1e-6;

/// Shortfall of the reader's chords against those here.
#[derive(Debug, Clone, Copy)]
struct Lack {
    moments: Moments,
    slack: Moments,
}

impl Scan<'_> {
    /// Plotter units per unit of the file, along each axis.
    fn factor(&self) -> Place {
        self.scale.map_or([1.0; 2], |[_, factor]| factor)
    }

    /// Vector between two places in numbers of the file.
    fn way(&self, from: Place, to: Place) -> Place {
        let factor = self.factor();
        [(to[0] - from[0]) / factor[0], (to[1] - from[1]) / factor[1]]
    }

    /// End points of the chords of an arc around a centre.
    pub(super) fn arc(&self, from: Place, centre: Place, sweep: f64) -> Chords {
        let factor = self.factor();
        let sagitta = self.sagitta / factor[0].abs().max(factor[1].abs());
        let [x, y] = self.way(centre, from);
        let radius = x.hypot(y);
        let sweep = sweep.clamp(-TAU, TAU);
        if radius <= 0.0 || sweep == 0.0 {
            return Chords { points: Vec::new(), share: 0.0 };
        }
        let step = 2.0 * (1.0 - (sagitta / radius).min(0.5)).acos();
        let (chords, share) = chords(sweep.abs() / step);
        let at = |i: usize| self.on_arc([from, centre], sweep * i as f64 / chords as f64);
        Chords { points: (1..=chords).map(at).collect(), share }
    }

    /// Place rotated about a centre by `angle` rad. A full turn ends exactly where it started, despite rounding.
    pub(super) fn on_arc(&self, [from, centre]: [Place; 2], angle: f64) -> Place {
        if angle == 0.0 || angle.abs() >= TAU {
            return from;
        }
        let (factor, [x, y]) = (self.factor(), self.way(centre, from));
        let (sin, cos) = angle.sin_cos();
        [centre[0] + factor[0] * (x * cos - y * sin), centre[1] + factor[1] * (x * sin + y * cos)]
    }

    /// Allows the reader's chords of a curve the shortfall of every fourth place here; for the curves of a polygon this is done
    /// when it is drawn. The curve starts at the pen.
    pub(super) fn allow(&mut self, Chords { points, share }: &Chords) {
        let from = self.pen.at;
        if self.part.is_some() {
            self.curves.push(Gathered { from, first: self.polygon.len(), count: points.len(), share: *share });
        } else {
            let lack = self.lacking(from, points, *share);
            self.lack(lack);
        }
    }

    /// Allows the shortfall of all curves of the polygon, which is drawn now under the current rotation.
    pub(super) fn allow_polygon(&mut self) {
        for i in 0..self.curves.len() {
            let Gathered { from, first, count, share } = self.curves[i];
            let points: Vec<Place> = self.polygon[first..first + count].iter().map(|corner| corner.at).collect();
            let lack = self.lacking(from, &points, share);
            self.lack(lack);
        }
    }

    fn lacking(&self, from: Place, points: &[Place], share: f64) -> Lack {
        let of = |step: usize| {
            let points = points.iter().copied().skip(step - 1).step_by(step);
            Moments::of(std::iter::once(from).chain(points).map(|place| self.point(place)))
        };
        let moments = of(1) - of(FINER);
        Lack { moments, slack: moments.magnitudes() * share }
    }

    fn lack(&mut self, Lack { moments, slack }: Lack) {
        if moments == Moments::default() {
            return;
        }
        self.stroke -= moments;
        self.slack.moments += slack;
        self.slack.length += moments.length() * LACKING;
        self.slack.bounds = self.slack.sagitta;
    }

    pub(super) fn beziers(&mut self, is_relative: bool) {
        loop {
            let cause = self.at;
            let mut controls = [0.0; 6];
            for control in &mut controls {
                let Some(number) = self.number() else { return };
                *control = number;
            }
            let place = |k: usize| self.target([controls[k], controls[k + 1]], is_relative);
            let p = [self.pen.at, place(0), place(2), place(4)];
            if !self.leaves_trace() {
                self.go(p[3], cause, false);
                continue;
            }
            let bend = |i: usize| {
                let of = |axis: usize| p[i][axis] - 2.0 * p[i + 1][axis] + p[i + 2][axis];
                of(0).hypot(of(1))
            };
            let (chords, share) = chords((0.75 * bend(0).max(bend(1)) / self.sagitta).sqrt());
            let at = |i: usize| {
                let t = i as f64 / chords as f64;
                // De Casteljau's algorithm.
                let mix = |a: Place, b: Place| [a[0] + (b[0] - a[0]) * t, a[1] + (b[1] - a[1]) * t];
                let (a, b, c) = (mix(p[0], p[1]), mix(p[1], p[2]), mix(p[2], p[3]));
                if i == chords { p[3] } else { mix(mix(a, b), mix(b, c)) }
            };
            let points = (1..=chords).map(at).collect();
            self.follow(&Chords { points, share }, cause);
        }
    }

    /// Centre and sweep of the arc through three places; `None` if they are collinear, or as far as rounding can tell.
    pub(super) fn circle(&self, [from, middle, to]: [Place; 3]) -> Option<(Place, f64)> {
        let factor = self.factor();
        // Rounding is scaled like everything else.
        let straight = STRAIGHT / factor[0].abs().min(factor[1].abs());
        let (a, b) = (self.way(from, middle), self.way(from, to));
        let length = |v: Place| v[0].hypot(v[1]);
        let placed = |seen: Place| [from[0] + factor[0] * seen[0], from[1] + factor[1] * seen[1]];
        if length(b) < straight {
            return (length(a) > straight).then(|| (placed([a[0] / 2.0, a[1] / 2.0]), TAU));
        }
        // The bisectors of the two chords from the start meet at the centre.
        let cross = a[0] * b[1] - a[1] * b[0];
        let half_square = |v: Place| f64::midpoint(v[0] * v[0], v[1] * v[1]);
        let (aa, bb) = (half_square(a), half_square(b));
        let seen = [(aa * b[1] - bb * a[1]) / cross, (bb * a[0] - aa * b[0]) / cross];
        let longest = length(a).max(length(b)).max(length([b[0] - a[0], b[1] - a[1]]));
        if !seen[0].is_finite() || !seen[1].is_finite() || cross.abs() < straight * longest {
            return None;
        }
        let angle = |p: Place| (p[1] - seen[1]).atan2(p[0] - seen[0]);
        let turn = (angle(b) - angle([0.0, 0.0])).rem_euclid(TAU);
        Some((placed(seen), if cross > 0.0 { turn } else { turn - TAU }))
    }
}

/// Number of chords if the reader needs `needed`, and the permitted difference of moments as a share of the shortfall.
fn chords(needed: f64) -> (usize, f64) {
    // At least one: a curve that hardly bends becomes a line.
    let whole = |needed: f64| needed.ceil().clamp(1.0, MOST_CHORDS);
    let least = whole(needed * (1.0 - COUNT_EPSILON));
    let is_doubtful = least < whole(needed * (1.0 + COUNT_EPSILON));
    (least as usize * FINER, if is_doubtful { DOUBTFUL_MOMENTS } else { LACKING_MOMENTS })
}
