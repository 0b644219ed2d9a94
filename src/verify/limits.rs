//! Speed, acceleration and jerk of each axis by finite differences of the rows, their times, and the reach of C.
//!
//! A difference of order k over the period h is a weighted mean of the k-th derivative; rounding of the printed numbers
//! can add 2^k q / h^k, q half of the last decimal, which is allowed for exactly.

use super::read::{ROUNDING, Row, TIME_ROUNDING};
use super::worst::Worst;
use crate::ir::Finding;
use crate::machine::MachineProfile;
use crate::units::deg;

/// Codes by order and axis.
const RULES: [[&str; 3]; 3] = [
    ["verify/speed-x", "verify/speed-y", "verify/speed-c"],
    ["verify/acceleration-x", "verify/acceleration-y", "verify/acceleration-c"],
    ["verify/jerk-x", "verify/jerk-y", "verify/jerk-c"],
];
const UNITS: [[&str; 3]; 3] = [["mm/s", "mm/s", "deg/s"], ["mm/s2", "mm/s2", "deg/s2"], ["mm/s3", "mm/s3", "deg/s3"]];

/// Relative excess over a limit that is rounding of the computation.
const LIMIT_EPSILON: f64 = 1e-6;
/// Rounding of a time that is a product of tick and period, s.
const TIME_EPSILON: f64 = 1e-9;

/// Watches the rows.
pub(super) struct Limits {
    period: f64,
    /// Position and its differences of order 1 and 2, axis by axis.
    last: Option<[[f64; 3]; 3]>,
    axes: [[Worst; 3]; 3],
    time: Worst,
    c_range: Worst,
    range: Option<[f64; 2]>,
}

impl Limits {
    pub(super) fn new(profile: &MachineProfile) -> Self {
        let period = profile.time.period();
        let [x, y, c] = profile.axes.limits();
        let limits = [
            [x.speed, y.speed, deg(c.speed)],
            [x.acceleration, y.acceleration, deg(c.acceleration)],
            [x.jerk, y.jerk, deg(c.jerk)],
        ];
        let axes = std::array::from_fn(|order| {
            let rounding = ROUNDING * [1, 2, 3].map(|k| (2.0 / period).powi(k))[order];
            std::array::from_fn(|axis| {
                let limit = limits[order][axis] * (1.0 + LIMIT_EPSILON) + rounding;
                Worst::new(RULES[order][axis], UNITS[order][axis], Some(limit))
            })
        });
        let range = profile.c.range_deg;
        Self {
            period,
            last: None,
            axes,
            time: Worst::new("verify/time", "s", Some(TIME_ROUNDING + TIME_EPSILON)),
            c_range: Worst::new("verify/c-range", "deg", range.map(|_| ROUNDING)),
            range,
        }
    }

    pub(super) fn see(&mut self, row: &Row) {
        self.time.see((row.t - row.tick as f64 * self.period).abs(), || row.sighting());
        if let Some([least, greatest]) = self.range {
            self.c_range.see((least - row.c_deg).max(row.c_deg - greatest), || row.sighting());
        }
        let here = [row.centre.x, row.centre.y, row.c_deg];
        let Some(last) = &mut self.last else {
            self.last = Some([here, [0.0; 3], [0.0; 3]]);
            return;
        };
        for axis in 0..3 {
            let first = here[axis] - last[0][axis];
            let second = first - last[1][axis];
            let third = second - last[2][axis];
            let h = self.period;
            self.axes[0][axis].see(first.abs() / h, || row.sighting());
            self.axes[1][axis].see(second.abs() / (h * h), || row.sighting());
            self.axes[2][axis].see(third.abs() / (h * h * h), || row.sighting());
            (last[0][axis], last[1][axis], last[2][axis]) = (here[axis], first, second);
        }
    }

    /// What was seen; behind the last row the axes must be able to rest.
    pub(super) fn findings(mut self, last: Option<&Row>) -> Vec<Finding> {
        let period = self.period;
        if let Some(last) = last {
            for i in 1..=3 {
                let tick = last.tick + i;
                self.see(&Row { tick, t: tick as f64 * period, ..*last });
            }
        }
        let mut findings = vec![self.time.finding(), self.c_range.finding()];
        findings.extend(self.axes.into_iter().flatten().map(Worst::finding));
        findings
    }
}
