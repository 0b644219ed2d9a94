//! Verification: the emitted bytes are read back and judged against the marker and the profile.
//!
//! Receives bytes, the final marker and the profile; promises a verdict with the worst value of every rule, whether it
//! holds or not. A checker must not share the fault that it looks for, so nothing here comes from the reader, the passes,
//! the planner or the emitters: the rows are read, the corners found, the tube laid and the blade simulated anew.
//!
//! The way: `read` gives rows; `limits` and `rest` watch the axes; the rows between a plunge and a lift are a
//! `stroke`, which is followed along the lines of the `reference` and marks what it cut in `coverage`.

mod body;
mod caps;
mod chord;
mod counts;
mod coverage;
mod covered;
mod crawl;
mod cutter_file;
mod events;
mod follow;
mod gcode;
mod grid;
mod hal;
mod heading;
mod inside;
mod joints;
mod kept;
mod limits;
mod line;
mod naming;
mod nibbles;
mod notches;
mod npy;
mod order;
mod outline;
mod overcut;
mod parts;
mod passing;
mod read;
mod reference;
mod rest;
mod rules;
mod scan;
mod source_audit;
mod source_hpgl;
mod spelling;
mod stroke;
mod strokes;
mod table;
mod trial;
mod winding;
mod words;
mod worst;
mod worsts;

pub use cutter_file::cutter_file;
pub use kept::Works;
pub use rules::{RULES, Rule};
pub use source_audit::{Census, source_audit};

use std::io::BufRead;

use rayon::prelude::*;

use self::coverage::Coverage;
use self::events::Events;
use self::gcode::Places;
use self::grid::Grid;
use self::inside::Inside;
use self::limits::Limits;
use self::naming::Naming;
use self::order::{Order, Seen};
use self::read::{Going, Rounding, Row, Rows};
use self::reference::Reference;
use self::rest::Rest;
use self::stroke::{Judge, Traced};
use self::strokes::Strokes;
use self::table::Table;
use self::worst::Worst;
use self::worsts::Worsts;
use crate::ir::{Finding, Marker, finding};
use crate::machine::{Job, MachineProfile};

/// Rows of strokes that are judged at a time: enough to keep all cores busy, few enough to keep memory small.
const ROWS_AT_A_TIME: usize = 4096;
/// Room for them: the last stroke is taken whole.
const ROOM: usize = ROWS_AT_A_TIME + ROWS_AT_A_TIME / 8;
/// Rows of strokes that are judged one after the other: what was worst in one stroke spares work on the next ones.
const ROWS_IN_A_ROW: usize = 512;

/// What a program is worth.
#[derive(Debug, Clone, PartialEq)]
pub struct Verdict {
    /// The worst value under each rule, in the order of [`RULES`].
    pub findings: Vec<Finding>,
    /// What cannot be read, when something cannot: then nothing is said about what the program does, since all that
    /// follows from a row that is missing would be wrong.
    pub unread: Option<String>,
    /// Rules that say nothing about this program, because it tells no times.
    pub untimed: Vec<&'static str>,
}

impl Verdict {
    /// Whether every rule holds.
    pub fn passes(&self) -> bool {
        self.findings.iter().all(Finding::holds)
    }

    /// How many rules have a limit, and how many only report.
    pub fn counts(&self) -> (usize, usize) {
        finding::counts(&self.findings)
    }

    /// The findings that do not hold.
    pub fn broken(&self) -> impl Iterator<Item = &Finding> {
        self.findings.iter().filter(|finding| !finding.holds())
    }
}

/// What bytes are meant as, by how they begin.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// Timed setpoints, which [`setpoints`] judges.
    Setpoints,
    /// Positions without time, which [`positions`] judges.
    Positions,
    /// A cut file that was written from a marker, which [`cutter_file()`] judges.
    CutterFile,
}

/// What kind of program bytes are, be it damaged; `None` when they are none.
pub fn kind(bytes: &mut dyn BufRead) -> Option<Kind> {
    if read::begins(bytes) || npy::begins(bytes) || counts::begins(bytes) || hal::begins(bytes) {
        return Some(Kind::Setpoints);
    }
    let bytes = bytes.fill_buf().unwrap_or_default();
    if gcode::begins(bytes) {
        return Some(Kind::Positions);
    }
    cutter_file::begins(bytes).then_some(Kind::CutterFile)
}

