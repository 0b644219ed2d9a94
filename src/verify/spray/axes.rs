//! Checks of times, program ends and axis limits, by finite differences of the rows.

use super::rows::{POSITION_ROUNDING, Row, SPEED_ROUNDING, TIME_ROUNDING};
use super::rules::{self, OF_AXES};
use crate::ir::verdict::WorstByRule;
use crate::machine::{Job, Table};
use crate::verify::axes::differences::{Differences, ORDERS};

/// Rounding of computed times, s.
const TIME_EPSILON: f64 = 1e-9;

/// Verifies the motion of the axes.
pub(super) fn judge(rows: &[Row], job: &Job, worst: &mut WorstByRule) {
    let profile = &job.profile;
    let period = profile.time.period();
    for (tick, row) in rows.iter().enumerate() {
        let late = (row.time - tick as f64 * period).abs();
        worst.see_under(&rules::TIME, late, TIME_ROUNDING + TIME_EPSILON, row.sighting());
        let off = profile.table.off([row.head.x, row.head.y]);
        if off.is_finite() {
            worst.see_under(&rules::TABLE, off.max(0.0), Table::EDGE_MM, row.sighting());
        }
        if let Some([least, most]) = profile.c.range_deg {
            let beyond = (least - row.c_deg).max(row.c_deg - most).max(0.0);
            worst.see_under(&rules::C_RANGE, beyond, POSITION_ROUNDING, row.sighting());
        }
    }
    ends(rows, job, worst);
    differences(rows, job, worst);
    velocities(rows, job, worst);
}

/// Checks the first and the last row.
fn ends(rows: &[Row], job: &Job, worst: &mut WorstByRule) {
    let away = |row: &Row, [x, y, c]: [f64; 3]| {
        let turned = (row.c_deg - c).abs();
        (row.head.x - x).abs().max((row.head.y - y).abs()).max(turned)
    };
    let (first, last) = (&rows[0], &rows[rows.len() - 1]);
    let start = away(first, job.profile.home) + f64::from(u8::from(first.jet));
    worst.see_under(&rules::START, start, 2.0 * POSITION_ROUNDING, first.sighting());
    let parked = job.profile.park.map_or(0.0, |park| away(last, park));
    let end = parked + f64::from(u8::from(last.jet));
    worst.see_under(&rules::END, end, 2.0 * POSITION_ROUNDING, last.sighting());
}

/// Checks differences of order 1 to 3; the axes rest before the first row and behind the last.
fn differences(rows: &[Row], job: &Job, worst: &mut WorstByRule) {
    let mut differences = Differences::new(&job.profile, [POSITION_ROUNDING; 3]).with_run_ups();
    let last = &rows[rows.len() - 1];
    for row in rows.iter().chain([last; ORDERS]) {
        let Some(rates) = differences.see([row.head.x, row.head.y, row.c_deg], row.jet) else { continue };
        for (rules, rates) in OF_AXES.into_iter().zip(rates) {
            for (rule, rate) in rules.into_iter().zip(rates) {
                worst.see_under(rule, rate.value, rate.limit, row.sighting());
            }
        }
    }
}

/// Compares velocities with the mean velocity before and behind a row: these may differ by the effect of jerk in a period.
fn velocities(rows: &[Row], job: &Job, worst: &mut WorstByRule) {
    let period = job.profile.time.period();
    let [x, y, _] = job.profile.axes.limits();
    let allowed = 0.5 * x.jerk.max(y.jerk) * period * period + SPEED_ROUNDING + POSITION_ROUNDING / period;
    for window in rows.windows(3) {
        let [before, row, behind] = window else { unreachable!("windows of three") };
        let mean = (behind.head - before.head) / (2.0 * period);
        let off = (mean.x - row.velocity[0]).abs().max((mean.y - row.velocity[1]).abs());
        worst.see_under(&rules::VELOCITY, off, allowed, row.sighting());
    }
    for row in [&rows[0], &rows[rows.len() - 1]] {
        let moving = row.velocity[0].abs().max(row.velocity[1].abs());
        worst.see_under(&rules::VELOCITY, moving, allowed, row.sighting());
    }
}
