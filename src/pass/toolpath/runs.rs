//! Access to the runs of a toolpath: most passes edit only these.

use crate::ir::toolpath::{Run, Step, Toolpath};

/// Iterates over the runs, in order.
pub(super) fn each(toolpath: &mut Toolpath) -> impl Iterator<Item = &mut Run> {
    toolpath.steps.iter_mut().filter_map(|step| match step {
        Step::Run(run) => Some(run),
        Step::PlungeCut(_) | Step::Turn(_) | Step::Travel(_) | Step::Drill(_) | Step::Event(_) => None,
    })
}

/// Replaces each run by its `parts`.
pub(super) fn replace(toolpath: &mut Toolpath, mut parts: impl FnMut(Run) -> Vec<Run>) {
    let steps = std::mem::take(&mut toolpath.steps);
    toolpath.steps.reserve(steps.len());
    for step in steps {
        match step {
            Step::Run(run) => toolpath.steps.extend(parts(run).into_iter().map(Step::Run)),
            Step::PlungeCut(_) | Step::Turn(_) | Step::Travel(_) | Step::Drill(_) | Step::Event(_) => {
                toolpath.steps.push(step);
            }
        }
    }
}
