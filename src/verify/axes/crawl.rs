//! How slowly the knife goes on while it is down: one that crawls, or stands, heats the cloth and fuses its edges.
//!
//! Rows with a time show it: how long a millimetre takes, beside what it may take from rest to rest. G-code asks by F.
//! A move uses a limit by the speed that F asks for over the greatest that the limit allows. Of the limits that bear on it
//! (the feed of what it cuts, the axes, and what a planner makes of an arc) one is enough: that one is why it is no faster.
//! `gcode` asks for all of one of them.

use std::f64::consts::PI;

use crate::geom::Point;
use crate::ir::verdict::Worst;
use crate::machine::{Limits, MachineProfile};
use crate::verify::rules;

/// How many times as long as its limits let it a move may take: half the speed that the profile asks for is somebody's
/// choice, a tenth is a slip. The slowest cuts that cutter files ask for, M67, have 60 percent of a feed.
pub(crate) const SLOWNESS_MAX: f64 = 4.0;
/// Part of its acceleration that a planner has left along an arc between two other moves: half of it is for the move
/// that blends in, half of that leans towards the centre.
const ARC_SHARE: f64 = 0.25;

/// The way that is looked at, mm: shorter ones are the matter of starts and stops.
pub(crate) const WAY: f64 = 1.0;

/// The longest that a blade stays within a millimetre, in times of what it may take: `fair` s. Rows are given by their
/// times, s, and the places of the tip.
pub(crate) fn longest(times: &[f64], tips: &[Point], fair: f64) -> (f64, usize) {
    let last = times.len() - 1;
    let mut longest = (0.0, 0);
    let mut end = 0;
    for start in 0..=last {
        while end < last && (tips[end] - tips[start]).norm() < WAY {
            end += 1;
        }
        let time = (times[end] - times[start]) / fair;
        if time > longest.0 {
            longest = (time, start);
        }
    }
    longest
}

/// How long a blade may take to plunge, to go a millimetre at `speed` mm/s and to turn round, from rest to rest, s. An axis
/// that goes d from rest to rest takes no longer than d/v + 2 sqrt(d/a) + 2 a/j.
pub(crate) fn fair_time(profile: &MachineProfile, speed: f64) -> f64 {
    let [x, y, c] = profile.axes.limits();
    let time = |way: f64, speed: f64, limits: &Limits| {
        let Limits { acceleration, jerk, .. } = *limits;
        way / speed.min(limits.speed) + 2.0 * (way / acceleration).sqrt() + 2.0 * acceleration / jerk
    };
    let straight = time(WAY, speed, &x).max(time(WAY, speed, &y));
    profile.knife.plunge() + straight + time(PI, f64::INFINITY, &c)
}

/// The rule, nothing seen yet.
pub(in crate::verify) fn worst() -> Worst {
    Worst::new(&rules::CRAWL, Some(SLOWNESS_MAX))
}

/// What F asks for of a move.
#[derive(Debug, Clone, Copy)]
pub(in crate::verify) struct Asked {
    /// Speed of the C axis over the table, mm/s.
    pub(in crate::verify) speed: f64,
    /// Speed of C itself, rad/s, without sign.
    pub(in crate::verify) turn: f64,
    /// Way of the C axis, mm.
    pub(in crate::verify) length: f64,
    /// Curvature of that, per mm, without sign; 0 = straight.
    pub(in crate::verify) curvature: f64,
}

/// Limits of the axes, as they bear on F.
#[derive(Debug, Clone, Copy)]
pub(in crate::verify) struct Axes {
    /// Of the slower one of X and Y, mm/s.
    speed: f64,
    /// Of the weaker one of X and Y, mm/s2.
    acceleration: f64,
    /// Of C, rad/s.
    turn: f64,
    /// How far the controller may leave the path to round it, mm; 0 = it stops between moves or plans otherwise.
    blend: f64,
    /// Most moves a second that the controller plans; infinite where it keeps up.
    moves: f64,
}

impl Axes {
    pub(in crate::verify) fn new(profile: &MachineProfile) -> Self {
        let [x, y, c] = profile.axes.limits();
        Self {
            speed: x.speed.min(y.speed),
            acceleration: x.acceleration.min(y.acceleration),
            turn: c.speed,
            blend: profile.gcode.blend_mm.unwrap_or(0.0),
            moves: profile.gcode.max_blocks_s.unwrap_or(f64::INFINITY),
        }
    }

    /// The greatest share of a limit of the axes, or of the moves of the controller, that a move uses.
    pub(in crate::verify) fn used(&self, asked: &Asked) -> f64 {
        let arc = if asked.curvature > 0.0 && self.blend > 0.0 { self.arc_speed(asked) } else { f64::INFINITY };
        (asked.speed / self.speed.min(arc).min(asked.length * self.moves)).max(asked.turn / self.turn)
    }

    /// The speed beyond which an arc gains nothing, mm/s. Between rests it comes to sqrt(a l), a what acceleration is left
    /// along it. At a speed v its acceleration leans by v^2 k / (2 a) where it begins, which is a kink that a planner slows
    /// down for: what an arc gains in speed it loses at its ends from sqrt(2 a sqrt(t / k)) on, t the blend.
    fn arc_speed(&self, asked: &Asked) -> f64 {
        let reached = ARC_SHARE * self.acceleration * asked.length;
        let kinked = 2.0 * self.acceleration * (self.blend / asked.curvature).sqrt();
        reached.min(kinked).max(reached - kinked).sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_limit_that_a_move_uses_is_enough() {
        let axes = Axes::new(&MachineProfile::default());
        let check = |[speed, turn, length, curvature]: [f64; 4], expected: f64| {
            let used = axes.used(&Asked { speed, turn, length, curvature });
            assert!((used - expected).abs() < 1e-3, "{used} {expected}");
        };
        check([120.0, 0.0, 5.0, 0.0], 0.1);
        check([120.0, 0.5 * 1080_f64.to_radians(), 5.0, 0.0], 0.5);
        // A short arc comes to sqrt(8000 * 0.5 / 4) = 31.6 mm/s between rests, a long one of radius 10 mm begins at
        // sqrt(2 * 8000 * sqrt(0.05 * 10)) = 106.4 mm/s; one that is longer still may ask for more.
        check([31.6, 0.0, 0.5, 0.1], 1.0);
        check([106.4, 0.0, 8.0, 0.1], 1.0);
        check([169.4, 0.0, 20.0, 0.1], 1.0);
    }
}
