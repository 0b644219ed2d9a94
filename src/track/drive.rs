//! The drive of a carriage: what becomes of the commands that it is given.

use std::collections::VecDeque;

use crate::machine::Tracking;

/// Steps of the integration in a sample period.
pub(super) const STEPS: usize = 10;
/// A carriage that is slower stands, mm/s: within a shift it comes no micrometre on.
const REST_EPSILON: f64 = 1e-8;

/// A carriage on its drive: commands come to it after the latency, and it follows them with a time constant, no faster than
/// its acceleration allows.
#[derive(Debug, Clone)]
pub(super) struct Drive {
    /// Where the carriage is, mm.
    pub(super) place: f64,
    /// Its velocity, mm/s.
    pub(super) velocity: f64,
    /// Commands on their way, the oldest first, one a step.
    late: VecDeque<f64>,
    lag: f64,
    acceleration: f64,
    step: f64,
}

impl Drive {
    /// A carriage at rest in the middle of the machine.
    pub(super) fn new(track: &Tracking) -> Self {
        let step = track.period() / STEPS as f64;
        let late = (track.latency() / step).round() as usize;
        Self {
            place: 0.0,
            velocity: 0.0,
            late: std::iter::repeat_n(0.0, late).collect(),
            lag: track.lag(),
            acceleration: track.carriage_acceleration_mm_s2,
            step,
        }
    }

    /// Whether it stands, and nothing on its way will move it.
    pub(super) fn rests(&self) -> bool {
        self.velocity.abs() <= REST_EPSILON && self.late.iter().all(|&velocity| velocity == 0.0)
    }

    /// Moves on by a sample period, in which a velocity is commanded, mm/s.
    pub(super) fn follow(&mut self, velocity: f64) {
        for _ in 0..STEPS {
            self.late.push_back(velocity);
            let commanded = self.late.pop_front().unwrap_or(velocity);
            // No faster than within a step, however small the lag is.
            let wanted = (commanded - self.velocity) / self.lag.max(self.step);
            self.velocity += wanted.clamp(-self.acceleration, self.acceleration) * self.step;
            self.place += self.velocity * self.step;
        }
    }
}
