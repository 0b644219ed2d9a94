//! Program of a head: the setpoints of the controller and the figures of the edges.

use super::course::Pass;
use super::figures::Edge;
use super::rows::Row;
use crate::geom::Point;

/// The program of a head at a distance.
#[derive(Debug)]
pub struct Program {
    /// Edges of the parts, closed, mm.
    pub edges: Vec<Vec<Point>>,
    /// Passes of the course.
    pub(super) passes: Vec<Pass>,
    /// One row per period.
    pub rows: Vec<Row>,
    /// The period, s.
    pub period: f64,
    /// Figures of each edge, in order.
    pub figures: Vec<Edge>,
    /// Distance from the head to the edge, mm.
    pub distance: f64,
    /// Program by the other planner, for comparison.
    pub(super) beside: Option<Box<Program>>,
}

impl Program {
    /// Duration, s.
    pub fn duration(&self) -> f64 {
        (self.rows.len() - 1) as f64 * self.period
    }
}
