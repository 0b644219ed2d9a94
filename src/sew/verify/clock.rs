//! Time limits of the machine: the window of a stitch, and the minimum time of a move.

use crate::machine::Sewing;
use crate::units::{S_PER_MIN, US_PER_S};

/// A turn of the spindle, degrees.
const TURN_DEG: f64 = 360.0;

/// Time from feed start to feed end at a speed, microseconds.
pub(super) fn window_us(sewing: &Sewing, rpm: f64) -> f64 {
    let mut turn = sewing.feed_end_deg - sewing.feed_start_deg;
    while turn < 0.0 {
        turn += TURN_DEG;
    }
    turn / TURN_DEG * S_PER_MIN * US_PER_S / rpm
}

/// Rate at which the spindle must change from one speed to another between two windows, rpm per second.
pub(super) fn change_rpm_s(sewing: &Sewing, [from, to]: [f64; 2]) -> f64 {
    let open = window_us(sewing, 1.0) / (S_PER_MIN * US_PER_S);
    // The mean speed, turns per second, over the part of a turn in which the window is closed.
    let time = (1.0 - open) * S_PER_MIN / f64::midpoint(from, to);
    if from == to { 0.0 } else { (to - from).abs() / time }
}

/// Minimum time of the first step of a motor, microseconds: from the start rate with the maximum acceleration.
pub(super) fn first_step_us(sewing: &Sewing) -> f64 {
    let (start, acceleration) = (sewing.start_hz * sewing.step_mm, sewing.feed_acceleration_mm_s2);
    ((start * start + 2.0 * acceleration * sewing.step_mm).sqrt() - start) / acceleration * US_PER_S
}

/// Minimum interval of the drives, microseconds; 0 if it is unlimited.
pub(super) fn least_interval_us(sewing: &Sewing) -> f64 {
    sewing.max_hz.map_or(0.0, |rate| US_PER_S / rate)
}

/// Minimum time of a move of a number of steps, microseconds: acceleration from the start rate, the maximum rate if it is
/// reached, and deceleration. Found by bisection of the time, independent of the closed form.
pub(super) fn least_move_us(sewing: &Sewing, steps: u64) -> f64 {
    if steps == 0 {
        return 0.0;
    }
    let way = steps as f64 * sewing.step_mm;
    let start = sewing.start_hz * sewing.step_mm;
    let top = sewing.max_hz.map_or(f64::INFINITY, |rate| rate * sewing.step_mm);
    let reach = |time: f64| {
        // The speed rises during half of the time, then falls; the part above the maximum is cut off.
        let peak = start + sewing.feed_acceleration_mm_s2 * time / 2.0;
        let over = (peak - top).max(0.0);
        start * time + (peak - start) * time / 2.0 - over * over / sewing.feed_acceleration_mm_s2
    };
    let (mut short, mut long) = (0.0, 1.0);
    while reach(long) < way {
        long *= 2.0;
    }
    for _ in 0..HALVINGS {
        let middle = f64::midpoint(short, long);
        if reach(middle) < way { short = middle } else { long = middle }
    }
    long * US_PER_S
}

/// Number of bisections of the time, until rounding decides.
const HALVINGS: u32 = 60;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_least_time_of_a_move_is_that_of_the_headline_figures() {
        let sewing = Sewing::default();
        for (steps, rpm) in [(50, 3200.0), (60, 2800.0)] {
            assert!((least_move_us(&sewing, steps) / window_us(&sewing, rpm) - 1.0).abs() < 1e-4);
        }
        assert!((first_step_us(&sewing) - 341.6).abs() < 0.1);
    }
}
