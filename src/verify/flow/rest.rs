//! Whether blades go down and come up at rest in the cloth, are all the way down and up before they are sent back, and
//! programs begin and end at rest.

use super::rows::Row;
use super::rules;
use crate::geom::Point;
use crate::ir::verdict::{Sighting, WorstByRule};
use crate::machine::MachineProfile;

/// How far a blade at rest may be off from row to row, mm: rounding.
const STILL: f64 = 1e-5;
/// How far C may turn meanwhile, degrees: likewise.
const STILL_DEG: f64 = 1e-5;
/// Rounding of times, s.
const TIME: f64 = 1e-9;

/// Follows the rows of a head.
pub(super) struct Rest {
    period: f64,
    /// Rows that were seen.
    rows: usize,
    /// Rows that a blade rests behind its command down, and up; and rows until it is all the way up.
    ticks: [usize; 3],
    /// The row at which the knife was last commanded otherwise, and where the blade was then.
    since: Option<(usize, Point, f64)>,
    is_down: bool,
    /// The first two rows and the last two.
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

    /// Sees the next row.
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

    /// How many ends of a program are not at rest, and where the last one is.
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
