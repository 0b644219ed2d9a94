//! Planning: from the path of the knife to the motion of the axes over time.
//!
//! The input is the toolpath of one contour. The output is a motion whose every setpoint keeps the limits of the axes, with the
//! tip inside the tolerance band of the path. Runs are solved first ([`solve`]), in any order and independently, except for
//! runs that are lifted in the middle of a line (`rejoin`) and for the crossings where cuts meet (`meeting`). A [`Planner`]
//! then joins them in order by turns and rapids between their actual states. For controllers with a planner of their own,
//! [`arcs`] makes untimed arcs and lines from the same toolpath. Planning never changes the line that is cut.

pub mod arcs;
mod certify;
mod meeting;
mod orientation;
mod planner;
mod rapid;
mod rejoin;
mod run;
mod solver;
mod spline;
mod timing;

pub use certify::{Peak, Peaks};
pub use planner::{Planner, home, home_over};
pub use run::Cut;

use crate::diagnostic::Diagnostic;
use crate::ir::toolpath::Toolpath;
use crate::machine::Job;

/// Solves the runs of a toolpath, in order. The error has a diagnostic for each run that cannot be cut.
pub fn solve(toolpath: &Toolpath, job: &Job) -> Result<Vec<Cut>, Vec<Diagnostic>> {
    rejoin::solve(toolpath, job)
}
