//! Axis limits row by row, times of the rows, and range of C.

use crate::ir::Finding;
use crate::ir::verdict::{Rule, Worst};
use crate::machine::MachineProfile;
use crate::verify::axes::differences::Differences;
use crate::verify::program::row::{Rounding, Row, TIME_ROUNDING};
use crate::verify::rules;

/// Rules by order and axis.
static BY_ORDER: [[&Rule; 3]; 3] = [
    [&rules::SPEED_X, &rules::SPEED_Y, &rules::SPEED_C],
    [&rules::ACCELERATION_X, &rules::ACCELERATION_Y, &rules::ACCELERATION_C],
    [&rules::JERK_X, &rules::JERK_Y, &rules::JERK_C],
];

/// Rounding error of a time computed as tick times period, s.
const TIME_EPSILON: f64 = 1e-9;

/// Check of limits over the rows.
pub(in crate::verify) struct Limits {
    period: f64,
    differences: Differences,
    axes: [[Worst; 3]; 3],
    time: Worst,
    c_range: Worst,
    range: Option<[f64; 2]>,
}

impl Limits {
    pub(in crate::verify) fn new(profile: &MachineProfile, rounding: Rounding) -> Self {
        let period = profile.time.period();
        let differences = Differences::new(profile, rounding.axes);
        let cut = differences.at_work();
        let axes = std::array::from_fn(|order| {
            let worst = |axis: usize| Worst::new(BY_ORDER[order][axis], Some(cut[order][axis]));
            std::array::from_fn(worst)
        });
        let range = profile.c.range_deg;
        Self {
            period,
            differences,
            axes,
            time: Worst::new(&rules::TIME, Some(TIME_ROUNDING + TIME_EPSILON)),
            c_range: Worst::new(&rules::C_RANGE, range.map(|_| rounding.axes[2])),
            range,
        }
    }

    /// Processes a row, with or without a time.
    pub(in crate::verify) fn see(&mut self, row: &Row) {
        if let Some([least, greatest]) = self.range {
            self.c_range.see((least - row.c_deg).max(row.c_deg - greatest), || row.sighting());
        }
    }

    /// Processes a row that has a time.
    pub(in crate::verify) fn see_timed(&mut self, row: &Row) {
        self.time.see((row.t - row.tick as f64 * self.period).abs(), || row.sighting());
        let here = [row.centre.x, row.centre.y, row.c_deg];
        let Some(rates) = self.differences.see(here, row.knife) else { return };
        for (worsts, rates) in self.axes.iter_mut().zip(rates) {
            for (worst, rate) in worsts.iter_mut().zip(rates) {
                worst.see_under(rate.value, rate.limit, || row.sighting());
            }
        }
    }

    /// Findings. The axes must be able to come to rest behind the last row.
    pub(in crate::verify) fn findings(mut self, last: Option<&Row>) -> Vec<Finding> {
        let period = self.period;
        if let Some(last) = last {
            for i in 1..=3 {
                let tick = last.tick + i;
                self.see_timed(&Row { tick, t: tick as f64 * period, ..*last });
            }
        }
        let mut findings = vec![self.time.finding(), self.c_range.finding()];
        findings.extend(self.axes.into_iter().flatten().map(Worst::finding));
        findings
    }
}
