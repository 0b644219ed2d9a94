//! The pulses of one axis for one stitch: closed forms of a move with an acceleration ramp, a cruise and a deceleration ramp.
//!
//! The rate starts at the start rate v0 and stays within the cap, with the acceleration a between. Pulse j occurs when the
//! profile reaches j steps, the last one at the end of the move (patent CN101519831A; the equations are those of the manual
//! page `sewing`).

use crate::machine::Sewing;
use crate::machine::sewing::Ramp;

/// Capabilities of the X and Y motors, and the ramp mode.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Drive {
    /// Length of a step, mm.
    pub step: f64,
    /// Speed at the start and end of a move, mm/s.
    pub start: f64,
    /// Maximum acceleration, mm/s2.
    pub acceleration: f64,
    /// Maximum speed, mm/s.
    pub cap: f64,
    /// Ramp mode: use of the window.
    pub ramp: Ramp,
}

/// The pulses of one axis for one move.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Train {
    /// Number of pulses.
    pulses: u32,
    step: f64,
    start: f64,
    acceleration: f64,
    /// Length of each ramp, mm.
    ramp_way: f64,
    /// Time of each ramp, s.
    ramp_time: f64,
    /// Speed between the ramps, mm/s.
    cruise: f64,
    /// Time from the start to the last pulse, s.
    time: f64,
}

impl Drive {
    /// The drive of a profile.
    pub fn of(sewing: &Sewing) -> Self {
        Self {
            step: sewing.step_mm,
            start: sewing.start(),
            acceleration: sewing.feed_acceleration_mm_s2,
            cap: sewing.cap(),
            ramp: sewing.ramp,
        }
    }

    /// The grid step nearest to a coordinate in mm. The steps of a move are the difference of two such values, so the error
    /// never exceeds half a step.
    pub fn grid(&self, coordinate: f64) -> i64 {
        (coordinate / self.step).round() as i64
    }

    /// Minimum time of a number of pulses, s.
    pub fn least_time(&self, pulses: u32) -> f64 {
        self.fastest(pulses).time
    }

    /// The pulses of a move in the ramp mode. `window` is the time available to a stitch, s; `None` means as fast as possible,
    /// as with the needle up.
    pub fn train(&self, pulses: u32, window: Option<f64>) -> Train {
        let fastest = self.fastest(pulses);
        match (self.ramp, window) {
            (Ramp::Fill, Some(window)) => self.filling(pulses, window),
            // The grid of speeds tolerates an excess of a millionth of a window; the needle does not.
            (Ramp::Fastest, Some(window)) if fastest.time > window => self.filling(pulses, window),
            (Ramp::Fastest, Some(_)) | (Ramp::Fill | Ramp::Fastest, None) => fastest,
        }
    }

    /// The fastest move, with the full acceleration.
    fn fastest(&self, pulses: u32) -> Train {
        let Self { step, start, acceleration, cap, .. } = *self;
        let way = f64::from(pulses) * step;
        let peak = (start * start + acceleration * way).sqrt();
        if peak <= cap {
            let ramp_time = (peak - start) / acceleration;
            let (ramp_way, time) = (way / 2.0, 2.0 * ramp_time);
            return Train { pulses, step, start, acceleration, ramp_way, ramp_time, cruise: peak, time };
        }
        let ramp_time = (cap - start) / acceleration;
        let ramp_way = (cap * cap - start * start) / (2.0 * acceleration);
        let time = 2.0 * ramp_time + (way - 2.0 * ramp_way) / cap;
        Train { pulses, step, start, acceleration, ramp_way, ramp_time, cruise: cap, time }
    }

    /// The move with the minimum acceleration that exactly fills a window.
    fn filling(&self, pulses: u32, window: f64) -> Train {
        let Self { step, start, cap, .. } = *self;
        let way = f64::from(pulses) * step;
        let even = Train {
            pulses,
            step,
            start: way / window,
            acceleration: 0.0,
            ramp_way: 0.0,
            ramp_time: 0.0,
            cruise: way / window,
            time: window,
        };
        if way <= start * window {
            return even;
        }
        let acceleration = 4.0 * (way - start * window) / (window * window);
        let peak = start + acceleration * window / 2.0;
        if peak <= cap {
            let (ramp_way, ramp_time) = (way / 2.0, window / 2.0);
            return Train { pulses, step, start, acceleration, ramp_way, ramp_time, cruise: peak, time: window };
        }
        // Ramps that reach the cap: way = cap window - (cap - start) ramp_time.
        let ramp_time = (cap * window - way) / (cap - start);
        // If the start rate equals the cap, there is no ramp.
        if ramp_time.is_nan() || ramp_time <= 0.0 {
            return even;
        }
        let acceleration = (cap - start) / ramp_time;
        let ramp_way = f64::midpoint(start, cap) * ramp_time;
        Train { pulses, step, start, acceleration, ramp_way, ramp_time, cruise: cap, time: window }
    }
}

