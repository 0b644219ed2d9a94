//! Planners of controllers: the time that a program takes there, and what limits it.
//!
//! `gcode.planner` chooses the planner. A planner is given the moves of the program and the steps between them, in order; it
//! simulates how the controller carries them out.

mod axes;
mod blocks;
mod buffer;
mod grbl;
mod linuxcnc;
mod planner;
mod queue;
mod reprap;

pub(super) use self::planner::{Feed, Move, Planner};
use crate::machine::Job;
use crate::machine::gcode;

/// The planner of the controller of a job, before the first move.
pub(super) fn planner(job: &Job) -> Box<dyn Planner> {
    match job.profile.gcode.planner {
        gcode::Planner::Linuxcnc => Box::new(linuxcnc::Pace::new(job)),
        gcode::Planner::Grbl => Box::new(grbl::Pace::new(job)),
        gcode::Planner::Reprap => Box::new(reprap::Pace::new(job)),
    }
}
