//! Measuring: how well something follows a cloth.

use serde::Serialize;

use super::scenario::Scenario;
use super::simulate::Follower;
use crate::machine::Tracking;

/// A carriage that is slower stands, mm/s: so that it has no direction that could be reversed.
const STANDS: f64 = 0.1;
/// A follower has settled when it is off centre by no more than this many pitches.
const SETTLED: f64 = 1.0;
/// The part at the end that tells what is left, and the one within which what is off centre has never settled.
const LAST: f64 = 0.25;
const END: f64 = 0.05;

/// How well something follows a cloth.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Measures {
    /// From a jump of the cloth to when it is followed to a pitch for good, s; null without a jump, and where it never is.
    pub settling_s: Option<f64>,
    /// How far it goes beyond the centre behind a jump, mm; null without one.
    pub overshoot_mm: Option<f64>,
    /// How often it turns round.
    pub reversals: usize,
    /// How often it does in the last quarter: what settles does not.
    pub late_reversals: usize,
    /// The greatest error in the last quarter, mm.
    pub residual_mm: f64,
    /// The greatest error of all that is measured, mm.
    pub worst_mm: f64,
    /// The root of the mean of its square, mm.
    pub rms_mm: f64,
}

/// Measures a follower of a cloth whose centre is known at each sample, mm.
pub fn measure(follower: &Follower, cloth: &[f64], scenario: &Scenario, track: &Tracking) -> Measures {
    let period = track.period();
    let errors: Vec<f64> = follower.places.iter().zip(cloth).map(|(place, centre)| place - centre).collect();
    let count = errors.len();
    let [offset, at] = scenario.offset;
    let from = ((at / period).round() as usize).min(count);
    let settled = SETTLED * track.pitch_mm;
    let last = errors[from..].iter().rposition(|error| error.abs() > settled).map_or(0, |last| last + 1);
    let has_settled = (count - from - last) as f64 >= END * count as f64;
    let has_jump = offset != 0.0;
    let late = count - (LAST * count as f64) as usize;
    let greatest = |errors: &[f64]| errors.iter().fold(0.0_f64, |greatest, error| greatest.max(error.abs()));
    let measured = &errors[((scenario.measured_from / period).round() as usize).min(count)..];
    let squares: f64 = measured.iter().map(|error| error * error).sum();
    Measures {
        settling_s: (has_jump && has_settled).then_some(last as f64 * period),
        overshoot_mm: has_jump
            .then(|| errors[from..].iter().fold(0.0_f64, |most, error| most.max(error * offset.signum()))),
        reversals: reversals(&follower.places, period),
        late_reversals: reversals(&follower.places[late..], period),
        residual_mm: greatest(&errors[late..]),
        worst_mm: greatest(measured),
        rms_mm: (squares / measured.len().max(1) as f64).sqrt(),
    }
}

/// How often a carriage turns round.
fn reversals(places: &[f64], period: f64) -> usize {
    let mut way = 0.0;
    let mut count = 0;
    for pair in places.windows(2) {
        let velocity = (pair[1] - pair[0]) / period;
        if velocity.abs() > STANDS {
            count += usize::from(velocity * way < 0.0);
            way = velocity;
        }
    }
    count
}