impl Train {
    /// Number of pulses.
    pub fn pulses(&self) -> u32 {
        self.pulses
    }

    /// Time from the start to the last pulse, s; 0 without pulses.
    pub fn time(&self) -> f64 {
        if self.pulses == 0 { 0.0 } else { self.time }
    }

    /// Time of a pulse, counted from 1, s from the start.
    pub fn at(&self, pulse: u32) -> f64 {
        let way = f64::from(self.pulses) * self.step;
        let at = f64::from(pulse) * self.step;
        if pulse == self.pulses {
            self.time
        } else if at <= self.ramp_way {
            self.ramp(at)
        } else if at < way - self.ramp_way {
            self.ramp_time + (at - self.ramp_way) / self.cruise
        } else {
            self.time - self.ramp(way - at)
        }
    }

    /// Time to cover a distance from the start speed: (sqrt(v0^2 + 2 a d) - v0)/a, in a form that is also valid for a = 0.
    fn ramp(&self, way: f64) -> f64 {
        2.0 * way / (self.start + (self.start * self.start + 2.0 * self.acceleration * way).sqrt())
    }

    /// Times of all pulses, s from the start.
    pub fn times(&self) -> impl Iterator<Item = f64> + use<> {
        let train = *self;
        (1..=self.pulses).map(move |pulse| train.at(pulse))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The window of a speed, s.
    fn window(sewing: &Sewing, rpm: f64) -> f64 {
        sewing.window() * 60.0 / rpm
    }

    fn check(sewing: &Sewing, (pulses, rpm): (u32, f64), first_us: [f64; 5], (least_us, last_us): (Option<f64>, f64)) {
        let train = Drive::of(sewing).train(pulses, Some(window(sewing, rpm)));
        let times: Vec<f64> = train.times().map(|time| time * 1e6).collect();
        assert_eq!(times.len(), pulses as usize);
        for (time, expected) in times.iter().zip(first_us) {
            assert!((time - expected).abs() < 0.1, "{times:?}");
        }
        assert!((times[times.len() - 1] - last_us).abs() < 0.01, "{times:?}");
        let intervals: Vec<f64> = times.windows(2).map(|pair| pair[1] - pair[0]).collect();
        if let Some(expected) = least_us {
            let least = intervals.iter().copied().fold(f64::INFINITY, f64::min);
            assert!((least - expected).abs() < 0.1, "{least}");
        }
    }

    #[test]
    fn the_pulses_of_both_headline_figures_are_those_of_the_equations() {
        let sewing = Sewing::default();
        let first = [341.6, 663.7, 969.4, 1260.8, 1539.9];
        check(&sewing, (50, 3200.0), first, (Some(171.1), 11_458.33));
        check(&sewing, (60, 2800.0), first, (Some(159.1), 13_095.24));
        let from_rest = Sewing { start_hz: 0.0, feed_acceleration_mm_s2: 76_170.0, ..Sewing::default() };
        check(&from_rest, (50, 3200.0), [1145.8, 1620.5, 1984.6, 2291.7, 2562.2], (None, 11_458.33));
    }

    #[test]
    fn a_move_ends_in_time_whatever_its_form() {
        let capped = Sewing { max_hz: Some(6000.0), ..Sewing::default() };
        for sewing in [Sewing::default(), capped.clone(), Sewing { ramp: Ramp::Fastest, ..capped }] {
            let drive = Drive::of(&sewing);
            for pulses in 1..=254 {
                let least = drive.least_time(pulses);
                for slack in [1.0 - 5e-7, 1.0, 1.001, 1.3, 4.0] {
                    let train = drive.train(pulses, Some(least * slack));
                    let times: Vec<f64> = train.times().collect();
                    assert!(times.is_sorted() && times[0] > 0.0, "{pulses} {slack}: {times:?}");
                    assert!(times[times.len() - 1] <= least * slack * (1.0 + 1e-12));
                    // At the joints of ramp and cruise a pulse may fall on either side.
                    let fastest = times.windows(2).map(|pair| sewing.step_mm / (pair[1] - pair[0])).fold(0.0, f64::max);
                    assert!(fastest <= drive.cap * (1.0 + 1e-6), "{pulses} {slack}: {fastest}");
                }
            }
        }
    }

    #[test]
    fn nothing_moves_without_pulses() {
        let train = Drive::of(&Sewing::default()).train(0, Some(0.01));
        assert_eq!((train.times().count(), train.time()), (0, 0.0));
    }
}
