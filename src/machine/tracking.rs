//! Carriage that follows the centre of a moving cloth: the keys `track.*`.

use serde::{Deserialize, Serialize};

use super::fault::Fault;
use super::key::{Key, Takes, between, from};
use super::word::{Off, OrWord, Word as _};
use crate::units::MS_PER_S;

/// Greatest number of samples in a debounce time: the controller has a fixed size.
pub const MOST_DEBOUNCE: u16 = 63;
/// Greatest number of samples between an upstream reading and the reaction to it.
pub const MOST_DELAY: u16 = 2000;

/// The keys `track.*`.
#[rustfmt::skip] // a table: one row a key
pub(super) const KEYS: &[Key] = &[
    Key { name: "track.sensors", takes: Takes::Count(256), about: "How many sensors each of the two rulers has." },
    Key { name: "track.pitch_mm", takes: Takes::Number(from(0.01, 50.0)), about: "From one sensor to the next. The centre is known to half of it." },
    Key { name: "track.width_mm", takes: Takes::Number(from(1.0, 20_000.0)), about: "Nominal width of the cloth: from the middle of one ruler to that of the other." },
    Key { name: "track.width_range_mm", takes: Takes::RangeOr(Off::WORD), about: "Least and greatest width of the cloth: the carriage stops where it is exceeded. \"off\" = whatever\nthe rulers see." },
    Key { name: "track.period_ms", takes: Takes::Number(from(0.1, 1000.0)), about: "From one pair of readings to the next." },
    Key { name: "track.least_speed_mm_s", takes: Takes::Number(from(0.0, 1000.0)), about: "f: speed of the carriage to which that by the deviation is added." },
    Key { name: "track.gain_mm_s", takes: Takes::Number(from(0.0, 1000.0)), about: "k: speed for each sensor by which the rulers differ, that is for each half pitch off centre." },
    Key { name: "track.max_speed_mm_s", takes: Takes::Number(from(1.0, 10_000.0)), about: "Greatest speed of the carriage." },
    Key { name: "track.carriage_acceleration_mm_s2", takes: Takes::Number(from(1.0, 1.0e6)), about: "How fast the carriage may become faster or slower." },
    Key { name: "track.latency_ms", takes: Takes::Number(from(0.0, 1000.0)), about: "From a reading to when the drive has the command." },
    Key { name: "track.lag_ms", takes: Takes::Number(from(0.0, 1000.0)), about: "Time constant with which the drive follows a command." },
    Key { name: "track.brake", takes: Takes::Flag, about: "Whether the speed is kept low enough to stop at the centre with 0.6 of the acceleration, whatever\nthe gain." },
    Key { name: "track.debounce_ms", takes: Takes::Number(from(0.0, 10_000.0)), about: "How long the cloth must lie to one side before the carriage moves: longer than damage of the edge\ntakes to pass a ruler." },
    Key { name: "track.cloth_mm_s", takes: Takes::Number(between(0.0, 10_000.0)), about: "Speed of the conveyor, for logs that do not tell where it is." },
    Key { name: "track.upstream_mm", takes: Takes::NumberOr(from(1.0, 100_000.0), Off::WORD), about: "How far upstream a fixed second pair of rulers sees the cloth; its motion is fed forward. \"off\" =\nthere is none." },
    Key { name: "track.centre_mm", takes: Takes::Number(from(0.0, 10_000.0)), about: "Length of cloth over which the centre line that is written is evened: readings have steps of half\na pitch." },
];

/// Carriage that follows the cloth.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Tracking {
    /// m: number of sensors of a ruler.
    pub sensors: u32,
    /// q: distance between sensors.
    pub pitch_mm: f64,
    /// W0: nominal width of the cloth.
    pub width_mm: f64,
    /// Least and greatest width of the cloth; `None` = any.
    #[serde(with = "OrWord::<Off>")]
    pub width_range_mm: Option<[f64; 2]>,
    /// Ts: sampling period.
    pub period_ms: f64,
    /// f: speed to which that by the deviation is added.
    pub least_speed_mm_s: f64,
    /// k: speed per count.
    pub gain_mm_s: f64,
    /// vmax: greatest speed.
    pub max_speed_mm_s: f64,
    /// a: acceleration.
    pub carriage_acceleration_mm_s2: f64,
    /// Time from a reading to the command at the drive.
    pub latency_ms: f64,
    /// Time constant of the drive.
    pub lag_ms: f64,
    /// True if the speed is limited to one from which the carriage can stop.
    pub brake: bool,
    /// Time for which the cloth must lie to one side before that counts.
    pub debounce_ms: f64,
    /// Speed of the conveyor.
    pub cloth_mm_s: f64,
    /// l: distance to the second pair of rulers; `None` = there is none.
    #[serde(with = "OrWord::<Off>")]
    pub upstream_mm: Option<f64>,
    /// Length over which the centre line is smoothed.
    pub centre_mm: f64,
}

impl Default for Tracking {
    fn default() -> Self {
        Self {
            sensors: 64,
            pitch_mm: 1.0,
            width_mm: 1500.0,
            width_range_mm: None,
            period_ms: 10.0,
            least_speed_mm_s: 1.0,
            gain_mm_s: 6.0,
            max_speed_mm_s: 200.0,
            carriage_acceleration_mm_s2: 800.0,
            latency_ms: 10.0,
            lag_ms: 20.0,
            brake: true,
            debounce_ms: 60.0,
            cloth_mm_s: 200.0,
            upstream_mm: None,
            centre_mm: 100.0,
        }
    }
}

