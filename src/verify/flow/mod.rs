//! Verifier of heads over a conveyor: checks from the emitted bytes how the blades cut the cloth, and that the heads keep
//! apart.
//!
//! Input: the plan and the programs of all heads, the marker that they must cut, and the profile. It shares no code with
//! planning and output: required cuts come from the contours and notches of the marker, as in the verifier of cutters; every
//! row is mapped back to the cloth, and strokes are assigned to cuts independently. Nothing is repaired.

mod chain;
mod cover;
mod drawn;
mod follow;
mod going;
mod ground;
mod heading;
mod join;
mod limits;
mod lines;
mod plan_file;
mod rest;
mod rows;
mod rules;
mod strokes;
mod trail;

pub use ground::Ground;
pub use rows::Bytes;
pub use rules::RULES;

use std::io::{self, BufRead};

use rayon::prelude::*;

use self::cover::Covers;
use self::follow::Follower;
use self::limits::Limits;
use self::lines::Lines;
use self::plan_file::Plan;
use self::rest::Rest;
use self::rows::Row;
use self::strokes::{Stroke, Strokes};
use crate::geom::Point;
use crate::ir::verdict::{Sighting, Verdict, WorstByRule};
use crate::units::columns::Unread;
use crate::verify::required;

/// Opens the program of a head, given its index in the plan; called once per head.
pub type Open<'a> = &'a (dyn Fn(usize) -> io::Result<Box<dyn BufRead>> + Sync);

/// Verifies the programs of a plan from their bytes.
pub fn judge(plan: &str, (bytes, open): (Bytes, Open), ground: &Ground) -> io::Result<Verdict> {
    let mut worst = WorstByRule::default();
    let judged = plan_file::read(plan).and_then(|plan| Judge { plan, bytes, open, ground }.all(&mut worst));
    let unread = match judged {
        Ok(()) => None,
        Err(Unread::Io(error)) => return Err(error),
        Err(Unread::Row(message)) => Some(message),
    };
    worst.see_under(&rules::FORMAT, f64::from(u8::from(unread.is_some())), 0.0, None);
    Ok(Verdict { findings: worst.findings(), unread, ..Verdict::default() })
}

/// Plan with the programs of its heads.
struct Judge<'a> {
    plan: Plan,
    bytes: Bytes,
    open: Open<'a>,
    ground: &'a Ground<'a>,
}

/// Result of reading the program of a head.
struct Head {
    strokes: Vec<Stroke>,
    ys: Vec<f64>,
    /// Worst values of its rows by themselves.
    worst: WorstByRule,
    /// Number of program ends that are not at rest, and the place of the last row.
    ends: (usize, Option<Sighting>),
}

