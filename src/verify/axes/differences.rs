//! Speed, acceleration and jerk of the axes by finite differences of the rows.
//!
//! A difference of order k over the period h is a weighted mean of the k-th derivative; rounding of the printed numbers
//! can add 2^k q / h^k, q half of the last decimal, which is allowed for exactly.
//!
//! The way from one row to the next belongs to work when the tool is on at the first of them, and else to a travel, which
//! may have limits of its own. A difference over ways of both kinds may reach the wider of the two.

use crate::machine::{Limits, MachineProfile};
use crate::units::deg;

/// Orders of differences, and axes.
pub(in crate::verify) const ORDERS: usize = 3;
const AXES: usize = 3;
/// Relative excess over a limit that is rounding of the computation.
const LIMIT_EPSILON: f64 = 1e-6;

/// A derivative, and what it may reach, mm or degrees per s to the power of its order.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::verify) struct Rate {
    pub(in crate::verify) value: f64,
    pub(in crate::verify) limit: f64,
}

/// Follows the places of x, y, c, mm and degrees, from row to row.
#[derive(Debug)]
pub(in crate::verify) struct Differences {
    period: f64,
    /// Place and its differences of order 1 and 2, axis by axis.
    last: Option<[[f64; AXES]; ORDERS]>,
    /// Limits by order and axis: at work, in a travel, and where both take part.
    allowed: [[[f64; AXES]; ORDERS]; 3],
    /// Whether the tool is on at the last rows, a bit for each, the last one lowest.
    is_on: u8,
}

/// What differences may reach, by order and axis.
fn allowed([x, y, c]: [Limits; AXES], period: f64, rounding: [f64; AXES]) -> [[f64; AXES]; ORDERS] {
    let limits = [
        [x.speed, y.speed, deg(c.speed)],
        [x.acceleration, y.acceleration, deg(c.acceleration)],
        [x.jerk, y.jerk, deg(c.jerk)],
    ];
    std::array::from_fn(|order| {
        let grown = [1, 2, 3].map(|k| (2.0 / period).powi(k))[order];
        std::array::from_fn(|axis| limits[order][axis] * (1.0 + LIMIT_EPSILON) + rounding[axis] * grown)
    })
}

impl Differences {
    /// For rows whose places are rounded by so much, mm and degrees.
    pub(in crate::verify) fn new(profile: &MachineProfile, rounding: [f64; AXES]) -> Self {
        let period = profile.time.period();
        let work = allowed(profile.axes.limits(), period, rounding);
        let air = allowed(profile.axes.travel_limits(), period, rounding);
        let wider = std::array::from_fn(|order| std::array::from_fn(|axis| work[order][axis].max(air[order][axis])));
        Self { period, last: None, allowed: [work, air, wider], is_on: 0 }
    }

    /// Allows travels what is allowed at work, too: a head may gather speed for an edge before its jet opens.
    pub(in crate::verify) fn with_run_ups(mut self) -> Self {
        self.allowed[1] = self.allowed[2];
        self
    }

    /// Limits at work, by order and axis.
    pub(in crate::verify) fn at_work(&self) -> [[f64; AXES]; ORDERS] {
        self.allowed[0]
    }

    /// Sees the next row: the derivatives there, by order and axis. The axes rest before the first one, which has none.
    pub(in crate::verify) fn see(&mut self, here: [f64; AXES], is_on: bool) -> Option<[[Rate; AXES]; ORDERS]> {
        let ways_on = self.is_on;
        self.is_on = ways_on << 1 | u8::from(is_on);
        let Some(last) = &mut self.last else {
            self.last = Some([here, [0.0; AXES], [0.0; AXES]]);
            return None;
        };
        // A difference of order k is made of the ways that begin at the last k rows.
        let kinds = [0b1, 0b11, 0b111].map(|ways: u8| match ways_on & ways {
            0 => 1,
            all if all == ways => 0,
            _ => 2,
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
