//! Speed, acceleration and jerk of a head, from differences of its rows. They are those of the head over the table; along the
//! feed it moves with the cloth while it cuts.

use super::rows::Row;
use super::rules;
use crate::ir::verdict::{Rule, Sighting, WorstByRule};
use crate::machine::MachineProfile;
use crate::verify::axes::differences::{Differences, ORDERS};

/// Rules by the order of the difference.
static BY_ORDER: [&Rule; ORDERS] = [&rules::SPEED, &rules::ACCELERATION, &rules::JERK];
/// Rounding of a row: half of the last decimal, mm or degrees.
const HALF_DECIMAL: f64 = 5e-7;

/// Check of the limits of a head over its rows.
pub(super) struct Limits(Differences);

impl Limits {
    pub(super) fn new(profile: &MachineProfile) -> Self {
        Self(Differences::new(profile, [HALF_DECIMAL; 3]))
    }

    /// Processes the next row.
    pub(super) fn see(&mut self, row: &Row, at: Sighting, worst: &mut WorstByRule) {
        let Some(rates) = self.0.see([row.place[0], row.place[1], row.c], row.knife) else { return };
        for (rule, rates) in BY_ORDER.into_iter().zip(rates) {
            for rate in rates {
                worst.see_under(rule, rate.value / rate.limit, 1.0, at);
            }
        }
    }
}