/// Why bytes do not begin as a program that can be judged does, and what to do about it; `None` when they do.
pub fn foreign(bytes: &mut dyn BufRead) -> std::io::Result<Option<[String; 2]>> {
    if kind(bytes).is_some() {
        return Ok(None);
    }
    let bytes = bytes.fill_buf()?;
    Ok(gcode::foreign(bytes).or_else(|| read::foreign(bytes)))
}

/// What was cut so far, as the strokes tell it.
struct Done<'a> {
    coverage: Coverage<'a>,
    order: Order<'a>,
    worsts: Worsts,
}

impl Done<'_> {
    /// Judges strokes, in their order: on all cores, but for what depends on the strokes before.
    fn see(&mut self, mut traced: Vec<Traced>, judge: &Judge) {
        for stroke in &mut traced {
            judge.settle(stroke, self);
        }
        let known = &self.worsts;
        let check = |strokes: &[Traced]| {
            // What is no worse than anything so far need not be known.
            let mut worsts = known.clone();
            for stroke in strokes {
                judge.check(stroke, &mut worsts);
            }
            worsts
        };
        let worsts: Vec<Worsts> = in_a_row(&traced).into_par_iter().map(check).collect();
        for later in worsts {
            self.worsts.add(later);
        }
    }
}

/// Parts strokes, in their order, into those that are judged one after the other, whatever the number of cores.
fn in_a_row(mut traced: &[Traced]) -> Vec<&[Traced]> {
    let mut parts = Vec::new();
    while !traced.is_empty() {
        let mut rows = 0;
        let is_full = |stroke: &Traced| {
            rows += stroke.rows();
            rows >= ROWS_IN_A_ROW
        };
        let end = traced.iter().position(is_full).map_or(traced.len(), |last| last + 1);
        let part;
        (part, traced) = traced.split_at(end);
        parts.push(part);
    }
    parts
}

/// What watches rows as they come, whatever is cut.
struct Watch<'a> {
    limits: Limits,
    rest: Rest<'a>,
    table: Table,
    events: Events,
    /// Events and holes, as they are told.
    told: Vec<Seen>,
    block: Worst,
    yaw_deg: f64,
    last: Option<Row>,
}

impl Watch<'_> {
    /// Sees rows until enough of them belong to strokes, or none comes any more, and gathers these. Each row may come with
    /// how the axes go there.
    fn gather(&mut self, next: &mut impl FnMut() -> Option<(Row, Option<Going>)>) -> Strokes {
        let mut strokes = Strokes::with_room(ROOM);
        while strokes.rows() < ROWS_AT_A_TIME || strokes.are_open() {
            let Some((row, going)) = next() else { break };
            self.limits.see(&row);
            if going.is_none() {
                self.limits.see_timed(&row);
            }
            self.rest.see(&row);
            // The axis stands askew to the blade by the yaw: what is cut is judged by the blade.
            let blade = Row { c_deg: row.c_deg - self.yaw_deg, ..row };
            self.table.see(&blade);
            self.block.see(Naming::in_air(&row), || row.sighting());
            self.events.see(&row, &mut self.told);
            if row.knife || strokes.are_open() {
                // The row of the lift command still holds the pose at the end of the cut.
                strokes.push(&blade, going);
            }
            if !row.knife && strokes.are_open() {
                strokes.end();
            }
            self.last = Some(row);
        }
        if strokes.are_open() {
            strokes.end();
        }
        strokes
    }

    fn findings(mut self, done: &mut Done) -> Vec<Finding> {
        done.worsts.block.add(&self.block);
        let mut findings = self.limits.findings(self.last.as_ref());
        findings.extend(self.rest.findings(self.last.as_ref(), &mut self.told));
        findings.extend([self.table.finding(), self.events.finding()]);
        done.order.add(self.told);
        findings
    }
}

/// What must be cut of a marker, and what lies where on the cloth: what programs are judged by.
#[derive(Debug)]
pub struct Ground<'a> {
    reference: Reference<'a>,
    /// The chords of all lines.
    grid: Grid,
    /// The parts.
    inside: Inside<'a>,
}

impl<'a> Ground<'a> {
    /// The ground of a marker.
    pub fn new(marker: &'a Marker, profile: &MachineProfile) -> Self {
        let reference = Reference::new(marker, profile);
        let (grid, inside) = rayon::join(|| Grid::new(&reference), || Inside::new(marker));
        Self { reference, grid, inside }
    }
}

