//! Planning: from what the knife does to when the axes are where.
//!
//! Receives the toolpath of one contour, promises a motion whose every setpoint keeps the limits of the axes, with the
//! tip inside the tolerance band of the path. Runs are solved first, each alone and in any order ([`solve`]); then a
//! [`Planner`] joins them in order by turns and rapids between the states that they really have. For controllers that plan
//! for themselves [`arcs`] makes arcs and lines of the same toolpath, untimed. Never changes what is cut.

pub mod arcs;
mod certify;
mod orientation;
mod planner;
mod rapid;
mod run;
mod solver;
mod spline;
mod timing;

pub use certify::{Peak, Peaks};
pub use planner::{Planner, home};
pub use run::Cut;

use crate::diagnostic::Diagnostic;
use crate::ir::toolpath::{Step, Toolpath};
use crate::machine::Job;

/// The runs of a toolpath as they will be cut, in order; a diagnostic for each that cannot be.
pub fn solve(toolpath: &Toolpath, job: &Job) -> Result<Vec<Cut>, Vec<Diagnostic>> {
    let (mut cuts, mut refused) = (Vec::new(), Vec::new());
    for step in &toolpath.steps {
        match step {
            Step::Run(run) => match run::solve(run, toolpath.tolerance, job) {
                Ok(cut) => cuts.push(cut),
                Err(diagnostic) => refused.push(diagnostic),
            },
            Step::PlungeCut(_) | Step::Turn(_) | Step::Travel(_) | Step::Drill(_) | Step::Event(_) => {}
        }
    }
    if refused.is_empty() { Ok(cuts) } else { Err(refused) }
}
