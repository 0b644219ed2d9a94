//! The figures of each edge: the table that studies of this method print.

use serde::Serialize;

use super::course::{Leg, Pass, Role, stretches};
use super::quintic::Fit;
use super::rows::Row;
use crate::geom::{Vector, polyline};
use crate::units::deg;

/// An edge between two corners, and how the head follows it.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Edge {
    /// The first and the last block that draws it.
    pub blocks: [u32; 2],
    /// Way of the head, mm.
    pub length_mm: f64,
    /// How long it takes, s.
    pub time_s: f64,
    /// How far the head is from its line at the most, mm.
    pub deviation_mm: f64,
    /// Least, mean and greatest speed of the head, mm/s.
    pub speed_mm_s: [f64; 3],
    /// Polynomials; none with another planner.
    pub pieces: Vec<Piece>,
}

/// A polynomial of order 5, or several that follow each other.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Piece {
    /// From when to when in its pass, s.
    pub time_s: [f64; 2],
    /// How far it is from the places of the head at their times, mm and degrees.
    pub deviation_mm: f64,
    /// The same of its direction.
    pub deviation_deg: f64,
    /// Condition of the normal matrix.
    pub condition: f64,
    /// Coefficients of X (mm), Y (mm) and C (rad), from the constant term on.
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
    /// The course.
    pub(super) passes: &'a [Pass],
    /// A row a period.
    pub(super) rows: &'a [Row],
    /// The period, s.
    pub(super) period: f64,
}

/// An edge of a course.
pub(super) struct OnEdge<'a> {
    /// Its pass, and which of the stretches of that it is.
    place: [usize; 2],
    /// Its legs.
    pub(super) legs: &'a [Leg],
    /// The rows on them.
    pub(super) rows: &'a [Row],
}

/// The edges of a course on which a row falls.
pub(super) fn on_edges(followed: Followed) -> Vec<OnEdge> {
    let Followed { passes, rows, .. } = followed;
    let mut edges = Vec::new();
    let (mut first, mut at) = (0, 0);
    for (i, pass) in passes.iter().enumerate() {
        for (j, stretch) in stretches(pass).into_iter().enumerate() {
            let [start, end] = [stretch.legs.start, stretch.legs.end].map(|leg| first + leg);
            // Rows come in the order of legs.
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

/// The figures of all edges of a course; `fits` has those of each stretch of each pass, or nothing.
pub(super) fn edges(followed: Followed, fits: &[Vec<Vec<Fit>>]) -> Vec<Edge> {
    let figures = |OnEdge { place: [pass, stretch], legs, rows }| {
        let fits = fits.get(pass).map_or(&[][..], |fits| &fits[stretch]);
        Edge { pieces: fits.iter().map(Piece::of).collect(), ..edge(legs, rows, followed.period) }
    };
    on_edges(followed).into_iter().map(figures).collect()
}

/// One edge: its legs and the rows on them.
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

/// How far each row is from the line of legs, mm. Both go on: the nearest leg is looked for from the last one on.
pub(super) fn deviations(legs: &[Leg], rows: &[Row]) -> Vec<Vector> {
    /// Legs that are looked at, to both sides of the last nearest.
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