/// Judges timed setpoints, as the targets `csv`, `npy`, `counts` and `hal` write them, against what must be cut.
pub fn setpoints(program: &mut dyn BufRead, ground: &Ground, job: &Job) -> Verdict {
    let mut rows = Rows::new(program, &job.profile);
    let rounding = rows.rounding();
    let judge = Judge::new(ground, &job.profile, rounding);
    let mut findings = simulate(|| Some((rows.next()?, None)), (&ground.reference, judge, rounding), job);
    let is_broken = rows.is_broken();
    let (format, unread) = rows.findings();
    if is_broken {
        return Verdict { findings: vec![format], unread, untimed: Vec::new() };
    }
    findings.push(format);
    findings.retain(|finding| !gcode::OF_FEED.contains(&finding.rule));
    sort(&mut findings);
    Verdict { findings, unread: None, untimed: Vec::new() }
}

/// Judges positions without time, as the target `gcode` writes them, against what must be cut.
pub fn positions(program: &mut dyn BufRead, ground: &Ground, job: &Job) -> Verdict {
    let mut places = Places::new(program, &job.profile);
    let rounding = Places::rounding(&job.profile);
    let judge = Judge::new(ground, &job.profile, rounding).with_exact_directions(&job.profile);
    let next = || places.next().map(|(row, going)| (row, Some(going)));
    let mut findings = simulate(next, (&ground.reference, judge, rounding), job);
    let is_broken = places.is_broken();
    let ([format, dwell], unread) = places.findings();
    if is_broken {
        return Verdict { findings: vec![gcode::timeless(&format)], unread, untimed: Vec::new() };
    }
    // Of rests the program tells how long they are.
    findings.retain(|finding| finding.rule != dwell.rule);
    findings.extend([format, dwell]);
    let untimed = |finding: &Finding| !gcode::RULES.contains(&finding.rule);
    let (left, judged): (Vec<Finding>, Vec<Finding>) = findings.into_iter().partition(untimed);
    let mut findings: Vec<Finding> = judged.iter().map(gcode::timeless).collect();
    sort(&mut findings);
    Verdict { findings, unread: None, untimed: left.iter().map(|finding| finding.rule).collect() }
}

/// Follows the rows of a program, each with how the axes go there where that is told.
fn simulate(
    mut next: impl FnMut() -> Option<(Row, Option<Going>)>,
    (reference, judge, rounding): (&Reference, Judge, Rounding),
    job: &Job,
) -> Vec<Finding> {
    let profile = &job.profile;
    let mut watch = Watch {
        limits: Limits::new(profile, rounding),
        rest: Rest::new(reference, profile, rounding),
        table: Table::new(profile, rounding),
        events: Events::new(reference),
        told: Vec::new(),
        block: judge.worsts().block,
        yaw_deg: profile.knife.yaw_deg,
        last: None,
    };
    let order = Order::new(&reference.lines);
    let mut done = Done { coverage: Coverage::new(reference), order, worsts: judge.worsts() };
    // What is read, what is followed and what is judged are at work beside each other, each on strokes of its own.
    let (mut read, mut traced) = (watch.gather(&mut next), Vec::new());
    // Who makes room for rows gives it back: only then it is at hand for the next ones.
    let mut given_back = Strokes::default();
    while read.rows() > 0 || !traced.is_empty() {
        let (strokes, followed) = (std::mem::take(&mut read), std::mem::take(&mut traced));
        rayon::in_place_scope(|scope| {
            scope.spawn(|_| done.see(followed, &judge));
            scope.spawn(|_| traced = strokes.all().into_par_iter().map(|stroke| judge.trace(stroke)).collect());
            read = watch.gather(&mut next);
        });
        given_back = strokes;
    }
    drop(given_back);
    let mut findings = watch.findings(&mut done);
    findings.extend(done.worsts.findings());
    findings.extend(done.coverage.findings(profile));
    findings.push(done.order.finding(profile.time.period()));
    findings
}

/// Brings findings into the order of [`RULES`].
pub fn sort(findings: &mut [Finding]) {
    let place = |finding: &Finding| RULES.iter().position(|rule| rule.name == finding.rule);
    findings.sort_by_key(|finding| place(finding).expect("every rule stands in the table"));
}
