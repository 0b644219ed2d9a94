//! Slowness of the knife while it is down: a knife that crawls or stands still heats the cloth and fuses its edges.
//!
//! Rows with a time show it directly: the time per millimetre relative to the time that a move from rest to rest may take. In
//! G-code it follows from F. The share of a limit that a move uses is the speed commanded by F divided by the greatest speed
//! that the limit allows. Of the limits on a move (the feed of the cut, the axes, the planner's limit on an arc) a single one
//! that is used suffices, since it explains the speed. `gcode` uses one of them fully.

use std::f64::consts::PI;

use crate::geom::Point;
use crate::ir::verdict::Worst;
use crate::machine::{Limits, MachineProfile};
use crate::verify::rules;

/// Greatest ratio of the time of a move to the time that its limits allow: half the configured speed may be a choice, a tenth
/// is a mistake. The slowest cuts in cutter files, by M67, have 60 percent of a feed.
pub(crate) const SLOWNESS_MAX: f64 = 4.0;
/// Share of the acceleration that a planner has left along an arc between two other moves: half is reserved for the move that
/// blends in, and half of the rest is normal to the path.
const ARC_SHARE: f64 = 0.25;

/// Length of the way that is checked, mm: on shorter ones starts and stops dominate.
pub(crate) const WAY: f64 = 1.0;

/// Longest time that a blade stays within a millimetre, in multiples of `fair` s, and the index of the row where it begins.
/// Rows are given by their times, s, and tip positions.
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

/// Time that a blade may take to plunge, to move a millimetre at `speed` mm/s and to turn by half a turn, from rest to rest, s.
/// An axis that moves by d from rest to rest needs at most d/v + 2 sqrt(d/a) + 2 a/j.
pub(crate) fn fair_time(profile: &MachineProfile, speed: f64) -> f64 {
    let [x, y, c] = profile.axes.limits();
    let time = |way: f64, speed: f64, limits: &Limits| {
        let Limits { acceleration, jerk, .. } = *limits;
        way / speed.min(limits.speed) + 2.0 * (way / acceleration).sqrt() + 2.0 * acceleration / jerk
    };
    let straight = time(WAY, speed, &x).max(time(WAY, speed, &y));
    profile.knife.plunge() + straight + time(PI, f64::INFINITY, &c)
}

/// Initial state of the rule.
pub(in crate::verify) fn worst() -> Worst {
    Worst::new(&rules::CRAWL, Some(SLOWNESS_MAX))
}

/// Motion that F commands for a move.
#[derive(Debug, Clone, Copy)]
pub(in crate::verify) struct Asked {
    /// Speed of the C axis over the table, mm/s.
    pub(in crate::verify) speed: f64,
    /// Speed of C itself, rad/s, unsigned.
    pub(in crate::verify) turn: f64,
    /// Length of the way of the C axis, mm.
    pub(in crate::verify) length: f64,
    /// Curvature of the way, per mm, unsigned; 0 = straight.
    pub(in crate::verify) curvature: f64,
}

/// Limits of the axes on F.
#[derive(Debug, Clone, Copy)]
pub(in crate::verify) struct Axes {
    /// Speed limit of the slower of X and Y, mm/s.
    speed: f64,
    /// Acceleration limit of the weaker of X and Y, mm/s2.
    acceleration: f64,
    /// Speed limit of C, rad/s.
    turn: f64,
    /// Path deviation that the controller may use for blending, mm; 0 = it stops between moves or plans otherwise.
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

    /// Greatest share of a limit, of an axis or of the moves that the controller plans, that a move uses.
    pub(in crate::verify) fn used(&self, asked: &Asked) -> f64 {
        let arc = if asked.curvature > 0.0 && self.blend > 0.0 { self.arc_speed(asked) } else { f64::INFINITY };
        (asked.speed / self.speed.min(arc).min(asked.length * self.moves)).max(asked.turn / self.turn)
    }

    /// Speed beyond which an arc takes no less time, mm/s. From rest to rest it reaches sqrt(a l), with a the acceleration left
    /// along it. At speed v the acceleration leans by v^2 k / (2 a) at its start, a kink that makes a planner slow down: from
    /// sqrt(2 a sqrt(t / k)) on, with t the blend tolerance, an arc loses at its ends as much as it gains.
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
        // A short arc reaches sqrt(8000 * 0.5 / 4) = 31.6 mm/s between rests; a long one of radius 10 mm starts at sqrt(2 *
        // 8000 * sqrt(0.05 * 10)) = 106.4 mm/s; a still longer one may command more.
        check([31.6, 0.0, 0.5, 0.1], 1.0);
        check([106.4, 0.0, 8.0, 0.1], 1.0);
        check([169.4, 0.0, 20.0, 0.1], 1.0);
    }
}
