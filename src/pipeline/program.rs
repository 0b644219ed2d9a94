//! Planning and writing: toolpaths become motion, a window of them at a time on all cores, written in order.

use std::io::{self, BufWriter, Write};

use rayon::prelude::*;

use super::{Axes, Medium, Program};
use crate::back::{Context, Parts};
use crate::diagnostic::Diagnostics;
use crate::ir::motion::Kind;
use crate::ir::{Motion, Toolpath};
use crate::machine::Job;
use crate::plan::{self, Planner};
use crate::units::MM_PER_M;

/// Toolpaths that are planned at a time: enough to keep all cores busy, few enough to keep memory small.
const WINDOW: usize = 128;

/// Plans toolpaths and writes their motion. Runs that cannot be planned are diagnostics; what was written is then worth
/// nothing.
pub(super) fn write(
    toolpaths: &[Toolpath],
    parts: &Parts<Motion>,
    context: &Context,
    out: &mut dyn Medium,
    diagnostics: &mut Diagnostics,
) -> io::Result<Program> {
    let mut out = BufWriter::new(out);
    let mut tally = Tally::default();
    let mut planner = Planner::new(context.job);
    (parts.head)(context, &mut out)?;
    for window in toolpaths.chunks(WINDOW) {
        let solved: Vec<_> = window.par_iter().map(|toolpath| plan::solve(toolpath, context.job)).collect();
        for (toolpath, cuts) in window.iter().zip(solved) {
            match cuts {
                Err(refused) => refused.into_iter().for_each(|diagnostic| diagnostics.push(diagnostic)),
                Ok(cuts) => {
                    tally.bulge = cuts.iter().fold(tally.bulge, |most, cut| most.max(cut.bulge));
                    let motion = planner.join(toolpath, cuts);
                    tally.add(&motion);
                    (parts.body)(&motion, context, &mut out)?;
                }
            }
        }
    }
    let end = planner.finish();
    tally.add(&end);
    (parts.body)(&end, context, &mut out)?;
    (parts.tail)(context, &[], &mut out)?;
    out.flush()?;
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
}

impl Tally {
    fn add(&mut self, motion: &Motion) {
        self.ticks += motion.ticks();
        let mut before = None;
        for phase in &motion.phases {
            match phase.kind {
                Kind::Travel | Kind::Turn => self.travel += phase.length,
                Kind::Plunge => self.plunges += 1,
                Kind::Lift => {
                    self.lifts += 1;
                    self.stabs += usize::from(before == Some(Kind::Plunge));
                }
                Kind::Cut | Kind::Rest | Kind::Drill(_) | Kind::Event(_) => {}
            }
            before = Some(phase.kind);
        }
    }

    fn program(&self, planner: &Planner, job: &Job) -> Program {
        Program {
            travel_m: Some(self.travel / MM_PER_M),
            runs: Some(self.plunges),
            stabs: Some(self.stabs),
            lifts: Some(self.lifts),
            // The last setpoint stands at the last tick, and rows count from tick 0.
            time_s: Some((self.ticks - 1) as f64 * job.profile.time.period()),
            bulge_mm: Some(self.bulge),
            axes: Some(Axes::new(&planner.peaks(), &job.profile.axes.limits())),
        }
    }
}
