//! Fade of a blade that plunged as a chord to the tangent of its path: C and the path of its axis, step by step.
//!
//! The remaining lead follows [`left_of`]. Within each step C turns uniformly. The axis runs beside the tip at the radius of
//! the blade; while that radius swings, the path of the axis turns differently from that of the tip. Each step uses the arc
//! whose tip direction error is the same at both ends. Steps are halved until that error is small enough.

use super::fit::Arc;
use crate::geom::fade::left_of;
use crate::geom::{Rotation, Vector, angle, left};
use crate::ir::toolpath::Pose;

/// Maximum second derivative of the fade by the fraction of its length, per unit of lead.
const FADE_BEND: f64 = 7.6;
/// Lead below which no fade is needed, rad.
const LEAD_EPSILON: f64 = 1e-6;
/// Fraction of the permitted angle that C may deviate within a step. The direction of the tip's path may deviate by the same
/// amount.
const BEND_SHARE: f64 = 0.5;
/// Length below which a fade is ignored, mm.
const LENGTH_EPSILON: f64 = 1e-3;
/// Secant iterations to find the turn of an arc; the function is nearly linear.
const SECANTS: usize = 2;
/// Maximum difference between the turns of the axis and of the tip on a step, rad.
const TURN_MAX: f64 = 0.3;
/// Change of the direction error below which the secant iteration stops, rad.
const TURN_EPSILON: f64 = 1e-12;

/// The fade of one run.
#[derive(Debug, Clone, Copy)]
pub(super) struct Fade {
    /// Angle from the blade to the tangent at the plunge, rad.
    pub(super) lead: f64,
    /// Length of the tip's path over which the lead fades, mm.
    pub(super) length: f64,
    /// Distance from the axis to the tip, mm.
    pub(super) radius: f64,
    /// Permitted deviation of C and of the direction of the tip's path, rad.
    pub(super) permitted: f64,
}

/// A step: a part of an arc of the tip with uniform turning of C.
#[derive(Debug, Clone, Copy)]
pub(super) struct FadeStep {
    /// End of the step on the arc, mm from the start of the arc.
    pub(super) to: f64,
    /// C at that end, rad.
    pub(super) c: f64,
    /// Turn of the axis path on the step, rad.
    pub(super) turn: f64,
}

/// An arc of the tip and its position on the run.
#[derive(Debug, Clone, Copy)]
pub(super) struct Beside<'a> {
    pub(super) arc: &'a Arc,
    /// Direction at the start of the arc, rad, unwrapped.
    pub(super) tangent: f64,
    /// Length of the tip's path before the arc, mm.
    pub(super) done: f64,
}

impl Fade {
    /// The fade of a lead over the width of the blade, or over the whole path where that is shorter, mm.
    pub(super) fn new(lead: f64, [width, way]: [f64; 2], radius: f64, permitted: f64) -> Self {
        Self { lead, length: if lead.abs() > LEAD_EPSILON { width.min(way) } else { 0.0 }, radius, permitted }
    }

    /// C at a length along an arc, rad.
    pub(super) fn c(&self, beside: Beside, s: f64) -> f64 {
        let lag = if self.length > 0.0 { self.lead * left_of((beside.done + s) / self.length)[0] } else { 0.0 };
        beside.tangent + beside.arc.curvature * s - lag
    }

    /// Divides an arc into the steps of the fade and the remainder. No step but the last is shorter than `least` mm.
    pub(super) fn parts(&self, beside: Beside, least: f64) -> Vec<FadeStep> {
        let Beside { arc, done, .. } = beside;
        let rest = FadeStep { to: arc.length, c: self.c(beside, arc.length), turn: arc.turn() };
        let fading = (self.length - done).clamp(0.0, arc.length);
        if fading < LENGTH_EPSILON {
            return vec![rest];
        }
        let fading = if arc.length - fading < least { arc.length } else { fading };
        let longest = self.length * (8.0 * BEND_SHARE * self.permitted / (FADE_BEND * self.lead.abs())).sqrt();
        let mut count = (fading / longest).ceil().min((fading / least).floor()).max(1.0) as usize;
        let mut parts = loop {
            let is_finest = fading / (2 * count) as f64 <= least;
            let most = if is_finest { f64::INFINITY } else { BEND_SHARE * self.permitted };
            if let Some(parts) = self.divided(beside, fading, count, most) {
                break parts;
            }
            count *= 2;
        };
        if fading < arc.length {
            parts.push(FadeStep { turn: arc.curvature * (arc.length - fading), ..rest });
        }
        parts
    }

    /// The first `fading` mm of an arc in equal steps; `None` if the direction error of the tip exceeds `most` rad on one of them.
    fn divided(&self, beside: Beside, fading: f64, count: usize, most: f64) -> Option<Vec<FadeStep>> {
        let arc = beside.arc;
        let mut before = self.end(beside, 0.0);
        let part = |i: usize| {
            let to = fading * i as f64 / count as f64;
            let end = self.end(beside, to);
            let (turn, askew) = self.arc([before, end], arc.curvature * fading / count as f64);
            before = end;
            if askew > most { None } else { Some(FadeStep { to, c: end.pose.c.0, turn }) }
        };
        (1..=count).map(part).collect()
    }

    fn end(&self, beside: Beside, s: f64) -> End {
        let c = Rotation(self.c(beside, s));
        End { pose: Pose { centre: beside.arc.at(s) - c.unit() * self.radius, c }, along: beside.arc.along_at(s) }
    }

    /// Turn of the axis path between two ends with uniform turning of C, chosen to minimise the direction error of the tip, and
    /// that error, rad. `turn` is the turn of the tip's path.
    fn arc(&self, [from, to]: [End; 2], turn: f64) -> (f64, f64) {
        let chord = to.pose.centre - from.pose.centre;
        let swing = self.radius * (to.pose.c.0 - from.pose.c.0);
        // Direction error of the tip at both ends when the axis follows an arc that turns by `turn`.
        let askew = |turn: f64| {
            let half = 0.5 * turn;
            let stretch = if half == 0.0 { 1.0 } else { half / half.sin() };
            [(from, -half), (to, half)].map(|(end, by)| {
                let (sin, cos) = by.sin_cos();
                let axis = Vector::new(chord.x * cos - chord.y * sin, chord.x * sin + chord.y * cos) * stretch;
                angle::turn(end.along, axis + left(end.pose.c.unit()) * swing)
            })
        };
        let gap = |[start, end]: [f64; 2]| end - start;
        let worst = |askew: [f64; 2]| askew.into_iter().map(f64::abs).fold(0.0, f64::max);
        let as_tip = askew(turn);
        let mut gap_low = gap(as_tip);
        let (mut low, mut at) = (turn, turn - gap_low);
        for _ in 0..SECANTS {
            let gap_at = gap(askew(at));
            if (gap_at - gap_low).abs() < TURN_EPSILON {
                break;
            }
            let next = at - gap_at * (at - low) / (gap_at - gap_low);
            (low, gap_low, at) = (at, gap_at, next);
        }
        let [found, of_tip] = [worst(askew(at)), worst(as_tip)];
        // On a very short step rounding alone may suggest any turn.
        if (at - turn).abs() < TURN_MAX && found < of_tip { (at, found) } else { (turn, of_tip) }
    }
}

/// One end of a step.
#[derive(Debug, Clone, Copy)]
struct End {
    pose: Pose,
    /// Unit vector along the tip's path.
    along: Vector,
}
