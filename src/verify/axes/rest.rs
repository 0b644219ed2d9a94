//! Checks of rests: start and end of the program, plunges, lifts, events and drilled holes.

use crate::geom::{Point, Vector};
use crate::ir::Finding;
use crate::ir::verdict::{Sighting, Worst};
use crate::machine::MachineProfile;
use crate::verify::program::row::{Rounding, Row};
use crate::verify::reference::lines::Reference;
use crate::verify::reference::order::Seen;
use crate::verify::rules;

/// Fraction of a period that a dwell may seem to lack: rounding of its quotient.
const PERIOD_EPSILON: f64 = 1e-6;
/// Distance beyond which a hole is taken for a different one, mm.
const HOLE_REACH: f64 = 5.0;

/// Check of rests over the rows.
pub(in crate::verify) struct Rest<'a> {
    reference: &'a Reference<'a>,
    period: f64,
    plunge: u64,
    /// Ticks from the lift command until the blade is clear of the cloth; the axes rest meanwhile.
    clear: u64,
    /// Ticks from the lift command until the blade is fully up.
    lift: u64,
    drill: u64,
    offset: Vector,
    park: Option<[f64; 3]>,
    home: [f64; 3],
    /// Greatest difference between two printed numbers of the same value, mm and degrees.
    same: f64,
    before: Option<Row>,
    /// Row at which the axes came to rest, and the tick until which they must rest.
    hold: Option<(Row, u64)>,
    /// Tick from which the blade is fully up.
    up: u64,
    drilled: Vec<(Point, u8, Row)>,
    start: Worst,
    end: Worst,
    still: Worst,
    dwell: Worst,
}

impl<'a> Rest<'a> {
    pub(in crate::verify) fn new(reference: &'a Reference, profile: &MachineProfile, rounding: Rounding) -> Self {
        // Greatest difference between two printed numbers of the same value, mm and degrees.
        let same = 2.0 * rounding.axis();
        let period = profile.time.period();
        let ticks = |time: f64| (time / period - PERIOD_EPSILON).ceil().max(0.0) as u64;
        let [x, y] = profile.drill.offset_mm;
        Self {
            reference,
            period,
            plunge: ticks(profile.knife.plunge()),
            clear: ticks(profile.knife.clear()),
            lift: ticks(profile.knife.lift()),
            drill: ticks(profile.drill.dwell()),
            offset: Vector::new(x, y),
            park: profile.park,
            home: profile.home,
            same,
            before: None,
            hold: None,
            up: 0,
            drilled: Vec::new(),
            start: Worst::new(&rules::START, Some(same)),
            end: Worst::new(&rules::END, Some(same)),
            still: Worst::new(&rules::REST, Some(same)),
            dwell: Worst::new(&rules::DWELL, Some(PERIOD_EPSILON * period)),
        }
    }

    /// Processes a row, with or without a time.
    pub(in crate::verify) fn see(&mut self, row: &Row, is_timed: bool) {
        if !is_timed && self.before.as_ref().is_some_and(|before| before.drill == row.drill) {
            // Without a time only the holes count.
            return;
        }
        let Some(before) = self.before.replace(*row) else {
            self.start.see(distance(row, self.home), || row.sighting());
            if row.knife {
                self.begin(row, self.plunge);
            }
            if row.drill != 0 {
                self.begin(row, self.drill);
                self.drilled.push((row.on_cloth().centre + self.offset, row.drill, *row));
            }
            if row.event != 0 {
                self.begin(row, 1);
            }
            return;
        };
        // The pose at the tick of a command belongs to the rest that follows it.
        if let Some((at, _)) = self.hold.as_ref().filter(|(_, until)| row.tick <= *until) {
            self.still.see(distance(row, [at.centre.x, at.centre.y, at.c_deg]), || row.sighting());
        }
        if row.knife != before.knife {
            self.begin(row, if row.knife { self.plunge } else { self.clear });
            if !row.knife {
                self.up = row.tick + self.lift;
            }
        }
        if row.drill != before.drill {
            let ticks = if row.drill == 0 { 0 } else { self.drill };
            self.begin(row, ticks);
            if row.drill != 0 {
                self.drilled.push((row.on_cloth().centre + self.offset, row.drill, *row));
            }
        }
        if row.event != 0 {
            self.begin(row, 1);
        }
        if row.drill != 0 {
            let last = distance(row, [before.centre.x, before.centre.y, before.c_deg]);
            if before.drill == row.drill {
                self.still.see(last, || row.sighting());
            }
            if row.knife {
                self.still.see(f64::INFINITY, || row.sighting());
            }
        }
    }

