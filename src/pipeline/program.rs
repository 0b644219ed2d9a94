//! Planning and writing: toolpaths become motion, a window of them at a time on all cores, written in order.

use std::io::{self, BufWriter, Write};

use rayon::prelude::*;

use super::spent::Clock;
use super::{Axes, Medium, Program, Sides};
use crate::back::{Context, Parts};
use crate::diagnostic::Diagnostics;
use crate::ir::motion::{Kind, Task};
use crate::ir::toolpath::Side;
use crate::ir::{Motion, Toolpath};
use crate::machine::Job;
use crate::plan::{self, Cut, Planner};
use crate::units::MM_PER_M;

/// Toolpaths that are planned at a time: enough to keep all cores busy, few enough to keep memory small.
const WINDOW: usize = 128;

/// A program that takes the motion as it is planned.
pub(super) struct Sink<'a> {
    /// How its target writes motion.
    pub(super) parts: &'static Parts<Motion>,
    /// Where it goes.
    pub(super) out: &'a mut dyn Medium,
}

/// Plans toolpaths and writes their motion to every sink. Runs that cannot be planned are diagnostics; what was written is
/// then worth nothing.
pub(super) fn write(
    toolpaths: &[Toolpath],
    sinks: &mut [Sink],
    context: &Context,
    diagnostics: &mut Diagnostics,
) -> io::Result<Program> {
    let mut outs: Vec<_> = sinks.iter_mut().map(|sink| (sink.parts, BufWriter::new(&mut *sink.out))).collect();
    let mut tally = Tally::default();
    let mut planner = Planner::new(context.job);
    for (parts, out) in &mut outs {
        (parts.head)(context, out)?;
    }
    for window in toolpaths.chunks(WINDOW) {
        let solved: Vec<_> = window.par_iter().map(|toolpath| plan::solve(toolpath, context.job)).collect();
        for (toolpath, cuts) in window.iter().zip(solved) {
            match cuts {
                Err(refused) => refused.into_iter().for_each(|diagnostic| diagnostics.push(diagnostic)),
                Ok(cuts) => {
                    tally.take(toolpath.piece, &cuts);
                    let motion = planner.join(toolpath, cuts);
                    tally.add(&motion);
                    for (parts, out) in &mut outs {
                        (parts.body)(&motion, context, out)?;
                    }
                }
            }
        }
    }
    let end = planner.finish();
    tally.add(&end);
    for (parts, out) in &mut outs {
        (parts.body)(&end, context, out)?;
        (parts.tail)(context, &[], out)?;
        out.flush()?;
    }
    if let Err(diagnostic) = planner.certify() {
        diagnostics.push(diagnostic);
    }
    Ok(tally.program(&planner, context.job))
}

/// Counts what a program does.
#[derive(Default)]
struct Tally {
    travel: f64,
    plunges: usize,
    stabs: usize,
    lifts: usize,
    ticks: u64,
    bulge: f64,
    sides: Sides,
    /// Where the time goes, in all and piece by piece.
    clock: Clock,
    by_piece: Vec<(u32, Clock)>,
}

impl Sides {
    fn add(&mut self, task: &Task) {
        let ends = |side: Side| task.sides.iter().filter(|&&other| other == side).count();
        self.inside += ends(Side::Part);
        self.shortened += ends(Side::Gap);
        self.turned += usize::from(task.turned);
        self.harmful += usize::from(task.harm > 0.0);
        self.overcut_mm = self.overcut_mm.max(task.harm);
    }
}

impl Tally {
    /// The clock of a piece; what belongs to none has the number 0 and is part of the last.
    fn clock_of(&mut self, piece: u32) -> &mut Clock {
        if self.by_piece.last().is_none_or(|(last, _)| *last != piece && piece > 0) {
            self.by_piece.push((piece, Clock::default()));
        }
        let last = self.by_piece.len() - 1;
        &mut self.by_piece[last].1
    }

    /// Takes what is known of cuts before they are joined to a motion.
    fn take(&mut self, piece: u32, cuts: &[Cut]) {
        for cut in cuts {
            self.bulge = self.bulge.max(cut.bulge);
            self.clock.bind(&cut.shares);
            self.clock_of(piece).bind(&cut.shares);
        }
    }

    fn add(&mut self, motion: &Motion) {
        self.ticks += motion.ticks();
        self.clock.add(motion);
        self.clock_of(motion.piece).add(motion);
        motion.tasks.iter().for_each(|task| self.sides.add(task));
        let mut before = None;
        for phase in &motion.phases {
            match phase.kind {
                Kind::Travel | Kind::Turn => self.travel += phase.length,
                Kind::Plunge => self.plunges += 1,
                Kind::Lift => {
                    self.lifts += 1;
                    self.stabs += usize::from(before == Some(Kind::Plunge));
                }
                Kind::Cut | Kind::Rest | Kind::Wait | Kind::Drill(_) | Kind::Event(_) => {}
            }
            before = Some(phase.kind);
        }
    }

    fn program(&self, planner: &Planner, job: &Job) -> Program {
        let period = job.profile.time.period();
        Program {
            travel_m: Some(self.travel / MM_PER_M),
            runs: Some(self.plunges),
            notch_style: Some(job.profile.notch.style),
            stabs: Some(self.stabs),
            lifts: Some(self.lifts),
            // The last setpoint stands at the last tick, and rows count from tick 0.
            time_s: Some((self.ticks - 1) as f64 * period),
            sides: Some(self.sides),
            spent: Some(self.clock.spent(period)),
            by_piece: self.by_piece.iter().map(|(piece, clock)| (*piece, clock.spent(period))).collect(),
            bulge_mm: Some(self.bulge),
            axes: Some(Axes::new(&planner.peaks())),
        }
    }
}
