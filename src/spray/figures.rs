//! The figures of each edge: the table that studies of this method print.

use serde::Serialize;

use super::course::{Leg, Pass, Role, stretches};
use super::quintic::Fit;
use super::rows::Row;
use crate::geom::polyline;
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

/// The figures of all edges; `fits` has those of each stretch of each pass, or nothing.
pub(super) fn edges(passes: &[Pass], rows: &[Row], fits: &[Vec<Vec<Fit>>], period: f64) -> Vec<Edge> {
    let mut edges = Vec::new();
    let (mut first, mut at) = (0, 0);
    for (i, pass) in passes.iter().enumerate() {
        for (j, stretch) in stretches(pass).into_iter().enumerate() {
            let last = first + stretch.legs.end;
            // Rows come in the order of legs.
            let from = at
                + rows[at..]
                    .iter()
                    .take_while(|row| row.leg.is_none_or(|leg| leg < first + stretch.legs.start))
                    .count();
            let count = rows[from..].iter().take_while(|row| row.leg.is_some_and(|leg| leg < last)).count();
            at = from + count;
            if stretch.role == Role::Edge {
                let fits = fits.get(i).map_or(&[][..], |fits| &fits[j]);
                edges.push(edge(&pass[stretch.legs], &rows[from..at], fits, period));
            }
        }
        first += pass.len();
    }
    edges
}

/// One edge: its legs, the rows on them, what was fitted to it.
fn edge(legs: &[Leg], rows: &[Row], fits: &[Fit], period: f64) -> Edge {
    let speeds = rows.iter().map(|row| row.velocity[0].hypot(row.velocity[1]));
    let (least, sum, most) = speeds.fold((f64::INFINITY, 0.0, 0.0), |(least, sum, most): (f64, f64, f64), speed| {
        (least.min(speed), sum + speed, most.max(speed))
    });
    Edge {
        blocks: [legs[0].block, legs[legs.len() - 1].block],
        length_mm: legs.iter().map(Leg::length).sum(),
        time_s: rows.len() as f64 * period,
        deviation_mm: deviation(legs, rows),
        speed_mm_s: [least, sum / rows.len() as f64, most],
        pieces: fits.iter().map(Piece::of).collect(),
    }
}

/// How far rows are from the line of legs at the most, mm. Both go on: the nearest leg is looked for from the last one on.
fn deviation(legs: &[Leg], rows: &[Row]) -> f64 {
    /// Legs that are looked at, to both sides of the last nearest.
    const LOOKED: usize = 200;
    let mut near: usize = 0;
    let mut worst: f64 = 0.0;
    for row in rows {
        let off = |i: usize| polyline::distance_to_segment(row.pose.centre, legs[i].ends[0].at, legs[i].ends[1].at);
        let looked = near.saturating_sub(LOOKED)..legs.len().min(near + LOOKED);
        near = looked.min_by(|&a, &b| off(a).total_cmp(&off(b))).unwrap_or(near);
        worst = worst.max(off(near));
    }
    worst
}
