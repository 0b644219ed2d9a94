//! Strokes: the runs of a toolpath, each with what the runs beside it ask of its path.

use crate::ir::toolpath::{Run, Toolpath};
use crate::machine::Job;
use crate::plan::meeting;

/// A run among the others of its contour.
pub(super) struct Stroke<'a> {
    pub(super) run: &'a Run,
    /// The run that goes on along its end: the next one, or the first one of a ring that is cut in several runs.
    pub(super) next: Option<&'a Run>,
    /// The part of the tolerance that is used along the overlap at its end.
    pub(super) share: f64,
}

/// The strokes of a toolpath, in order.
pub(super) fn of<'a>(toolpath: &'a Toolpath, job: &Job) -> Vec<Stroke<'a>> {
    let runs: Vec<&Run> = toolpath.runs().collect();
    let near = meeting::near(toolpath, job);
    let next = |k: usize| Some(runs[(k + 1) % runs.len()]).filter(|next| meeting::overlap(runs[k], next).is_some());
    (0..runs.len()).map(|k| Stroke { run: runs[k], next: next(k), share: near[k][1].share }).collect()
}
