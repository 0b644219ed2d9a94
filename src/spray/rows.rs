//! What the controller is given at each tick.

use super::course::{Leg, Role};
use crate::ir::Motion;
use crate::ir::toolpath::Pose;

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

/// The rows of motions; `legs` are those of all passes, whose numbers from 1 the blocks of a cut are. Speeds are the mean of
/// those before and behind a tick, but where `velocities` has those of a pass, tick by tick.
pub(super) fn rows(
    motions: &[Motion],
    legs: &[&Leg],
    velocities: &[Vec<[f64; 2]>],
    sprays: bool,
    period: f64,
) -> Vec<Row> {
    let mut rows = Vec::new();
    let mut known: Vec<(usize, &Vec<[f64; 2]>)> = Vec::new();
    let mut velocities = velocities.iter();
    for phase in motions.iter().flat_map(|motion| &motion.phases) {
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
