//! Measures of the tracking quality of a follower.

use serde::Serialize;

use super::scenario::Scenario;
use super::simulate::Follower;
use crate::machine::Tracking;

/// Speed below which a carriage is at rest, mm/s, and has no direction to reverse.
const STANDS: f64 = 0.1;
/// Maximum error of a settled follower, pitches.
const SETTLED: f64 = 1.0;
/// Fractions of the duration at its end: one for the residual error, and one in which an error means that the follower has not
/// settled.
const LAST: f64 = 0.25;
const END: f64 = 0.05;

/// Tracking quality of a follower.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Measures {
    /// Time from a jump of the cloth until it is followed within a pitch for good, s; null without a jump or if that never
    /// happens.
    pub settling_s: Option<f64>,
    /// Maximum excursion beyond the centre after a jump, mm; null without a jump.
    pub overshoot_mm: Option<f64>,
    /// Number of reversals.
    pub reversals: usize,
    /// Number of reversals in the last quarter; a settled follower has none.
    pub late_reversals: usize,
    /// Maximum error in the last quarter, mm.
    pub residual_mm: f64,
    /// Maximum error over the measured time, mm.
    pub worst_mm: f64,
    /// Root mean square of the error over the measured time, mm.
    pub rms_mm: f64,
}

/// Measures a follower; `cloth` is the centre of the cloth at each sample, mm.
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

/// Number of reversals of a carriage.
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
