//! Input of a planner: moves and steps, in the order of the program.

use crate::back::target::{Limit, Spent};
use crate::geom::Vector;
use crate::machine::gcode::Step;

/// A move of the axes, as written in the program.
#[derive(Debug, Clone, Copy)]
pub(in crate::back::gcode) struct Move {
    /// Signed distances of X, Y (mm) and signed turn of C (rad).
    pub(in crate::back::gcode) ways: [f64; 3],
    /// Length of the path of the C axis over the table, mm.
    pub(in crate::back::gcode) length: f64,
    /// Speed that F asks for.
    pub(in crate::back::gcode) feed: Feed,
    /// Unit vectors along it at its ends; zero when only C moves.
    pub(in crate::back::gcode) along: [Vector; 2],
    /// Curvature, left positive, per mm; 0 = straight.
    pub(in crate::back::gcode) curvature: f64,
}

/// Speed that F asks for, and the limit that it is chosen by.
#[derive(Debug, Clone, Copy)]
pub(in crate::back::gcode) struct Feed {
    /// Speed along the path, mm/s; infinite for rapid moves.
    pub(in crate::back::gcode) speed: f64,
    pub(in crate::back::gcode) limit: Limit,
}

impl Feed {
    /// Speed of a rapid move.
    pub(in crate::back::gcode) const RAPID: Self = Self { speed: f64::INFINITY, limit: Limit::Feed };

    /// The slower of two; the first one of equals.
    pub(in crate::back::gcode) fn or(self, other: Self) -> Self {
        if other.speed < self.speed { other } else { self }
    }
}

/// The planner of a controller, which adds up the time of moves and steps.
pub(in crate::back::gcode) trait Planner {
    /// Adds a move.
    fn go(&mut self, step: &Move);
    /// Adds steps of the controller.
    fn steps(&mut self, steps: &[Step]);
    /// Brings the axes to rest and adds a waiting time, s.
    fn wait(&mut self, time: f64);
    /// F at which an arc of a length, mm, and a curvature, per mm, takes the least time, mm/s. A higher F would slow it down.
    fn best_speed(&self, length: f64, curvature: f64) -> f64;
    /// Brings the axes to rest and returns the time since the start.
    fn finish(&mut self) -> Spent;
}

/// Adds a time to that of a limit, s.
pub(super) fn spend(spent: &mut Vec<(Limit, f64)>, limit: Limit, time: f64) {
    match spent.iter_mut().find(|(known, _)| *known == limit) {
        Some((_, sum)) => *sum += time,
        None => spent.push((limit, time)),
    }
}

/// Limits that cost time, the greatest first.
pub(super) fn sorted(mut spent: Vec<(Limit, f64)>) -> Vec<(Limit, f64)> {
    spent.retain(|(_, time)| *time > 0.0);
    spent.sort_by(|a, b| b.1.total_cmp(&a.1));
    spent
}
