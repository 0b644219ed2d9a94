//! A program: what the controller is given at each tick, and what is known of it.

use super::course::Pass;
use super::figures::Edge;
use super::rows::Row;
use crate::geom::Point;

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
    /// The same by the other planner, to show it beside.
    pub(super) beside: Option<Box<Program>>,
}

impl Program {
    /// How long it takes, s.
    pub fn duration(&self) -> f64 {
        (self.rows.len() - 1) as f64 * self.period
    }
}