impl Judge<'_> {
    fn all(&self, worst: &mut WorstByRule) -> Result<(), Unread> {
        let ground = self.ground;
        plan_file::judge(&self.plan, ground, worst);
        let required = required(ground.marker, ground.profile);
        let lines = Lines::new(&required);
        drawn::judge(&required, &lines, ground, worst);
        let covers = Covers::new(&lines, ground);
        let mut follower = Follower { lines: &lines, ground, speed: self.plan.speed, covers };
        let mut mates = Mates { ground, heads: Vec::new() };
        let mut count = None;
        // Read as many heads at a time as there are threads: the data of a head until it is verified is large.
        let heads: Vec<usize> = (0..self.plan.heads.len()).collect();
        let at_once = heads.chunks(rayon::current_num_threads());
        let read = at_once.flat_map(|some| some.par_iter().map(|&head| self.read(head)).collect::<Vec<_>>());
        for (i, head) in read.enumerate() {
            let head = head?;
            worst.merge(head.worst);
            worst.count(&rules::ENDS, head.ends.0, head.ends.1);
            let rows = head.ys.len();
            if rows == 0 {
                return Err(Unread::Row(format!("head {} has no row", i + 1)));
            }
            if *count.get_or_insert(rows) != rows {
                return Err(Unread::Row(format!("head {} has {rows} rows, others have more or fewer", i + 1)));
            }
            mates.join(self.plan.heads[i].0, head.ys, worst);
            for (number, stroke) in head.strokes.iter().enumerate() {
                follower.judge(number, stroke, worst);
            }
        }
        follower.covers.judge(worst);
        Ok(())
    }

    /// Reads the program of a head and verifies its rows by themselves.
    fn read(&self, head: usize) -> Result<Head, Unread> {
        let profile = self.ground.profile;
        let mut worst = WorstByRule::default();
        let (_, station) = self.plan.heads[head];
        let period = profile.time.period();
        let (mut limits, mut rest) = (Limits::new(profile), Rest::new(profile));
        let mut strokes = Strokes::new(profile);
        let mut ys = Vec::new();
        rows::read(self.bytes, (self.open)(head)?.as_mut(), &mut |row: Row| {
            let number = ys.len();
            let due = number as f64 * period;
            let point = Point::new(station + row.place[0] - row.conveyor, row.place[1]);
            let at = sighting([head, number], row.time, point);
            worst.see_under(&rules::PERIOD, (row.time - due).abs(), ROW_TIME, at);
            worst.see_under(&rules::CONVEYOR, (row.conveyor - self.plan.speed * due).abs(), ROW_WAY, at);
            self.bounds(&row, at, &mut worst);
            limits.see(&row, at, &mut worst);
            rest.see(&row, at, &mut worst);
            strokes.see(&row, at);
            ys.push(row.place[1]);
        })?;
        Ok(Head { strokes: strokes.finish(), ys, worst, ends: rest.finish() })
    }

    /// Checks that the axes are within their ranges.
    fn bounds(&self, row: &Row, at: Sighting, worst: &mut WorstByRule) {
        let profile = self.ground.profile;
        let beyond = |value: f64, [least, most]: [f64; 2]| (least - value).max(value - most);
        worst.see_under(&rules::TRAVEL, beyond(row.place[0], [0.0, profile.flow.travel_mm]), ROW_WAY, at);
        if let Some(range) = profile.table.y_mm {
            worst.see_under(&rules::ACROSS, beyond(row.place[1], range), ROW_WAY, at);
        }
        if let Some(range) = profile.c.range_deg {
            worst.see_under(&rules::C_RANGE, beyond(row.c, range), ROW_WAY, at);
        }
    }
}

/// Sighting on the cloth for a head and a row of its program, both from 0, and its time, s.
fn sighting([head, row]: [usize; 2], time: f64, point: Point) -> Sighting {
    Sighting { head: head as u32 + 1, line: Some(row as u64 + 1), ..Sighting::at(time, point, 0) }
}

/// Rounding of times, s, and of lengths, mm, in rows with six decimals.
const ROW_TIME: f64 = 1e-6;
const ROW_WAY: f64 = 2e-6;

/// Heads that were read so far: row of heads, and position across the feed at each row of the program, mm.
struct Mates<'a> {
    ground: &'a Ground<'a>,
    heads: Vec<(u64, Vec<f64>)>,
}

impl Mates<'_> {
    /// Checks that a head keeps apart from the heads of its row that were read before, and adds it to them.
    fn join(&mut self, row: u64, ys: Vec<f64>, worst: &mut WorstByRule) {
        let width = self.ground.profile.flow.head_width_mm;
        let period = self.ground.profile.time.period();
        for (_, others) in self.heads.iter().filter(|mate| mate.0 == row) {
            let side = (others[0] - ys[0]).signum();
            let gaps = others.iter().zip(&ys).map(|(other, y)| (other - y) * side);
            if let Some((tick, gap)) = gaps.enumerate().min_by(|a, b| a.1.total_cmp(&b.1)) {
                let point = Point::new(0.0, ys[tick]);
                let at = sighting([self.heads.len(), tick], tick as f64 * period, point);
                worst.see_under(&rules::DISTANCE, width - gap, ROW_WAY, at);
            }
        }
        self.heads.push((row, ys));
    }
}
