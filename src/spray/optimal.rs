//! The default planner: the cutter's, with the speed of the head as its feed, lowered where the jet is too fast.

use super::course::Pass;
use super::slower;
use crate::diagnostic::Diagnostic;
use crate::ir::toolpath::{Step, Toolpath};
use crate::machine::Job;
use crate::plan::{self, Cut};

/// Maximum number of rounds that lower the feed. The verifier judges any excess that remains.
const ROUNDS: usize = 6;

/// The cuts of all passes.
pub(super) fn solve(toolpath: &mut Toolpath, passes: &[Pass], job: &Job) -> Result<Vec<Cut>, Vec<Diagnostic>> {
    let mut cuts = plan::solve(toolpath, job)?;
    for _ in 0..ROUNDS {
        let runs = toolpath.steps.iter_mut().filter_map(|step| match step {
            Step::Run(run) => Some(run),
            Step::PlungeCut(_) | Step::Turn(_) | Step::Travel(_) | Step::Drill(_) | Step::Event(_) => None,
        });
        let mut is_lowered = false;
        for ((run, cut), pass) in runs.zip(&cuts).zip(passes) {
            if let Some(shares) = slower::shares(cut, pass, job) {
                run.feeds.iter_mut().zip(&shares).for_each(|(feed, share)| *feed *= share);
                is_lowered = true;
            }
        }
        if !is_lowered {
            break;
        }
        cuts = plan::solve(toolpath, job)?;
    }
    Ok(cuts)
}
