//! The frame in which heads cut: the cloth's, which moves at a steady speed under them.
//!
//! A head at `xi` over its station X meets the place x = X + xi - s of the cloth, s being the conveyor's position. At a
//! steady speed v its accelerations and jerks are those over the cloth; its speed along the feed is v more. So what a head
//! can do over the cloth are the limits of its axes, but for a speed from -(V + v) to V - v along the feed.

use super::ramp::Ramp;
use crate::machine::{Job, Limits};

/// Periods of travel that whole ones take: half a period at either end for the place of the cloth, and one because a chain
/// starts no earlier than it may.
const WHOLE_PERIODS: f64 = 2.0;

/// Cloth that moves under heads.
#[derive(Debug, Clone)]
pub(super) struct Moving {
    /// Speed of the conveyor, mm/s.
    pub(super) speed: f64,
    /// Time between two setpoints, s.
    pub(super) period: f64,
    /// How far a head travels along the feed, mm, less what rounding to whole periods takes.
    pub(super) travel: f64,
    /// From rest to the speed of the cloth.
    pub(super) ramp: Ramp,
    /// The machine as a chain along which x falls sees it.
    pub(super) falling: Job,
    /// The same as any other sees it: the limit holds either way.
    pub(super) either: Job,
    /// Limits of x, y and c with the knife up, over the table.
    pub(super) rapid: [Limits; 3],
}

impl Moving {
    /// The frame at a speed of the conveyor; `None` where no head can keep up with it.
    pub(super) fn new(speed: f64, job: &Job) -> Option<Self> {
        let (cut, rapid) = (job.profile.axes.limits(), job.profile.axes.travel_limits());
        let period = job.profile.time.period();
        let slowest = cut[0].speed.min(rapid[0].speed);
        let [least, most] = [slowest - speed, cut[0].speed + speed];
        if least <= 0.0 {
            return None;
        }
        let with = |x: f64| {
            let mut job = job.clone();
            job.profile.axes.x.speed_mm_s = x;
            job.profile.axes.x.travel.speed_mm_s = Some(least);
            job
        };
        let gentler = Limits {
            speed: slowest,
            acceleration: cut[0].acceleration.min(rapid[0].acceleration),
            jerk: cut[0].jerk.min(rapid[0].jerk),
        };
        let travel = job.profile.flow.travel_mm - WHOLE_PERIODS * speed * period;
        let ramp = Ramp::new(speed, gentler, period);
        Some(Self { speed, period, travel, ramp, falling: with(most), either: with(least), rapid })
    }

    /// What is left of the travel at either end, mm: the place of the cloth at a station is rounded to half a period.
    pub(super) fn reserve(&self) -> f64 {
        self.step() / 2.0
    }

    /// How far the cloth moves in a period, mm.
    pub(super) fn step(&self) -> f64 {
        self.speed * self.period
    }
}
