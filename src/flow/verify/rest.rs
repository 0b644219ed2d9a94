//! Whether blades go down and come up at rest in the cloth, are all the way down and up before they are sent back, and
//! programs begin and end at rest.

use super::rows::Row;
use super::rules::Rule;
use super::worst::{Place, Worst};
use crate::geom::Point;
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
    /// Rows that a blade rests behind its command down, and up; and rows until it is all the way up.
    ticks: [usize; 3],
    /// The row at which the knife was last commanded otherwise, and where the blade was then.
    since: Option<(usize, Point, f64)>,
    is_down: bool,
    /// The first two rows and the last two.
    ends: [Vec<(Row, Place)>; 2],
}

impl Rest {
    pub(super) fn new(profile: &MachineProfile) -> Self {
        let period = profile.time.period();
        let knife = &profile.knife;
        let ticks = [knife.plunge_ms, knife.clear_ms.unwrap_or(knife.lift_ms), knife.lift_ms]
            .map(|ms| (ms / profile.time.period_ms - TIME).ceil() as usize);
        Self { period, ticks, since: None, is_down: false, ends: [Vec::new(), Vec::new()] }
    }

    /// Sees the next row.
    pub(super) fn see(&mut self, row: &Row, at: Place, worst: &mut Worst) {
        if row.knife != self.is_down {
            if let Some((since, _, _)) = self.since {
                let (rule, ticks) = if row.knife { (Rule::Up, self.ticks[2]) } else { (Rule::Dwell, self.ticks[0]) };
                let lacking = (ticks as f64 - (at.row - since) as f64) * self.period;
                worst.see(rule, lacking, TIME, Some(at));
            }
            self.is_down = row.knife;
            self.since = Some((at.row, at.point, row.c));
        }
        if let Some((since, point, c)) = self.since {
            let ticks = if self.is_down { self.ticks[0] } else { self.ticks[1] };
            if at.row <= since + ticks {
                let turned = (row.c - c).abs() / STILL_DEG * STILL;
                worst.see(Rule::Rest, (at.point - point).norm().max(turned), STILL, Some(at));
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
    pub(super) fn finish(self, head: usize) -> (usize, Option<Place>) {
        let rests = |rows: &[(Row, Place)]| match rows {
            [(a, from), (b, to)] => {
                let along = (a.place[0] - b.place[0]).abs();
                let moved = along.max((from.point.y - to.point.y).abs()).max((a.c - b.c).abs());
                moved <= STILL && !a.knife && !b.knife
            }
            _ => false,
        };
        let wrong = self.ends.iter().filter(|rows| !rests(rows)).count();
        (wrong, self.ends[1].last().map(|end| Place { head, ..end.1 }))
    }
}
