//! Closed-form rest-to-rest moves of one axis: seven phases of constant jerk.
//!
//! The phases are `+j, 0, -j` (speed up), cruise, `-j, 0, +j` (slow down); a phase has no length when a limit is not
//! reached. Formulas: any text on double-S profiles, for instance Biagiotti & Melchiorri, *Trajectory Planning for
//! Automatic Machines and Robots*, 2008, section 3.4.

/// Greatest speed, acceleration and jerk of an axis, or of a motion along a path; per s, s2, s3.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limits {
    /// Greatest speed.
    pub speed: f64,
    /// Greatest acceleration.
    pub acceleration: f64,
    /// Greatest jerk.
    pub jerk: f64,
}

impl Limits {
    /// Lesser of two, limit by limit.
    #[must_use]
    pub fn min(self, other: Self) -> Self {
        Self {
            speed: self.speed.min(other.speed),
            acceleration: self.acceleration.min(other.acceleration),
            jerk: self.jerk.min(other.jerk),
        }
    }

    /// Limits of a motion along a line on which the axis moves `share` units per unit of path.
    #[must_use]
    pub fn along(self, share: f64) -> Self {
        let share = share.abs().max(f64::MIN_POSITIVE);
        Self { speed: self.speed / share, acceleration: self.acceleration / share, jerk: self.jerk / share }
    }
}

/// Fastest move over a distance, from rest to rest, within limits.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Move {
    /// Length, in the unit of the limits; not negative.
    distance: f64,
    /// Applied jerk.
    jerk: f64,
    /// Duration of a phase of constant jerk, s.
    ramp: f64,
    /// Duration of a phase of constant acceleration, s.
    hold: f64,
    /// Duration of the phase of constant speed, s.
    cruise: f64,
}

impl Move {
    /// Fastest move over `distance` (not negative) within `limits`.
    pub fn new(distance: f64, limits: Limits) -> Self {
        let Limits { speed, acceleration, jerk } = limits;
        debug_assert!(distance >= 0.0 && speed > 0.0 && acceleration > 0.0 && jerk > 0.0);
        // Phases up to the greatest speed; there is no hold if the speed is reached before the acceleration.
        let (ramp, hold) = if speed * jerk < acceleration * acceleration {
            ((speed / jerk).sqrt(), 0.0)
        } else {
            (acceleration / jerk, speed / acceleration - acceleration / jerk)
        };
        let reach = speed * (2.0 * ramp + hold);
        if distance >= reach {
            return Self { distance, jerk, ramp, hold, cruise: (distance - reach) / speed };
        }
        let ramp = acceleration / jerk;
        if distance >= 2.0 * acceleration * ramp * ramp {
            // The acceleration is reached, but not the speed: a (hold + ramp)(hold + 2 ramp) = distance.
            let hold = f64::midpoint(-3.0 * ramp, (ramp * ramp + 4.0 * distance / acceleration).sqrt());
            return Self { distance, jerk, ramp, hold: hold.max(0.0), cruise: 0.0 };
        }
        Self { distance, jerk, ramp: (distance / (2.0 * jerk)).cbrt(), hold: 0.0, cruise: 0.0 }
    }

    /// Duration from rest to rest, s.
    pub fn duration(&self) -> f64 {
        4.0 * self.ramp + 2.0 * self.hold + self.cruise
    }

    /// Greatest speed, acceleration and jerk of this move stretched to `duration`, s.
    pub fn derivatives(&self, duration: f64) -> [f64; 3] {
        let Self { distance, jerk, ramp, hold, .. } = *self;
        if distance == 0.0 {
            return [0.0; 3];
        }
        let slower = self.duration() / duration;
        let acceleration = jerk * ramp;
        [acceleration * (ramp + hold) * slower, acceleration * slower.powi(2), jerk * slower.powi(3)]
    }

    /// Share of the duration in which it speeds up, equal to that in which it slows down.
    pub fn rise(&self) -> f64 {
        (2.0 * self.ramp + self.hold) / self.duration()
    }

    /// Distance covered at `time` after the start, of this move stretched to `duration` (not shorter than its own).
    pub fn at(&self, time: f64, duration: f64) -> f64 {
        let own = self.duration();
        if own == 0.0 || time >= duration {
            return self.distance;
        }
        let time = (time / duration).max(0.0) * own;
        if 2.0 * time <= own { self.speeding_up(time) } else { self.distance - self.speeding_up(own - time) }
    }

    /// Distance covered at `time` in the first half of the move.
    fn speeding_up(&self, time: f64) -> f64 {
        let Self { jerk, ramp, hold, .. } = *self;
        if time <= ramp {
            return jerk * time.powi(3) / 6.0;
        }
        let acceleration = jerk * ramp;
        let (mut distance, mut speed) = (jerk * ramp.powi(3) / 6.0, acceleration * ramp / 2.0);
        if time <= ramp + hold {
            let t = time - ramp;
            return distance + speed * t + acceleration * t * t / 2.0;
        }
        distance += speed * hold + acceleration * hold * hold / 2.0;
        speed += acceleration * hold;
        let t = time - ramp - hold;
        if t <= ramp {
            return distance + speed * t + acceleration * t * t / 2.0 - jerk * t.powi(3) / 6.0;
        }
        distance += speed * ramp + acceleration * ramp * ramp / 2.0 - jerk * ramp.powi(3) / 6.0;
        speed += acceleration * ramp / 2.0;
        distance + speed * (t - ramp)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const LIMITS: Limits = Limits { speed: 1200.0, acceleration: 8000.0, jerk: 2.0e5 };

    #[test]
    fn a_line_of_half_a_metre_takes_its_analytic_time() {
        assert!((Move::new(500.0, LIMITS).duration() - (500.0 / 1200.0 + 1200.0 / 8000.0 + 0.04)).abs() < 1e-12);
    }

    #[test]
    fn a_move_keeps_its_limits_and_arrives() {
        for distance in [0.0, 1e-6, 0.3, 10.0, 25.6, 26.0, 100.0, 225.0, 229.0, 5000.0] {
            let m = Move::new(distance, LIMITS);
            let total = m.duration();
            let n = 4000;
            let h = total / f64::from(n);
            let s: Vec<f64> = (-3..=n + 3).map(|i| m.at(f64::from(i) * h, total)).collect();
            assert_eq!(s[0], 0.0);
            assert_eq!(s[s.len() - 1], distance);
            if distance > 1e-3 {
                for w in s.windows(4) {
                    let (d1, d2, d3) = (w[1] - w[0], w[2] - 2.0 * w[1] + w[0], w[3] - 3.0 * w[2] + 3.0 * w[1] - w[0]);
                    assert!(d1 >= 0.0 && d1 / h <= LIMITS.speed * (1.0 + 1e-9));
                    assert!(d2.abs() / (h * h) <= LIMITS.acceleration * (1.0 + 1e-4));
                    assert!(d3.abs() / (h * h * h) <= LIMITS.jerk * 1.02, "{distance} {}", d3 / (h * h * h));
                }
            }
        }
    }
}
