//! Speed, acceleration and jerk of the axes by finite differences of the rows.
//!
//! A difference of order k over the period h is a weighted mean of the k-th derivative. Rounding of the printed numbers can add
//! 2^k q / h^k, with q half of the last decimal; exactly that much is allowed for.
//!
//! A step between two rows counts as work if the tool is on at its first row, else as travel, which may have separate limits. A
//! difference over steps of both kinds may reach the wider limit.

use crate::machine::{Limits, MachineProfile};
use crate::units::deg;

/// Orders of differences.
pub(in crate::verify) const ORDERS: usize = 3;
/// Axes: x, y and C.
const AXES: usize = 3;
/// Kinds of steps in a difference.
const WORK: usize = 0;
const TRAVEL: usize = 1;
const MIXED: usize = 2;
/// Relative excess over a limit that counts as rounding of the computation.
const LIMIT_EPSILON: f64 = 1e-6;

/// Magnitude of a derivative and its limit, mm or degrees per s to the power of its order.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::verify) struct Rate {
    pub(in crate::verify) value: f64,
    pub(in crate::verify) limit: f64,
}

/// Finite differences of X, Y (mm) and C (degrees) from row to row.
#[derive(Debug)]
pub(in crate::verify) struct Differences {
    /// Time between rows, s.
    period: f64,
    /// Position and its differences of order 1 and 2, axis by axis.
    last: Option<[[f64; AXES]; ORDERS]>,
    /// Limits by kind of steps, order and axis.
    allowed: [[[f64; AXES]; ORDERS]; 3],
    /// Tool state of the last rows, one bit each (1 = on), the last row in the lowest bit.
    is_on: u8,
}

/// Limits of differences, by order and axis.
fn allowed([x, y, c]: [Limits; AXES], period: f64, rounding: [f64; AXES]) -> [[f64; AXES]; ORDERS] {
    let limits = [
        [x.speed, y.speed, deg(c.speed)],
        [x.acceleration, y.acceleration, deg(c.acceleration)],
        [x.jerk, y.jerk, deg(c.jerk)],
    ];
    let growth = [1, 2, 3].map(|order| (2.0 / period).powi(order));
    std::array::from_fn(|order| {
        std::array::from_fn(|axis| limits[order][axis] * (1.0 + LIMIT_EPSILON) + rounding[axis] * growth[order])
    })
}

impl Differences {
    /// Differences of rows whose positions are rounded by `rounding`, mm and degrees.
    pub(in crate::verify) fn new(profile: &MachineProfile, rounding: [f64; AXES]) -> Self {
        let period = profile.time.period();
        let work = allowed(profile.axes.limits(), period, rounding);
        let travel = allowed(profile.axes.travel_limits(), period, rounding);
        let mixed = std::array::from_fn(|order| std::array::from_fn(|axis| work[order][axis].max(travel[order][axis])));
        Self { period, last: None, allowed: [work, travel, mixed], is_on: 0 }
    }

    /// Allows travel the limits of work, too: a head may accelerate towards an edge before its jet opens.
    pub(in crate::verify) fn with_run_ups(mut self) -> Self {
        self.allowed[TRAVEL] = self.allowed[MIXED];
        self
    }

    /// Limits at work, by order and axis.
    pub(in crate::verify) fn at_work(&self) -> [[f64; AXES]; ORDERS] {
        self.allowed[WORK]
    }

    /// Processes the next row and returns the derivatives there, by order and axis; `None` at the first row, before which the
    /// axes rest.
    pub(in crate::verify) fn see(&mut self, here: [f64; AXES], is_on: bool) -> Option<[[Rate; AXES]; ORDERS]> {
        let ways_on = self.is_on;
        self.is_on = ways_on << 1 | u8::from(is_on);
        let Some(last) = &mut self.last else {
            self.last = Some([here, [0.0; AXES], [0.0; AXES]]);
            return None;
        };
        // A difference of order k covers the steps that begin at the last k rows.
        let kinds = [0b1, 0b11, 0b111].map(|ways: u8| match ways_on & ways {
            0 => TRAVEL,
            all if all == ways => WORK,
            _ => MIXED,
        });
        let h = self.period;
        let mut rates = [[Rate { value: 0.0, limit: 0.0 }; AXES]; ORDERS];
        for axis in 0..AXES {
            let first = here[axis] - last[0][axis];
            let second = first - last[1][axis];
            let third = second - last[2][axis];
            let values = [first.abs() / h, second.abs() / (h * h), third.abs() / (h * h * h)];
            for (order, value) in values.into_iter().enumerate() {
                rates[order][axis] = Rate { value, limit: self.allowed[kinds[order]][order][axis] };
            }
            (last[0][axis], last[1][axis], last[2][axis]) = (here[axis], first, second);
        }
        Some(rates)
    }
}