impl Tracking {
    /// Ts: sampling period, s.
    pub fn period(&self) -> f64 {
        self.period_ms / MS_PER_S
    }

    /// Time from a reading to the command at the drive, s.
    pub fn latency(&self) -> f64 {
        self.latency_ms / MS_PER_S
    }

    /// Time constant of the drive, s.
    pub fn lag(&self) -> f64 {
        self.lag_ms / MS_PER_S
    }

    /// Number of samples in a debounce time, rounded up.
    pub fn debounce(&self) -> u16 {
        // A period that divides the time, except for rounding, fills it exactly.
        (self.debounce_ms / self.period_ms - COUNT_EPSILON).ceil().max(0.0) as u16
    }

    /// Number of samples from an upstream reading until that cloth is at the carriage; `None` without upstream rulers.
    pub fn ahead(&self) -> Option<f64> {
        Some(self.upstream_mm? / self.cloth_mm_s / self.period())
    }
}

/// Rounding of a number of samples.
const COUNT_EPSILON: f64 = 1e-9;

/// Checks values against each other.
pub(super) fn faults(track: &Tracking) -> Vec<Fault> {
    let mut faults = Vec::new();
    let mut fault = |keys: &[&str], message: String, hint: &str| faults.push(Fault::of_range(keys, message, hint));
    if track.sensors < 3 {
        let message = format!(
            "`track.sensors` is {}: a ruler tells an edge from its loss by 3 sensors at the least",
            track.sensors
        );
        fault(&["track.sensors"], message, "all covered and none covered mean that the edge is lost");
    }
    if let Some([least, greatest]) =
        track.width_range_mm.filter(|[least, most]| !(*least..=*most).contains(&track.width_mm))
    {
        let message = format!(
            "`track.width_mm` is {} mm, outside `track.width_range_mm`, {least} to {greatest} mm",
            track.width_mm
        );
        fault(
            &["track.width_range_mm", "track.width_mm"],
            message,
            "the carriage would stop for cloth of its nominal width",
        );
    }
    let samples = track.debounce_ms / track.period_ms;
    if samples > f64::from(MOST_DEBOUNCE) {
        let message = format!(
            "`track.debounce_ms` is {} ms, more than {MOST_DEBOUNCE} times `track.period_ms`",
            track.debounce_ms
        );
        fault(&["track.debounce_ms", "track.period_ms"], message, "read less often, or take a shorter time");
    }
    let ahead = track.ahead();
    if let Some(samples) = ahead.filter(|&samples| samples > f64::from(MOST_DELAY)) {
        let message = format!(
            "cloth takes {samples:.0} periods from the rulers upstream to the carriage; the controller keeps {MOST_DELAY} readings"
        );
        fault(&["track.upstream_mm", "track.cloth_mm_s", "track.period_ms"], message, "take rulers that are nearer");
    }
    let needed = track.foresight();
    if let Some(samples) = ahead.filter(|&samples| samples <= f64::from(MOST_DELAY) && samples < needed) {
        let least = needed * track.period() * track.cloth_mm_s;
        let message = format!(
            "the rulers upstream see the cloth {samples:.1} periods before the carriage; what is fed forward takes {needed:.1}"
        );
        let hint =
            format!("put them {:.0} mm upstream at the least, or take a shorter `track.debounce_ms`", least.ceil());
        fault(&["track.upstream_mm", "track.cloth_mm_s", "track.debounce_ms"], message, &hint);
    }
    faults
}

impl Tracking {
    /// Number of samples between the two upstream readings whose difference gives a velocity: their resolution is half a pitch.
    pub const WINDOW: u16 = 8;

    /// Number of samples from upstream readings to the reaction of the drive to their velocity: half of the window, the median
    /// over a debounce time, latency, lag, and half a period for which a command holds on average.
    pub fn foresight(&self) -> f64 {
        let drive = (self.latency() + self.lag()) / self.period() + 0.5;
        drive + f64::from(Self::WINDOW) / 2.0 + f64::from(self.debounce())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_debounce_time_is_filled_by_samples() {
        let samples = |debounce_ms, period_ms| Tracking { period_ms, debounce_ms, ..Tracking::default() }.debounce();
        assert_eq!([samples(60.0, 10.0), samples(61.0, 10.0), samples(0.3, 0.1), samples(0.0, 10.0)], [6, 7, 3, 0]);
    }

    #[test]
    fn what_cannot_work_together_is_a_fault() {
        let count = |track: Tracking| faults(&track).len();
        let track = Tracking::default();
        assert_eq!(count(track.clone()), 0);
        assert_eq!(count(Tracking { sensors: 2, ..track.clone() }), 1);
        assert_eq!(count(Tracking { width_range_mm: Some([1400.0, 1450.0]), ..track.clone() }), 1);
        assert_eq!(count(Tracking { debounce_ms: 640.0, ..track.clone() }), 1);
        assert_eq!(count(Tracking { upstream_mm: Some(10.0), ..track.clone() }), 1);
        assert_eq!(count(Tracking { upstream_mm: Some(5000.0), ..track.clone() }), 1);
        assert_eq!(count(Tracking { upstream_mm: Some(400.0), ..track }), 0);
    }
}
