//! Ramps between rest over the conveyor and the speed of the cloth, at both ends of every stretch that a head cuts.
//!
//! A blade is plunged and lifted at rest in the cloth. The head must reach the speed of the cloth before and lose it after.

use crate::machine::Limits;
use crate::machine::kinematics::Move;

/// A ramp between rest and the speed of the cloth, limited in jerk, over whole periods.
#[derive(Debug, Clone, Copy)]
pub(super) struct Ramp {
    /// Acceleration to the speed and deceleration from it, as one move.
    both: Move,
    /// Periods of one ramp.
    pub(super) ticks: u32,
    /// Distance along the feed of one ramp, mm.
    pub(super) way: f64,
}

impl Ramp {
    /// The fastest ramp within limits, stretched to whole periods (s).
    pub(super) fn new(speed: f64, limits: Limits, period: f64) -> Self {
        let Limits { acceleration, jerk, .. } = limits;
        let time = if speed * jerk < acceleration * acceleration {
            2.0 * (speed / jerk).sqrt()
        } else {
            speed / acceleration + acceleration / jerk
        };
        let ticks = ((time / period).ceil() as u32).max(1);
        // A ramp to the same speed that is stretched by k has 1/k of the acceleration and 1/k^2 of the jerk.
        let k = f64::from(ticks) * period / time;
        let gentler = Limits { speed, acceleration: acceleration / k, jerk: jerk / (k * k) };
        let whole = speed * f64::from(ticks) * period;
        Self { both: Move::new(whole, gentler), ticks, way: whole / 2.0 }
    }

    /// Distance covered at a tick of speeding up, mm.
    pub(super) fn up(&self, tick: u32) -> f64 {
        self.both.at(f64::from(tick), 2.0 * f64::from(self.ticks))
    }

    /// Distance covered at a tick of slowing down, mm.
    pub(super) fn down(&self, tick: u32) -> f64 {
        self.up(self.ticks + tick) - self.way
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ramp_ends_at_the_speed_of_the_cloth_within_its_limits() {
        for (speed, acceleration) in [(200.0, 8000.0), (800.0, 8000.0), (40.0, 500.0)] {
            let limits = Limits { speed: 1200.0, acceleration, jerk: 2e5 };
            let (ramp, h) = (Ramp::new(speed, limits, 1e-3), 1e-3);
            let n = ramp.ticks;
            let last = (ramp.up(n) - ramp.up(n - 1)) / h;
            assert!((ramp.up(n) - ramp.way).abs() < 1e-9 && last <= speed + 1e-9 && last > 0.98 * speed);
            assert!((ramp.down(n) - ramp.way).abs() < 1e-9 && ramp.down(0).abs() < 1e-9);
            let up: Vec<f64> = (0..=2 * n).map(|i| ramp.up(i)).collect();
            for w in up.windows(4) {
                assert!(((w[2] - 2.0 * w[1] + w[0]) / (h * h)).abs() <= acceleration * (1.0 + 1e-6));
                assert!(((w[3] - 3.0 * w[2] + 3.0 * w[1] - w[0]) / (h * h * h)).abs() <= 2e5 * (1.0 + 1e-4));
            }
        }
    }
}
