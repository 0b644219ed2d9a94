//! Pace of a run: the speed of the spindle at each of its stitches.
//!
//! A spindle that is heavy keeps one speed, apart from its soft start. One that eases sews each stitch as fast as the stitch
//! permits, and changes its speed between two windows, while X and Y stand: pulses are timed by a constant speed.

use crate::machine::Sewing;
use crate::machine::sewing::Spindle;
use crate::units::S_PER_MIN;

/// Speeds of the stitches of a run in order, stitches per minute. `alone` are the speeds at which each would fit, `least` is
/// that of the slowest stitch after the soft start.
pub(super) fn paced(alone: &[f64], least: f64, sewing: &Sewing) -> Vec<f64> {
    let first = soft_stitches(alone.len(), sewing);
    let soft = alone[..first].iter().copied().fold(sewing.soft_start_rpm.unwrap_or(least), f64::min);
    match sewing.spindle {
        Spindle::Uniform => {
            let soft = soft.min(least).floor();
            (0..alone.len()).map(|i| if i < first { soft } else { least }).collect()
        }
        Spindle::Eased => {
            let limit = |(i, &alone): (usize, &f64)| if i < first { soft.floor() } else { alone };
            eased(alone.iter().enumerate().map(limit).collect(), sewing)
        }
    }
}

/// Number of stitches of a soft start in a run of a number of stitches.
pub(super) fn soft_stitches(stitches: usize, sewing: &Sewing) -> usize {
    sewing.soft_start_rpm.map_or(0, |_| stitches.min(sewing.soft_start_stitches as usize))
}

/// Greatest speeds below limits that the spindle reaches from one stitch to the next, forwards and backwards.
fn eased(mut limits: Vec<f64>, sewing: &Sewing) -> Vec<f64> {
    // v1^2 = v0^2 + 2 a d, where d is the part of a turn outside the window, in turns and minutes.
    let change = 2.0 * sewing.spindle_rpm_s * S_PER_MIN * (1.0 - sewing.window());
    let reached = |from: f64| on_grid((from * from + change).sqrt(), sewing).max(from);
    for i in 1..limits.len() {
        limits[i] = limits[i].min(reached(limits[i - 1]));
    }
    for i in (1..limits.len()).rev() {
        limits[i - 1] = limits[i - 1].min(reached(limits[i]));
    }
    limits
}

/// Largest speed of the grid up to a limit; 0 if that is below the first.
pub(super) fn on_grid(rpm: f64, sewing: &Sewing) -> f64 {
    let grid = f64::from(sewing.grid_rpm);
    (rpm / grid).floor() * grid
}

/// Time of stitches that are sewn at these speeds, s. Between two windows the speed changes evenly.
pub(super) fn duration(speeds: &[f64], sewing: &Sewing) -> f64 {
    match sewing.spindle {
        Spindle::Uniform => speeds.chunk_by(|a, b| a == b).map(|alike| alike.len() as f64 * S_PER_MIN / alike[0]).sum(),
        Spindle::Eased => {
            let turn = |i: usize| {
                let next = speeds.get(i + 1).unwrap_or(&speeds[i]);
                let between = f64::midpoint(speeds[i], *next);
                S_PER_MIN * (sewing.window() / speeds[i] + (1.0 - sewing.window()) / between)
            };
            (0..speeds.len()).map(turn).sum()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_spindle_that_eases_slows_down_before_a_long_stitch_and_recovers_after_it() {
        let mut alone = [3200.0; 20];
        alone[10] = 1200.0;
        let sewing = Sewing { spindle: Spindle::Eased, soft_start_rpm: None, ..Sewing::default() };
        let speeds = paced(&alone, 1200.0, &sewing);
        assert_eq!(speeds[10], 1200.0);
        assert_eq!(speeds[9], speeds[11]);
        // sqrt(1200^2 + 120 * 10000 * 140/360) = 1381, on the grid; after ten stitches 2470 less what the grid takes at each.
        assert_eq!((speeds[11], speeds[0]), (1380.0, 2430.0));
        let uniform = Sewing { spindle: Spindle::Uniform, ..sewing.clone() };
        let slow = paced(&alone, 1200.0, &uniform);
        assert_eq!(slow, [1200.0; 20]);
        assert!(duration(&speeds, &sewing) < 0.7 * duration(&slow, &uniform));
    }

    #[test]
    fn a_spindle_that_cannot_change_keeps_the_speed_of_the_slowest_stitch() {
        let sewing = Sewing { spindle: Spindle::Eased, spindle_rpm_s: 1.0, ..Sewing::default() };
        assert_eq!(paced(&[3200.0, 3200.0, 3200.0, 900.0], 900.0, &sewing), [400.0; 4]);
    }
}
