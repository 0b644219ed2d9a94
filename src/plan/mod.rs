//! Planning: from what the knife does to when the axes are where.
//!
//! Receives the toolpath of one contour, promises a motion whose every setpoint keeps the limits of the axes, with the
//! tip inside the tolerance band of the path. Runs are solved first, in any order ([`solve`]), each alone but for those that
//! are lifted amid a line (`rejoin`), and so that their cuts cross where they meet (`meeting`); then a [`Planner`] joins them
//! in order by turns and rapids between the states that they really have. For controllers that plan for themselves [`arcs`]
//! makes arcs and lines of the same toolpath, untimed. Never changes what is cut.

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

/// The runs of a toolpath as they will be cut, in order; a diagnostic for each that cannot be.
pub fn solve(toolpath: &Toolpath, job: &Job) -> Result<Vec<Cut>, Vec<Diagnostic>> {
    rejoin::solve(toolpath, job)
}