    /// Begins a rest of `ticks`; the previous rest must be over, and the blade up.
    fn begin(&mut self, row: &Row, ticks: u64) {
        self.finish(row);
        self.rise(row);
        self.hold = (ticks > 0).then_some((*row, row.tick + ticks));
    }

    /// Checks that the current rest is over at a row.
    fn finish(&mut self, row: &Row) {
        if let Some((_, until)) = self.hold.take() {
            let missing = until.saturating_sub(row.tick) as f64 * self.period;
            self.dwell.see(missing, || row.sighting());
        }
    }

    /// Checks that the blade is fully up at a row.
    fn rise(&mut self, row: &Row) {
        let missing = self.up.saturating_sub(row.tick) as f64 * self.period;
        self.dwell.see(missing, || row.sighting());
    }

    /// Findings; holes of the marker that were drilled are added to `told`.
    pub(in crate::verify) fn findings(mut self, last: Option<&Row>, told: &mut Vec<Seen>) -> Vec<Finding> {
        if let Some(last) = last {
            self.finish(last);
            self.rise(last);
            if last.knife || last.drill != 0 {
                self.end.see(f64::INFINITY, || last.sighting());
            }
            if let Some(park) = self.park {
                self.end.see(distance(last, park), || last.sighting());
            }
        }
        let (drills, place) = self.holes(told);
        vec![self.start.finding(), self.end.finding(), self.still.finding(), self.dwell.finding(), drills, place]
    }

    /// Compares the holes of the program with those of the marker; each hole of the marker takes the nearest free one.
    fn holes(&mut self, told: &mut Vec<Seen>) -> (Finding, Finding) {
        let mut wrong = Worst::new(&rules::DRILLS, Some(0.0));
        let mut place = Worst::new(&rules::DRILL_PLACE, Some(2.0 * self.same));
        let mut left = std::mem::take(&mut self.drilled);
        // Sort by tool and X, so that the holes near a place are adjacent.
        left.sort_by(|a, b| a.1.cmp(&b.1).then(a.0.x.total_cmp(&b.0.x)));
        let mut taken = vec![false; left.len()];
        let mut count = 0.0;
        let drills = self.reference.marker.pieces.iter().flat_map(|p| &p.drills);
        for (drill, &rank) in drills.zip(&self.reference.holes) {
            let first = left.partition_point(|(at, tool, _)| (*tool, at.x) < (drill.tool, drill.at.x - HOLE_REACH));
            let near =
                left[first..].partition_point(|(at, tool, _)| (*tool, at.x) <= (drill.tool, drill.at.x + HOLE_REACH));
            let away = |i: &usize| (left[*i].0 - drill.at).norm();
            let nearest = (first..first + near).filter(|&i| !taken[i]).min_by(|a, b| away(a).total_cmp(&away(b)));
            if let Some(i) = nearest.filter(|i| away(i) < HOLE_REACH) {
                taken[i] = true;
                let row = &left[i].2;
                place.see(away(&i), || row.sighting());
                told.push(Seen { tick: row.tick, rank, place: row.sighting() });
            } else {
                count += 1.0;
                wrong.see(count, || Sighting::missing(drill.at, drill.span.block));
            }
        }
        for (_, (_, _, row)) in taken.iter().zip(&left).filter(|(taken, _)| !**taken) {
            count += 1.0;
            wrong.see(count, || row.sighting());
        }
        (wrong.finding(), place.finding())
    }
}

/// Greatest difference between a row and a pose, mm and degrees.
fn distance(row: &Row, [x, y, c_deg]: [f64; 3]) -> f64 {
    let mm = (row.centre.x - x).abs().max((row.centre.y - y).abs());
    mm.max((row.c_deg - c_deg).abs()) - f64::EPSILON * row.c_deg.abs()
}
