//! What the controller is given at each tick.

use super::course::{Leg, Pass, Role};
use crate::ir::Motion;
use crate::ir::toolpath::Pose;
use crate::machine::Job;

/// The head at a tick.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Row {
    /// Where the axes are.
    pub pose: Pose,
    /// Speeds of X and Y, mm/s.
    pub velocity: [f64; 2],
    /// Whether the jet is on.
    pub jet: bool,
    /// The leg of the course, counted through all passes; `None` between them.
    pub leg: Option<usize>,
}

/// What the rows are made of.
pub(super) struct Moved<'a> {
    /// All of it, in order; the blocks of a cut are numbers of legs, the first being 1, counted through all passes.
    pub(super) motions: &'a [Motion],
    /// What they follow.
    pub(super) passes: &'a [Pass],
    /// Speeds of X and Y of each pass at its ticks, mm/s, where they are known.
    pub(super) velocities: &'a [Vec<[f64; 2]>],
}

/// The rows of motions. Speeds that are not known are the mean of those before and behind a tick.
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
