//! Checks that blades rest in the cloth while they go down and come up, that they are fully down or up before they are sent
//! back, and that programs begin and end at rest.

use super::rows::Row;
use super::rules;
use crate::geom::Point;
use crate::ir::verdict::{Sighting, WorstByRule};
use crate::machine::MachineProfile;

/// Greatest move of a resting blade, mm: rounding.
const STILL: f64 = 1e-5;
/// Greatest turn of C at rest, degrees: rounding.
const STILL_DEG: f64 = 1e-5;
/// Rounding of times, s, and of numbers of periods.
const TIME: f64 = 1e-9;

/// Check of the rests of a head over its rows.
pub(super) struct Rest {
    period: f64,
    /// Number of rows seen.
    rows: usize,
    /// Rows that a blade rests after its down command, rows that it rests after its up command, and rows until it is fully up.
    ticks: [usize; 3],
    /// Row of the last change of the knife command, with the position of the blade and of C, degrees, at that row.
    since: Option<(usize, Point, f64)>,
    is_down: bool,
    /// First two rows and last two rows.
    ends: [Vec<(Row, Sighting)>; 2],
}

impl Rest {
    pub(super) fn new(profile: &MachineProfile) -> Self {
        let period = profile.time.period();
        let knife = &profile.knife;
        let ticks = [knife.plunge_ms, knife.clear_ms.unwrap_or(knife.lift_ms), knife.lift_ms]
            .map(|ms| (ms / profile.time.period_ms - TIME).ceil() as usize);
        Self { period, rows: 0, ticks, since: None, is_down: false, ends: [Vec::new(), Vec::new()] }
    }

    /// Processes the next row.
    pub(super) fn see(&mut self, row: &Row, at: Sighting, worst: &mut WorstByRule) {
        let number = self.rows;
        self.rows += 1;
        if row.knife != self.is_down {
            if let Some((since, _, _)) = self.since {
                let (rule, ticks) =
                    if row.knife { (&rules::UP, self.ticks[2]) } else { (&rules::DWELL, self.ticks[0]) };
                let lacking = (ticks as f64 - (number - since) as f64) * self.period;
                worst.see_under(rule, lacking, TIME, at);
            }
            self.is_down = row.knife;
            self.since = Some((number, at.point, row.c));
        }
        if let Some((since, point, c)) = self.since {
            let ticks = if self.is_down { self.ticks[0] } else { self.ticks[1] };
            if number <= since + ticks {
                let turned = (row.c - c).abs() / STILL_DEG * STILL;
                worst.see_under(&rules::REST, (at.point - point).norm().max(turned), STILL, at);
            }
        }
        let [first, last] = &mut self.ends;
        if first.len() < 2 {
            first.push((*row, at));
        }
        last.push((*row, at));
        if last.len() > 2 {
            last.remove(0);
        }
    }

    /// Number of ends of the program that are not at rest, and the place of the last row.
    pub(super) fn finish(self) -> (usize, Option<Sighting>) {
        let rests = |rows: &[(Row, Sighting)]| match rows {
            [(a, from), (b, to)] => {
                let along = (a.place[0] - b.place[0]).abs();
                let moved = along.max((from.point.y - to.point.y).abs()).max((a.c - b.c).abs());
                moved <= STILL && !a.knife && !b.knife
            }
            _ => false,
        };
        let wrong = self.ends.iter().filter(|rows| !rests(rows)).count();
        (wrong, self.ends[1].last().map(|end| end.1))
    }
}
