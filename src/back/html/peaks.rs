//! Speed, acceleration and jerk of the axes over time, relative to their limits: minimum and maximum of each in every stretch
//! of a few ticks.

use super::fit::Axes;
use crate::picture::Columns;

/// Maximum number of stretches; beyond it stretches are merged in pairs.
const MOST: usize = 1 << 14;
/// Steps per limit.
const STEPS: f64 = 100.0;
/// Maximum recorded value, in steps; beyond it the amount of the violation has no meaning.
const BEYOND: f64 = 250.0;
/// Orders of differences: speed, acceleration, jerk.
const ORDERS: usize = 3;
/// Names of the columns, minimum and maximum, by order and axis.
const NAMES: [[[&str; 2]; 3]; ORDERS] = [
    [["speed_x_least", "speed_x_most"], ["speed_y_least", "speed_y_most"], ["speed_c_least", "speed_c_most"]],
    [["acc_x_least", "acc_x_most"], ["acc_y_least", "acc_y_most"], ["acc_c_least", "acc_c_most"]],
    [["jerk_x_least", "jerk_x_most"], ["jerk_y_least", "jerk_y_most"], ["jerk_c_least", "jerk_c_most"]],
];

/// Limits of speed, acceleration and jerk of each axis, in mm or degrees and powers of s.
pub(super) type Limits = [[f64; ORDERS]; 3];

/// Minimum and maximum by order and axis in a stretch, in steps of the limits.
type Stretch = [[[i16; 2]; 3]; ORDERS];

/// The stretches of a program.
#[derive(Debug)]
pub(super) struct Peaks {
    /// Cycle of the setpoints, s.
    period: f64,
    /// Ticks per stretch.
    ticks: u64,
    stretches: Vec<Stretch>,
    /// Differences at the last setpoint, by order; the first is the setpoint itself.
    last: [Axes; ORDERS + 1],
    /// Number of setpoints so far.
    count: u64,
}

impl Peaks {
    pub(super) fn new(period: f64) -> Self {
        Self { period, ticks: 4, stretches: Vec::new(), last: [[0.0; 3]; ORDERS + 1], count: 0 }
    }

    /// Adds the setpoint of the next tick with the limits in force.
    pub(super) fn take(&mut self, at: Axes, limits: &Limits) {
        let mut differences = [at; ORDERS + 1];
        for order in 0..ORDERS {
            differences[order + 1] = [0, 1, 2].map(|axis| differences[order][axis] - self.last[order][axis]);
        }
        self.last = differences;
        if self.count / self.ticks == MOST as u64 {
            self.join();
        }
        let place = (self.count / self.ticks) as usize;
        if place == self.stretches.len() {
            self.stretches.push(Stretch::default());
        }
        let per_s = [1, 2, 3].map(|power| self.period.powi(power));
        // The first setpoints have no differences of the higher orders.
        for order in (0..ORDERS).filter(|&order| self.count > order as u64) {
            for axis in 0..3 {
                let share = differences[order + 1][axis] / (per_s[order] * limits[axis][order]);
                let steps = (share * STEPS).round().clamp(-BEYOND, BEYOND) as i16;
                let [least, most] = &mut self.stretches[place][order][axis];
                (*least, *most) = ((*least).min(steps), (*most).max(steps));
            }
        }
        self.count += 1;
    }

    /// Merges the stretches in pairs.
    fn join(&mut self) {
        let joined = self.stretches.chunks(2).map(|pair| {
            let mut all = pair[0];
            for (order, axis) in (0..ORDERS).flat_map(|order| [0, 1, 2].map(|axis| (order, axis))) {
                let [least, most] = pair[pair.len() - 1][order][axis];
                let [known_least, known_most] = all[order][axis];
                all[order][axis] = [known_least.min(least), known_most.max(most)];
            }
            all
        });
        self.stretches = joined.collect();
        self.ticks *= 2;
    }

    /// Ticks per stretch.
    pub(super) fn ticks(&self) -> u64 {
        self.ticks
    }

    /// Adds the columns of the stretches.
    pub(super) fn write(&self, columns: &mut Columns) {
        for (order, axis) in (0..ORDERS).flat_map(|order| [0, 1, 2].map(|axis| (order, axis))) {
            for (end, name) in NAMES[order][axis].into_iter().enumerate() {
                let steps = self.stretches.iter().map(|stretch| i64::from(stretch[order][axis][end]));
                columns.add(name, 1.0 / STEPS, steps);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const LIMITS: Limits = [[100.0, 1e4, 1e6]; 3];

    #[test]
    fn the_greatest_values_are_those_of_the_setpoints() {
        let mut peaks = Peaks::new(0.01);
        for at in [0.0, 0.0, 0.5, 1.0, 1.0] {
            peaks.take([at, -at, 0.0], &LIMITS);
        }
        let [speed, acceleration, jerk] = [0, 1, 2].map(|order| peaks.stretches.iter().map(move |s| s[order]));
        assert_eq!(speed.clone().map(|s| s[0]).collect::<Vec<_>>(), [[0, 50], [0, 0]]);
        assert_eq!(speed.map(|s| s[1]).collect::<Vec<_>>(), [[-50, 0], [0, 0]]);
        assert_eq!(acceleration.map(|s| s[0]).collect::<Vec<_>>(), [[0, 50], [-50, 0]]);
        assert_eq!(jerk.map(|s| s[0]).collect::<Vec<_>>(), [[-50, 0], [-50, 0]]);
    }

    #[test]
    fn long_programs_have_longer_stretches() {
        let mut peaks = Peaks::new(0.001);
        let setpoints = 5 * MOST as u64;
        for i in 0..setpoints {
            peaks.take([if i == 4 * MOST as u64 { 0.05 } else { 0.0 }, 0.0, 0.0], &LIMITS);
        }
        assert_eq!((peaks.ticks, peaks.stretches.len() as u64), (8, setpoints / 8));
        assert_eq!(peaks.stretches.iter().map(|s| s[0][0][1]).max(), Some(50));
    }
}
