//! Frame in which heads cut: that of the cloth, which moves under them at constant speed.
//!
//! A head at `xi` over its station X meets the place x = X + xi - s of the cloth, s being the conveyor's position. At a
//! constant speed v its accelerations and jerks are equal in both frames; its speed along the feed is greater by v over the
//! table. The limits over the cloth are therefore those of its axes, except for a speed from -(V + v) to V - v along the feed.

use super::ramp::Ramp;
use crate::machine::{Job, Limits};

/// Periods of travel that are lost to whole periods: half a period at either end because the position of the cloth is rounded,
/// and one because a chain cannot start before its earliest time.
const WHOLE_PERIODS: f64 = 2.0;

/// Cloth that moves under heads.
#[derive(Debug, Clone)]
pub(super) struct Moving {
    /// Speed of the conveyor, mm/s.
    pub(super) speed: f64,
    /// Time between two setpoints, s.
    pub(super) period: f64,
    /// Travel of a head along the feed, less the loss to whole periods, mm.
    pub(super) travel: f64,
    /// Ramp between rest and the speed of the cloth.
    pub(super) ramp: Ramp,
    /// Job with the limit of x for a chain along which x falls.
    pub(super) falling: Job,
    /// Job with the limit of x for any other chain: the stricter of both directions.
    pub(super) either: Job,
    /// Limits of x, y and C over the table with the knife up.
    pub(super) rapid: [Limits; 3],
}

impl Moving {
    /// The frame at a speed of the conveyor; `None` if the heads cannot keep up with it.
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

    /// Reserve of the travel at either end, mm: the position of the cloth at a station is rounded to half a period.
    pub(super) fn reserve(&self) -> f64 {
        self.step() / 2.0
    }

    /// Distance that the cloth moves in a period, mm.
    pub(super) fn step(&self) -> f64 {
        self.speed * self.period
    }
}
