//! A program: what the controller is given at each tick, and what is known of it.

use super::course::{Leg, Pass, Role};
use super::figures::Edge;
use crate::geom::Point;
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

/// The program of a head at a distance.
#[derive(Debug)]
pub struct Program {
    /// The edges of the parts, closed, mm.
    pub edges: Vec<Vec<Point>>,
    /// The course.
    pub(super) passes: Vec<Pass>,
    /// A row a period.
    pub rows: Vec<Row>,
    /// The period, s.
    pub period: f64,
    /// Figures of each edge, in order.
    pub figures: Vec<Edge>,
    /// Head to edge, mm.
    pub distance: f64,
}

impl Program {
    /// How long it takes, s.
    pub fn duration(&self) -> f64 {
        (self.rows.len() - 1) as f64 * self.period
    }
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
