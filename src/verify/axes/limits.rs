//! Speed, acceleration and jerk of each axis by finite differences of the rows, their times, and the reach of C.
//!
//! A difference of order k over the period h is a weighted mean of the k-th derivative; rounding of the printed numbers
//! can add 2^k q / h^k, q half of the last decimal, which is allowed for exactly.
//!
//! The way from one row to the next belongs to a cut when the knife is commanded down at the first of them, and else to a
//! travel, which may have limits of its own. A difference over ways of both kinds may reach the wider of the two.

use crate::ir::Finding;
use crate::ir::verdict::{Rule, Worst};
use crate::machine::{self, MachineProfile};
use crate::units::deg;
use crate::verify::program::row::{Rounding, Row, TIME_ROUNDING};
use crate::verify::rules;

/// The rules by order and axis.
static BY_ORDER: [[&Rule; 3]; 3] = [
    [&rules::SPEED_X, &rules::SPEED_Y, &rules::SPEED_C],
    [&rules::ACCELERATION_X, &rules::ACCELERATION_Y, &rules::ACCELERATION_C],
    [&rules::JERK_X, &rules::JERK_Y, &rules::JERK_C],
];

/// Relative excess over a limit that is rounding of the computation.
const LIMIT_EPSILON: f64 = 1e-6;
/// Rounding of a time that is a product of tick and period, s.
const TIME_EPSILON: f64 = 1e-9;

/// Watches the rows.
pub(in crate::verify) struct Limits {
    period: f64,
    /// Position and its differences of order 1 and 2, axis by axis.
    last: Option<[[f64; 3]; 3]>,
    /// Limits by order and axis, in a cut, in a travel, and where both take part.
    allowed: [[[f64; 3]; 3]; 3],
    /// Whether the knife is down at the last rows, a bit for each, the last one lowest.
    down: u8,
    axes: [[Worst; 3]; 3],
    time: Worst,
    c_range: Worst,
    range: Option<[f64; 2]>,
}

/// What differences may reach, by order and axis, mm or degrees per s to the power of the order.
fn allowed([x, y, c]: [machine::Limits; 3], period: f64, rounding: Rounding) -> [[f64; 3]; 3] {
    let limits = [
        [x.speed, y.speed, deg(c.speed)],
        [x.acceleration, y.acceleration, deg(c.acceleration)],
        [x.jerk, y.jerk, deg(c.jerk)],
    ];
    std::array::from_fn(|order| {
        let grown = [1, 2, 3].map(|k| (2.0 / period).powi(k))[order];
        std::array::from_fn(|axis| limits[order][axis] * (1.0 + LIMIT_EPSILON) + rounding.axes[axis] * grown)
    })
}

impl Limits {
    pub(in crate::verify) fn new(profile: &MachineProfile, rounding: Rounding) -> Self {
        let period = profile.time.period();
        let cut = allowed(profile.axes.limits(), period, rounding);
        let air = allowed(profile.axes.travel_limits(), period, rounding);
        let wider = std::array::from_fn(|order| std::array::from_fn(|axis| cut[order][axis].max(air[order][axis])));
        let axes = std::array::from_fn(|order| {
            let worst = |axis: usize| Worst::new(BY_ORDER[order][axis], Some(cut[order][axis]));
            std::array::from_fn(worst)
        });
        let range = profile.c.range_deg;
        Self {
            period,
            last: None,
            allowed: [cut, air, wider],
            down: 0,
            axes,
            time: Worst::new(&rules::TIME, Some(TIME_ROUNDING + TIME_EPSILON)),
            c_range: Worst::new(&rules::C_RANGE, range.map(|_| rounding.axes[2])),
            range,
        }
    }

    /// Sees a row, whether it has a time or not.
    pub(in crate::verify) fn see(&mut self, row: &Row) {
        if let Some([least, greatest]) = self.range {
            self.c_range.see((least - row.c_deg).max(row.c_deg - greatest), || row.sighting());
        }
    }

    /// Sees a row that has a time.
    pub(in crate::verify) fn see_timed(&mut self, row: &Row) {
        self.time.see((row.t - row.tick as f64 * self.period).abs(), || row.sighting());
        let here = [row.centre.x, row.centre.y, row.c_deg];
        let down = self.down;
        self.down = down << 1 | u8::from(row.knife);
        let Some(last) = &mut self.last else {
            self.last = Some([here, [0.0; 3], [0.0; 3]]);
            return;
        };
        // A difference of order k is made of the ways that begin at the last k rows.
        let [speed, acceleration, jerk] = [0b1, 0b11, 0b111].map(|ways: u8| match down & ways {
            0 => 1,
            all if all == ways => 0,
            _ => 2,
        });
        for axis in 0..3 {
            let first = here[axis] - last[0][axis];
            let second = first - last[1][axis];
            let third = second - last[2][axis];
            let h = self.period;
            let allowed = |which: usize, order: usize| self.allowed[which][order][axis];
            self.axes[0][axis].see_under(first.abs() / h, allowed(speed, 0), || row.sighting());
            self.axes[1][axis].see_under(second.abs() / (h * h), allowed(acceleration, 1), || row.sighting());
            self.axes[2][axis].see_under(third.abs() / (h * h * h), allowed(jerk, 2), || row.sighting());
            (last[0][axis], last[1][axis], last[2][axis]) = (here[axis], first, second);
        }
    }

    /// What was seen; behind the last row the axes must be able to rest.
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
