//! The law of the controller, derived from the profile: speed by deviation, and conditions against overshoot.

use super::controller::{FeedForward, Law, MOST_DEBOUNCE, MOST_DELAY, MOST_SENSORS};
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::machine::{Tracking, tracking};
use crate::units::number::{short, up};

/// Fraction of the acceleration available to the brake; the rest covers the effects of lag and sampling.
const BRAKE: f64 = 0.6;

// All values permitted by the profile fit into the controller.
const _: () = assert!((tracking::MOST_DEBOUNCE as usize) < MOST_DEBOUNCE);
const _: () = assert!(tracking::MOST_DELAY as usize + (Tracking::WINDOW as usize) < MOST_DELAY);

/// The controller parameters of a profile.
pub fn law(track: &Tracking) -> Law {
    let mut speeds = [0.0; MOST_SENSORS + 1];
    for (deviation, speed) in speeds.iter_mut().enumerate().skip(1) {
        *speed = speed_at(track, deviation as f64);
    }
    let counts = |width: f64| (width - track.width_mm) / track.pitch_mm;
    // A width within its limits may be read as one count more or less.
    let width = track.width_range_mm.map_or([i32::MIN, i32::MAX], |[least, greatest]| {
        [counts(least).floor() as i32 - 1, counts(greatest).ceil() as i32 + 1]
    });
    Law {
        sensors: track.sensors as u16,
        width,
        speeds,
        max_speed: track.max_speed_mm_s,
        debounce: track.debounce(),
        feed_forward: track.ahead().map(|ahead| feed_forward(track, ahead)),
    }
}

/// Speed of the carriage at a deviation D, counts, in mm/s: v = min(vmax, f + k D). With the brake it is also limited so that
/// the carriage can stop within the guaranteed remaining distance s = (D - 1) q/2, with a fraction b of its acceleration after
/// a dead time tt: v = b (sqrt(tt^2 + 2 s/b) - tt). The speed is at least f, so that the last count is corrected, too.
fn speed_at(track: &Tracking, deviation: f64) -> f64 {
    let Tracking { least_speed_mm_s: least, gain_mm_s: gain, max_speed_mm_s: greatest, .. } = *track;
    let wanted = (least + gain * deviation).min(greatest);
    if !track.brake {
        return wanted;
    }
    let b = BRAKE * track.carriage_acceleration_mm_s2;
    let dead = track.latency() + 1.5 * track.period() + track.lag();
    let way = (deviation - 1.0) * track.pitch_mm / 2.0;
    let stoppable = b * ((dead * dead + 2.0 * way / b).sqrt() - dead);
    wanted.min(stoppable.max(least))
}

/// Feed-forward parameters. A reading upstream reaches the carriage after `ahead` samples; the delay is that time less the time
/// taken by the drive and the reading.
fn feed_forward(track: &Tracking, ahead: f64) -> FeedForward {
    let window = Tracking::WINDOW;
    FeedForward {
        window,
        delay: (ahead - track.foresight()).round().max(0.0) as u16,
        filter: track.debounce(),
        // I - J falls by two as the centre moves to the right by a pitch.
        per_count: -track.pitch_mm / (2.0 * f64::from(window) * track.period()),
    }
}

/// Conditions that guarantee an overshoot of at most a pitch and a half, sufficient but not necessary, as ratios of the actual
/// to the permitted value.
///
/// At one count the carriage moves less than half a pitch in its dead time, (f + k) 2 tau/q <= 1. It need not decelerate faster
/// than with half of its acceleration, (2k/q) v/(a/2) <= 1, with v its maximum speed; the brake ensures this. The loop is not
/// too stiff for its dead time, (2k/q) tau <= 1/2: above 1/e a loop with a pure delay oscillates, and a response with a time
/// constant permits a little more.
pub fn overshoot(track: &Tracking) -> [f64; 3] {
    let dead = track.period() + track.latency() + track.lag();
    let stiffness = 2.0 * track.gain_mm_s / track.pitch_mm;
    let first = (track.least_speed_mm_s + track.gain_mm_s) * 2.0 * dead / track.pitch_mm;
    let farthest = f64::from(track.sensors.saturating_sub(2));
    let falls = stiffness * speed_at(track, farthest);
    [first, if track.brake { 0.0 } else { falls / (track.carriage_acceleration_mm_s2 / 2.0) }, stiffness * dead * 2.0]
}

/// Notes the conditions that a profile violates.
pub(super) fn note(track: &Tracking, out: &mut Diagnostics) {
    let gain = format!("with `track.gain_mm_s` = {} the carriage", short(track.gain_mm_s));
    let simulate = "or simulate it with the delays of your machine: `cutc track --simulate`";
    let told = [
        ("moves at one count off centre", "as fast", "lower `track.least_speed_mm_s` or the gain"),
        ("may have to slow down", "as fast", "switch `track.brake` on, or lower the gain"),
        ("answers what it reads", "as stiffly for its dead time", "lower the gain, or read more often"),
    ];
    for (ratio, (does, how, hint)) in overshoot(track).into_iter().zip(told) {
        if ratio > 1.0 {
            let message = format!("{gain} {does} {} times {how} as is sure not to overshoot", up(ratio, 1));
            out.push(Diagnostic::new(&code::TRACK_OVERSHOOT, message).by(ratio).hint(format!("{hint}, {simulate}")));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_speeds_are_those_of_the_paper_without_the_brake() {
        let track = Tracking { gain_mm_s: 3.0, brake: false, ..Tracking::default() };
        let law = law(&track);
        assert_eq!([law.speeds[0], law.speeds[1], law.speeds[40], law.speeds[100]], [0.0, 4.0, 121.0, 200.0]);
        // The second condition is violated: see the plant of the default profile.
        let ratios = overshoot(&track);
        let expected = [0.32, 6.0 * 187.0 / 400.0, 0.48];
        assert!(ratios.iter().zip(expected).all(|(ratio, expected)| (ratio - expected).abs() < 1e-12), "{ratios:?}");
    }

    #[test]
    fn the_brake_keeps_the_second_condition_and_the_slowest_speed() {
        assert!(overshoot(&Tracking::default()).iter().all(|&ratio| ratio <= 1.0));
        let [slow, fast] = [6.0, 1000.0].map(|gain_mm_s| law(&Tracking { gain_mm_s, ..Tracking::default() }).speeds);
        assert_eq!((slow[1], fast[1]), (1.0, 1.0));
        assert!(fast.iter().zip(&slow).all(|(fast, slow)| fast >= slow) && fast[64] < 200.0);
    }
}
