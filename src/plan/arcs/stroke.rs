//! Strokes: the runs of a toolpath, each with the constraints that its neighbours put on its path.

use crate::ir::toolpath::{Run, Toolpath};
use crate::machine::Job;
use crate::plan::meeting;

/// A run in the context of its contour.
pub(super) struct Stroke<'a> {
    pub(super) run: &'a Run,
    /// The run that continues along the end of this one: the next run, or the first run of a ring that is cut in several runs.
    pub(super) next: Option<&'a Run>,
    /// Fraction of the tolerance to use along the overlap at its end.
    pub(super) share: f64,
}

/// The strokes of a toolpath, in order.
pub(super) fn of<'a>(toolpath: &'a Toolpath, job: &Job) -> Vec<Stroke<'a>> {
    let runs: Vec<&Run> = toolpath.runs().collect();
    let near = meeting::near(toolpath, job);
    let next = |k: usize| Some(runs[(k + 1) % runs.len()]).filter(|next| meeting::overlap(runs[k], next).is_some());
    (0..runs.len()).map(|k| Stroke { run: runs[k], next: next(k), share: near[k][1].share }).collect()
}
