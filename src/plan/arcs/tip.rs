//! The line of the tip: where it goes along the polyline of a run, from the plunge to the lift.

use crate::geom::{Point, Vector, polyline};
use crate::ir::toolpath::{Run, Shape};

/// Shorter ways are none, mm.
pub(super) const LENGTH_EPSILON: f64 = 1e-3;

/// The line of the tip from plunge to lift.
pub(super) struct TipLine {
    /// No two in a row equal.
    pub(super) points: Vec<Point>,
    /// The chord of the run that each of its chords lies on.
    pub(super) chords: Vec<usize>,
    /// Where the heel plunges, when the blade stands as a chord of the run.
    pub(super) heel: Option<Point>,
}

impl TipLine {
    /// That of a run that a blade of a width cuts, mm.
    pub(super) fn new(run: &Run, width: f64) -> Self {
        match run.shape {
            Shape::Ring => Self::of_ring(run),
            Shape::Open => Self::of_open(run, width),
        }
    }

    /// Once around, and on past the start by the front overlap.
    fn of_ring(run: &Run) -> Self {
        let n = run.points.len();
        let mut points = run.points.clone();
        let mut chords: Vec<usize> = (0..n - 1).collect();
        let mut left = run.front;
        let mut chord = 0;
        while left > LENGTH_EPSILON {
            let (a, b) = (run.points[chord], run.points[chord + 1]);
            let length = (b - a).norm();
            points.push(if left < length { a + (b - a) * (left / length) } else { b });
            chords.push(chord);
            left -= length;
            chord = (chord + 1) % (n - 1);
        }
        Self { points, chords, heel: None }
    }

    /// From where the tip stands while the heel plunges at the start of the heel overlap.
    fn of_open(run: &Run, width: f64) -> Self {
        let n = run.points.len();
        let extended = run.extended();
        let heel = usize::from(run.heel > 0.0);
        let chord_of = |i: usize| i.saturating_sub(heel).min(n - 2);
        if width <= 0.0 {
            let chords = (0..extended.len() - 1).map(chord_of).collect();
            return Self { points: extended, chords, heel: None };
        }
        let last = extended.len() - 1;
        let (tip, first) = polyline::first_at_distance(&extended, width).unwrap_or((extended[last], last - 1));
        let mut points = vec![tip];
        let mut chords = Vec::new();
        for (i, &point) in extended.iter().enumerate().skip(first + 1) {
            if (point - points[points.len() - 1]).norm() > LENGTH_EPSILON {
                points.push(point);
                chords.push(chord_of(i - 1));
            }
        }
        if points.len() < 2 {
            // The tip stands at its end already: a way too short to be told from none.
            let along = polyline::direction(extended[last - 1], extended[last]).unwrap_or(Vector::new(1.0, 0.0));
            points.push(tip + along * LENGTH_EPSILON);
            chords.push(chord_of(last - 1));
        }
        Self { points, chords, heel: Some(extended[0]) }
    }
}
