//! A blade that plunged as a chord comes to the tangent of its way: C and the way of its axis, part by part.
//!
//! What is left of the lead is [`left_of`] the fade. On each part C turns evenly. The axis goes beside the tip by the
//! radius of the blade, and while that swings, its way does not turn as the tip's does: each part has the arc on which
//! the tip is as little askew at its start as at its end, and parts are halved until that is little enough.

use super::fit::Arc;
use crate::geom::fade::left_of;
use crate::geom::{Rotation, Vector, angle, left};
use crate::ir::toolpath::Pose;

/// Greatest second derivative of the step by which the blade fades from chord to tangent, over its length squared.
const FADE_BEND: f64 = 7.6;
/// Smaller leads are none, rad.
const LEAD_EPSILON: f64 = 1e-6;
/// Part of the permitted angle by which C may be off its orientation on a part; the way of the tip may be off by as much.
const BEND_SHARE: f64 = 0.5;
/// Shorter ways are none, mm.
const LENGTH_EPSILON: f64 = 1e-3;
/// Steps of the secant method that finds an arc: it is nearly a line.
const SECANTS: usize = 2;
/// By how much the way of the axis may turn more or less than the tip's on a part, rad.
const TURN_MAX: f64 = 0.3;
/// Turns that differ by less are the same, rad.
const TURN_EPSILON: f64 = 1e-12;

/// The fade of one run.
#[derive(Debug, Clone, Copy)]
pub(super) struct Fade {
    /// How far the tangent is ahead of the blade at the plunge, rad.
    pub(super) lead: f64,
    /// Way of the tip over which that fades, mm.
    pub(super) length: f64,
    /// From the axis to the tip, mm.
    pub(super) radius: f64,
    /// By how much C and the way of the tip may be off, rad.
    pub(super) permitted: f64,
}

/// A part of an arc of the tip on which C turns evenly.
#[derive(Debug, Clone, Copy)]
pub(super) struct FadeStep {
    /// Where it ends on the arc, mm.
    pub(super) to: f64,
    /// C there, rad.
    pub(super) c: f64,
    /// How far the way of the axis turns on it, rad.
    pub(super) turn: f64,
}

/// An arc of the tip, and where it lies on its run.
#[derive(Debug, Clone, Copy)]
pub(super) struct Beside<'a> {
    pub(super) arc: &'a Arc,
    /// Direction at its start, rad, unwrapped.
    pub(super) tangent: f64,
    /// Way of the tip up to it, mm.
    pub(super) done: f64,
}

impl Fade {
    /// The fade of a lead over at most `width` mm of a way.
    pub(super) fn new(lead: f64, [width, way]: [f64; 2], radius: f64, permitted: f64) -> Self {
        Self { lead, length: if lead.abs() > LEAD_EPSILON { width.min(way) } else { 0.0 }, radius, permitted }
    }

    /// C at a length of an arc, rad.
    pub(super) fn c(&self, beside: Beside, s: f64) -> f64 {
        let lag = if self.length > 0.0 { self.lead * left_of((beside.done + s) / self.length)[0] } else { 0.0 };
        beside.tangent + beside.arc.curvature * s - lag
    }

    /// The parts of an arc: those that the blade fades on, and the rest, none shorter than `least` but the last.
    pub(super) fn parts(&self, beside: Beside, least: f64) -> Vec<FadeStep> {
        let Beside { arc, done, .. } = beside;
        let rest = FadeStep { to: arc.length, c: self.c(beside, arc.length), turn: arc.turn() };
        let fading = (self.length - done).clamp(0.0, arc.length);
        if fading < LENGTH_EPSILON {
            return vec![rest];
        }
        let fading = if arc.length - fading < least { arc.length } else { fading };
        let longest = self.length * (8.0 * BEND_SHARE * self.permitted / (FADE_BEND * self.lead.abs())).sqrt();
        let mut count = (fading / longest).ceil().max(1.0) as usize;
        let mut parts = loop {
            let (parts, askew) = self.divided(beside, fading, count);
            if askew <= BEND_SHARE * self.permitted || fading / (2 * count) as f64 <= least {
                break parts;
            }
            count *= 2;
        };
        if fading < arc.length {
            parts.push(FadeStep { turn: arc.curvature * (arc.length - fading), ..rest });
        }
        parts
    }

    /// The first `fading` mm of an arc in equal parts, and how far the tip is askew on them at the most, rad.
    fn divided(&self, beside: Beside, fading: f64, count: usize) -> (Vec<FadeStep>, f64) {
        let arc = beside.arc;
        let mut worst = 0.0_f64;
        let mut before = self.end(beside, 0.0);
        let part = |i: usize| {
            let to = fading * i as f64 / count as f64;
            let end = self.end(beside, to);
            let (turn, askew) = self.arc([before, end], arc.curvature * fading / count as f64);
            worst = worst.max(askew);
            before = end;
            FadeStep { to, c: end.pose.c.0, turn }
        };
        let parts = (1..=count).map(part).collect();
        (parts, worst)
    }

    fn end(&self, beside: Beside, s: f64) -> End {
        let c = Rotation(self.c(beside, s));
        End { pose: Pose { centre: beside.arc.at(s) - c.unit() * self.radius, c }, along: beside.arc.along_at(s) }
    }

    /// How far the way of the axis turns between two ends on which C turns evenly, when the tip is as little askew as can
    /// be, and how far that is, rad; `turn` is the tip's.
    fn arc(&self, [from, to]: [End; 2], turn: f64) -> (f64, f64) {
        let chord = to.pose.centre - from.pose.centre;
        let swing = self.radius * (to.pose.c.0 - from.pose.c.0);
        // The tip's way at both ends for an arc of the axis that turns by `turn`, against what it should be.
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
        // On a very short part rounding alone may ask for any turn.
        if (at - turn).abs() < TURN_MAX && found < of_tip { (at, found) } else { (turn, of_tip) }
    }
}

/// An end of a part.
#[derive(Debug, Clone, Copy)]
struct End {
    pose: Pose,
    /// Unit vector along the tip's way.
    along: Vector,
}
