//! The drive of a carriage: its response to commands.

use std::collections::VecDeque;

use crate::machine::Tracking;

/// Number of integration steps per sample period.
pub(super) const STEPS: usize = 10;
/// Speed below which a carriage is at rest, mm/s: within a shift it would not move by a micrometre.
const REST_EPSILON: f64 = 1e-8;

/// A carriage and its drive. Commands arrive after the latency; the drive follows them with a time constant, within its
/// acceleration.
#[derive(Debug, Clone)]
pub(super) struct Drive {
    /// Position of the carriage, mm.
    pub(super) place: f64,
    /// Its velocity, mm/s.
    pub(super) velocity: f64,
    /// Delayed commands, the oldest first, one per step.
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

    /// True if the carriage is at rest and no delayed command will move it.
    pub(super) fn rests(&self) -> bool {
        self.velocity.abs() <= REST_EPSILON && self.late.iter().all(|&velocity| velocity == 0.0)
    }

    /// Advances by a sample period with a commanded velocity, mm/s.
    pub(super) fn follow(&mut self, velocity: f64) {
        for _ in 0..STEPS {
            self.late.push_back(velocity);
            let commanded = self.late.pop_front().unwrap_or(velocity);
            // The response takes at least one step, however small the lag is.
            let wanted = (commanded - self.velocity) / self.lag.max(self.step);
            self.velocity += wanted.clamp(-self.acceleration, self.acceleration) * self.step;
            self.place += self.velocity * self.step;
        }
    }
}
