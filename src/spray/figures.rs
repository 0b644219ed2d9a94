//! Figures of each edge: the table that studies of this method print.

use serde::Serialize;

use super::course::{Leg, Pass, Role, stretches};
use super::quintic::Fit;
use super::rows::Row;
use crate::geom::{Vector, polyline};
use crate::units::deg;

/// An edge between two corners and its figures.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Edge {
    /// First and last block that draws it.
    pub blocks: [u32; 2],
    /// Length of the head's path, mm.
    pub length_mm: f64,
    /// Duration, s.
    pub time_s: f64,
    /// Maximum deviation of the head from its path, mm.
    pub deviation_mm: f64,
    /// Minimum, mean and maximum speed of the head, mm/s.
    pub speed_mm_s: [f64; 3],
    /// Polynomials of the edge; empty with another planner.
    pub pieces: Vec<Piece>,
}

/// A polynomial of order 5. An edge may consist of several.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Piece {
    /// Start and end in its pass, s.
    pub time_s: [f64; 2],
    /// Maximum deviation from the timed positions of the head, mm.
    pub deviation_mm: f64,
    /// Maximum deviation from the timed directions of the head, degrees.
    pub deviation_deg: f64,
    /// Condition number of the normal matrix.
    pub condition: f64,
    /// Coefficients of X (mm), Y (mm) and C (rad), beginning with the constant term.
    pub coefficients: [[f64; 3]; 6],
}

impl Piece {
    fn of(fit: &Fit) -> Self {
        Self {
            time_s: fit.polynomial.ends,
            deviation_mm: fit.worst[0],
            deviation_deg: deg(fit.worst[1]),
            condition: fit.condition,
            coefficients: fit.polynomial.coefficients,
        }
    }
}

/// A course and the rows that follow it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Followed<'a> {
    /// Passes of the course.
    pub(super) passes: &'a [Pass],
    /// One row per period.
    pub(super) rows: &'a [Row],
    /// The period, s.
    pub(super) period: f64,
}

/// An edge of a course with its rows.
pub(super) struct OnEdge<'a> {
    /// Index of the pass, and of the stretch in it.
    place: [usize; 2],
    /// Legs of the edge.
    pub(super) legs: &'a [Leg],
    /// Rows on these legs.
    pub(super) rows: &'a [Row],
}

/// The edges of a course that have at least one row.
pub(super) fn on_edges(followed: Followed) -> Vec<OnEdge> {
    let Followed { passes, rows, .. } = followed;
    let mut edges = Vec::new();
    let (mut first, mut at) = (0, 0);
    for (i, pass) in passes.iter().enumerate() {
        for (j, stretch) in stretches(pass).into_iter().enumerate() {
            let [start, end] = [stretch.legs.start, stretch.legs.end].map(|leg| first + leg);
            // Rows are in the order of the legs.
            let is_before = |row: &&Row| row.leg.is_none_or(|leg| leg < start);
            let from = at + rows[at..].iter().take_while(is_before).count();
            at = from + rows[from..].iter().take_while(|row| row.leg.is_some_and(|leg| leg < end)).count();
            if stretch.role == Role::Edge && from < at {
                edges.push(OnEdge { place: [i, j], legs: &pass[stretch.legs], rows: &rows[from..at] });
            }
        }
        first += pass.len();
    }
    edges
}

/// The figures of all edges of a course. `fits` holds the fits of each stretch of each pass, or is empty.
pub(super) fn edges(followed: Followed, fits: &[Vec<Vec<Fit>>]) -> Vec<Edge> {
    let figures = |OnEdge { place: [pass, stretch], legs, rows }| {
        let fits = fits.get(pass).map_or(&[][..], |fits| &fits[stretch]);
        Edge { pieces: fits.iter().map(Piece::of).collect(), ..edge(legs, rows, followed.period) }
    };
    on_edges(followed).into_iter().map(figures).collect()
}

/// The figures of one edge, without its polynomials.
fn edge(legs: &[Leg], rows: &[Row], period: f64) -> Edge {
    let speeds = rows.iter().map(|row| row.velocity[0].hypot(row.velocity[1]));
    let (least, sum, most) = speeds.fold((f64::INFINITY, 0.0, 0.0), |(least, sum, most): (f64, f64, f64), speed| {
        (least.min(speed), sum + speed, most.max(speed))
    });
    Edge {
        blocks: [legs[0].block, legs[legs.len() - 1].block],
        length_mm: legs.iter().map(Leg::length).sum(),
        time_s: rows.len() as f64 * period,
        deviation_mm: deviations(legs, rows).into_iter().fold(0.0, |worst, off| f64::max(worst, off.norm())),
        speed_mm_s: [least, sum / rows.len() as f64, most],
        pieces: Vec::new(),
    }
}

/// Vector from the nearest point of the legs to each row, mm. The search for the nearest leg starts at that of the last row.
pub(super) fn deviations(legs: &[Leg], rows: &[Row]) -> Vec<Vector> {
    /// Legs to search on either side of the last nearest one.
    const LOOKED: usize = 200;
    let mut near: usize = 0;
    let mut found = Vec::with_capacity(rows.len());
    for row in rows {
        let place = row.pose.centre;
        let off = |i: usize| {
            let [from, to] = legs[i].ends.map(|node| node.at);
            place - (from + (to - from) * polyline::foot(place, from, to).clamp(0.0, 1.0))
        };
        let looked = near.saturating_sub(LOOKED)..legs.len().min(near + LOOKED);
        near = looked.min_by(|&a, &b| off(a).norm_squared().total_cmp(&off(b).norm_squared())).unwrap_or(near);
        found.push(off(near));
    }
    found
}
