//! Speed, acceleration and jerk of a head, from differences of its rows: those of the head over the table, which along the
//! feed moves with the cloth while it cuts.

use super::rows::Row;
use super::rules;
use crate::ir::verdict::{Rule, Sighting, WorstByRule};
use crate::machine::MachineProfile;
use crate::units::rad;

/// Orders of differences that are judged.
static ORDERS: [&Rule; 3] = [&rules::SPEED, &rules::ACCELERATION, &rules::JERK];
/// Rows that a difference of the third order joins.
const SUPPORT: usize = 4;
/// Rounding of a row, half its last decimal, mm or degrees.
const HALF_DECIMAL: f64 = 5e-7;
/// Part of a limit by which a difference may pass it: rounding in the arithmetic.
const EXCESS: f64 = 1e-6;

/// Follows the rows of a head.
pub(super) struct Limits {
    /// Limits of x, y, c by order, per period: with the knife down, with it up, and where it changes.
    allowed: [[[f64; 3]; 3]; 3],
    /// The last rows, the newest first, and whether the knife was down in them.
    last: [([f64; 3], bool); SUPPORT],
    /// How many of these there are.
    count: usize,
}

impl Limits {
    pub(super) fn new(profile: &MachineProfile) -> Self {
        let h = profile.time.period();
        let rounding = |axis: usize| if axis == 2 { rad(HALF_DECIMAL) } else { HALF_DECIMAL };
        let rows = |limits: [crate::machine::Limits; 3]| -> [[f64; 3]; 3] {
            std::array::from_fn(|axis| {
                let of = limits[axis];
                let powers = [of.speed * h, of.acceleration * h * h, of.jerk * h * h * h];
                // A difference of order k is a sum of 2^k rounded numbers.
                std::array::from_fn(|order| {
                    let rounded = rounding(axis) * f64::from(2_u32 << order);
                    powers[order] * (1.0 + EXCESS) + rounded
                })
            })
        };
        let (down, up) = (rows(profile.axes.limits()), rows(profile.axes.travel_limits()));
        let either =
            std::array::from_fn(|axis| std::array::from_fn(|order| f64::max(down[axis][order], up[axis][order])));
        Self { allowed: [down, up, either], last: [([0.0; 3], false); SUPPORT], count: 0 }
    }

    /// Sees the next row.
    pub(super) fn see(&mut self, row: &Row, at: Sighting, worst: &mut WorstByRule) {
        self.last.rotate_right(1);
        self.last[0] = ([row.place[0], row.place[1], rad(row.c)], row.knife);
        self.count = (self.count + 1).min(SUPPORT);
        let last = &self.last[..self.count];
        let downs = last.iter().filter(|row| row.1).count();
        let allowed = if downs == last.len() {
            &self.allowed[0]
        } else if downs == 0 {
            &self.allowed[1]
        } else {
            &self.allowed[2]
        };
        for (axis, allowed) in allowed.iter().enumerate() {
            let mut column = self.last.map(|row| row.0[axis]);
            for (order, rule) in ORDERS.into_iter().enumerate().take(last.len() - 1) {
                for i in 0..SUPPORT - 1 - order {
                    column[i] -= column[i + 1];
                }
                worst.see_under(rule, column[0].abs() / allowed[order], 1.0, at);
            }
        }
    }
}
