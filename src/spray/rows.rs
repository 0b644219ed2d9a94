//! Setpoints of the controller.

use super::course::{Leg, Pass, Role};
use crate::ir::Motion;
use crate::ir::toolpath::Pose;
use crate::machine::Job;

/// The head at a tick.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Row {
    /// Pose of the axes.
    pub pose: Pose,
    /// Speeds of X and Y, mm/s.
    pub velocity: [f64; 2],
    /// True if the jet is on.
    pub jet: bool,
    /// Index of the leg, counted through all passes; `None` between passes.
    pub leg: Option<usize>,
}

/// Data from which the rows are made.
pub(super) struct Moved<'a> {
    /// All motions in order. Blocks of a cut are the numbers of the legs, counted from 1 through all passes.
    pub(super) motions: &'a [Motion],
    /// Passes that the motions follow.
    pub(super) passes: &'a [Pass],
    /// Known speeds of X and Y of each pass at its ticks, mm/s.
    pub(super) velocities: &'a [Vec<[f64; 2]>],
}

/// The rows of motions. Unknown speeds are central differences of the positions.
pub(super) fn rows(moved: &Moved, job: &Job) -> Vec<Row> {
    let (sprays, period) = (job.mode.cuts(), job.profile.time.period());
    let legs: Vec<&Leg> = moved.passes.iter().flatten().collect();
    let mut rows = Vec::new();
    let mut known: Vec<(usize, &Vec<[f64; 2]>)> = Vec::new();
    let mut velocities = moved.velocities.iter();
    for phase in moved.motions.iter().flat_map(|motion| &motion.phases) {
        let cuts = !phase.spells.is_empty() && phase.length > 0.0;
        if cuts {
            known.extend(velocities.next().map(|of_pass| (rows.len(), of_pass)));
        }
        for (pose, block) in phase.setpoints() {
            let leg = (block > 0 && cuts).then(|| block as usize - 1);
            let jet = sprays && leg.is_some_and(|leg| legs[leg].role != Role::Air);
            rows.push(Row { pose, velocity: [0.0; 2], jet, leg });
        }
    }
    for i in 1..rows.len().saturating_sub(1) {
        let way = (rows[i + 1].pose.centre - rows[i - 1].pose.centre) / (2.0 * period);
        rows[i].velocity = [way.x, way.y];
    }
    for (first, of_pass) in known {
        for (row, velocity) in rows[first..].iter_mut().zip(of_pass) {
            row.velocity = *velocity;
        }
    }
    rows
}
