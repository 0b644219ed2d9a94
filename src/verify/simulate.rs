//! Simulation of a program from its first row to its last: the axes are watched, strokes are traced and judged.

use rayon::prelude::*;

use super::axes::events::Events;
use super::axes::limits::Limits;
use super::axes::rest::Rest;
use super::axes::table::Table;
use super::cut::borders::Borders;
use super::cut::coverage::{self, Coverage};
use super::cut::done::Done;
use super::cut::meetings::Meetings;
use super::cut::naming::Naming;
use super::cut::stroke::{Judge, Traced};
use super::cut::strokes::Strokes;
use super::cut::worsts::Worsts;
use super::program::row::{Going, Row};
use super::reference::order::{Order, Seen};
use crate::ir::Finding;
use crate::ir::verdict::Worst;
use crate::machine::Job;

/// Rows of strokes that are judged at a time: enough to keep all cores busy, few enough to keep memory small.
const ROWS_AT_A_TIME: usize = 4096;
/// Capacity for them: the last stroke is taken whole.
const ROOM: usize = ROWS_AT_A_TIME + ROWS_AT_A_TIME / 8;
/// Rows of strokes that are judged in sequence: the worst values of one stroke save work on the next ones.
const ROWS_IN_A_ROW: usize = 512;

/// Checks of rows that do not depend on the cuts.
struct Watch<'a> {
    limits: Limits,
    rest: Rest<'a>,
    table: Table,
    events: Events,
    /// Events and holes of the program, in its order.
    told: Vec<Seen>,
    block: Worst,
    yaw_deg: f64,
    last: Option<Row>,
}

impl Watch<'_> {
    /// Sees rows until enough of them belong to strokes, or there are none left, and gathers the strokes. Each row may come
    /// with the velocity of the axes.
    fn gather(&mut self, next: &mut impl FnMut() -> Option<(Row, Option<Going>)>) -> Strokes {
        let mut strokes = Strokes::with_room(ROOM);
        while strokes.rows() < ROWS_AT_A_TIME || strokes.are_open() {
            let Some((row, going)) = next() else { break };
            self.limits.see(&row);
            if going.is_none() {
                self.limits.see_timed(&row);
            }
            self.rest.see(&row, going.is_none());
            // The axis is off the blade by the yaw: cuts are judged by the blade.
            let mut blade = row;
            blade.c_deg -= self.yaw_deg;
            self.table.see(&blade);
            self.block.see(Naming::in_air(&row), || row.sighting());
            self.events.see(&row, &mut self.told);
            if row.knife || strokes.are_open() {
                // The row of the lift command still holds the pose at the end of the cut.
                strokes.push(blade.on_cloth(), going);
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

impl Done<'_> {
    /// Judges strokes, in order: on all cores, except for checks that depend on earlier strokes.
    fn see(&mut self, mut traced: Vec<Traced>, judge: &Judge) {
        for stroke in &mut traced {
            judge.settle(stroke, self);
        }
        let so_far = self.worsts.without_lists();
        let check = |strokes: &[Traced]| {
            // Each chunk starts with the worst values so far: smaller ones are not recorded again.
            let mut worsts = so_far.clone();
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

/// Splits strokes, in order, into groups that are judged in sequence, independently of the number of cores.
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

/// Simulates the rows of a program, each with the velocity of the axes if that is known. Returns the findings, and the pieces
/// of which nothing is cut.
pub(super) fn simulate(
    mut next: impl FnMut() -> Option<(Row, Option<Going>)>,
    judge: &Judge,
    job: &Job,
) -> (Vec<Finding>, Vec<u32>) {
    let (profile, reference, rounding) = (&job.profile, judge.reference, judge.rows_rounding);
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
    let limit = coverage::limit(profile);
    let joints = &judge.common.joints;
    let mut meetings = Meetings::new(reference, joints, profile.knife.overlaps(), limit);
    meetings.borders = Borders::new(joints, reference, profile.bite.match_mm);
    let mut done = Done { coverage: Coverage::new(reference), meetings, order, worsts: judge.worsts() };
    // Reading, tracing and judging run in parallel, each on other strokes.
    let (mut read, mut traced) = (watch.gather(&mut next), Vec::new());
    // The thread that allocates rows frees them: only then the allocator reuses their memory for the next ones.
    let mut given_back = Strokes::default();
    while read.rows() > 0 || !traced.is_empty() {
        let (strokes, followed) = (std::mem::take(&mut read), std::mem::take(&mut traced));
        rayon::in_place_scope(|scope| {
            scope.spawn(|_| done.see(followed, judge));
            scope.spawn(|_| traced = strokes.all().into_par_iter().map(|stroke| judge.trace(stroke)).collect());
            read = watch.gather(&mut next);
        });
        given_back = strokes;
    }
    drop(given_back);
    done.worsts.settle(&done.coverage, judge.allowed());
    if let Some(account) = &judge.account {
        account.settle(reference, &mut done.worsts.declared);
    }
    let mut findings = watch.findings(&mut done);
    findings.extend(done.worsts.findings());
    let uncut = done.coverage.uncut();
    findings.push(done.coverage.finding(judge.common, profile));
    findings.push(done.meetings.finding());
    findings.push(judge.common.finding());
    findings.extend(done.order.findings(judge.held, profile.time.period()));
    (findings, uncut)
}
