//! Alternative trackers for comparison: the older tracker with two coupled mechanisms, and a guide with a PI controller.
//!
//! They run beside the controller in a simulation, with the same readings, drives and delays.

use super::drive::Drive;
use crate::machine::Tracking;

/// A guide that drives the carriage at Kp e + Ki times the integral of e, where e is the distance from the centre.
#[derive(Debug, Clone)]
pub(super) struct Guide {
    sum: f64,
}

/// Kp, 1/s.
pub(super) const PROPORTIONAL: f64 = 12.0;
/// Ki, 1/s2.
pub(super) const INTEGRAL: f64 = 4.0;

impl Guide {
    pub(super) fn new() -> Self {
        Self { sum: 0.0 }
    }

    /// The velocity for a pair of readings, mm/s.
    pub(super) fn step(&mut self, track: &Tracking, [left, right]: [u16; 2]) -> f64 {
        let off = (f64::from(right) - f64::from(left)) * track.pitch_mm / 2.0;
        let velocity = PROPORTIONAL * off + INTEGRAL * self.sum;
        // The integral is frozen while the velocity is limited (anti-windup).
        if velocity.abs() < track.max_speed_mm_s {
            self.sum += off * track.period();
        }
        velocity.clamp(-track.max_speed_mm_s, track.max_speed_mm_s)
    }
}

/// The older tracker: one mechanism drives a base with the tracker of the left edge, another the distance from it to the
/// tracker of the right edge, and the cutting heads are kept in the middle between the two. Each tracker only detects cloth
/// below it, so both mechanisms always run in one direction or the other, and the motion of the first one also moves the second
/// tracker.
#[derive(Debug, Clone)]
pub(super) struct Older {
    base: Drive,
    distance: Drive,
    speed: f64,
    width: f64,
}

impl Older {
    /// Creates a tracker with mechanisms that run at a speed, mm/s, and trackers at the nominal width apart.
    pub(super) fn new(track: &Tracking, speed: f64) -> Self {
        Self { base: Drive::new(track), distance: Drive::new(track), speed, width: track.width_mm }
    }

    /// Position of its heads, mm to the right of the middle of the machine.
    pub(super) fn place(&self) -> f64 {
        self.base.place + self.distance.place / 2.0
    }

    /// Advances by a sample period over a cloth with given edge positions, mm.
    pub(super) fn follow(&mut self, [left, right]: [f64; 2]) {
        let toward = |tracker: f64, edge: f64| if tracker > edge { -self.speed } else { self.speed };
        let base = toward(self.base.place - self.width / 2.0, left);
        let distance = toward(self.base.place + self.width / 2.0 + self.distance.place, right);
        self.base.follow(base);
        self.distance.follow(distance);
    }
}
