//! The line of the tip along the polyline of a run, from the plunge to the lift.

use crate::geom::{Point, Vector, polyline};
use crate::ir::toolpath::{Run, Shape};

/// Length below which a stretch is empty, mm.
pub(super) const LENGTH_EPSILON: f64 = 1e-3;
/// Distance within which a point counts as on a chord, mm: rounding.
const ON_EPSILON: f64 = 1e-6;

/// The line of the tip from plunge to lift.
pub(super) struct TipLine {
    /// Vertices; consecutive ones differ.
    pub(super) points: Vec<Point>,
    /// Index of the chord of the run under each of its chords.
    pub(super) chords: Vec<usize>,
    /// Point where the heel plunges; `None` when the blade does not stand as a chord of the run.
    pub(super) heel: Option<Point>,
    /// Index of the point at the start of the next run, and the unit vector along that run there; `None` where the next run does
    /// not continue this one.
    pub(super) meets: Option<(usize, Vector)>,
}

impl TipLine {
    /// The line of a run cut by a blade of a width, mm.
    pub(super) fn new(run: &Run, width: f64) -> Self {
        match run.shape {
            Shape::Ring => Self::of_ring(run),
            Shape::Open => Self::of_open(run, width),
        }
    }

    /// Removes bends so near to the start that no piece can be written before them. There the blade, plunged as a chord of the
    /// following line, would turn on the spot. Only bends within `reach` mm of the start and within `off` mm of a straight line
    /// are removed.
    pub(super) fn without_bend_at_start(mut self, [reach, off]: [f64; 2]) -> Self {
        let is_straightened = |points: &[Point]| match *points {
            [start, bend, next, ..] => {
                (bend - start).norm() < reach && polyline::distance_to_segment(bend, start, next) <= off
            }
            _ => false,
        };
        while self.heel.is_some() && is_straightened(&self.points) {
            self.points.remove(1);
            self.chords.remove(0);
        }
        self
    }

    /// Adds the start of the run that continues this one as a vertex, so that both cuts pass through it.
    pub(super) fn by_way_of(mut self, next: &Run) -> Self {
        let (start, along) = (next.points[0], polyline::direction(next.points[0], next.points[1]));
        let is_on = |ends: &[Point]| polyline::distance_to_segment(start, ends[0], ends[1]) <= ON_EPSILON;
        let Some((chord, along)) = self.points.windows(2).rposition(is_on).zip(along) else { return self };
        let near = |point: Point| (start - point).norm() <= LENGTH_EPSILON;
        let known = [chord, chord + 1].into_iter().find(|&vertex| near(self.points[vertex]));
        let vertex = known.unwrap_or_else(|| {
            self.points.insert(chord + 1, start);
            self.chords.insert(chord, self.chords[chord]);
            chord + 1
        });
        self.meets = (1..self.points.len() - 1).contains(&vertex).then_some((vertex, along));
        self
    }

    /// The line of a ring: once around, then on past the start by the front overlap.
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
        Self { points, chords, heel: None, meets: None }
    }

    /// The line of an open run. It starts at the tip's position while the heel plunges at the start of the heel overlap.
    fn of_open(run: &Run, width: f64) -> Self {
        let n = run.points.len();
        let extended = run.extended();
        let heel = usize::from(run.heel > 0.0);
        let chord_of = |i: usize| i.saturating_sub(heel).min(n - 2);
        if width <= 0.0 {
            let chords = (0..extended.len() - 1).map(chord_of).collect();
            return Self { points: extended, chords, heel: None, meets: None };
        }
        let last = extended.len() - 1;
        let (tip, first) = polyline::first_at_distance(&extended, width).unwrap_or((extended[last], last - 1));
        let mut points = Vec::with_capacity(extended.len() - first);
        points.push(tip);
        let mut chords = Vec::with_capacity(extended.len() - first);
        for (i, &point) in extended.iter().enumerate().skip(first + 1) {
            if (point - points[points.len() - 1]).norm() > LENGTH_EPSILON {
                points.push(point);
                chords.push(chord_of(i - 1));
            }
        }
        if points.len() < 2 {
            // The tip is already at its end: use a line of negligible length.
            let along = polyline::direction(extended[last - 1], extended[last]).unwrap_or(Vector::new(1.0, 0.0));
            points.push(tip + along * LENGTH_EPSILON);
            chords.push(chord_of(last - 1));
        }
        Self { points, chords, heel: Some(extended[0]), meets: None }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_bend_just_before_the_tip_is_straightened_and_others_stay() {
        let line = |first: f64, bent: f64| {
            let points = [(0.0, 0.0), (first, 0.0), (4.0, bent), (9.0, bent)].map(|(x, y)| Point::new(x, y));
            let heel = Some(Point::new(-6.6, 0.0));
            let line = TipLine { points: points.to_vec(), chords: vec![0, 1, 2], heel, meets: None };
            let TipLine { points, chords, .. } = line.without_bend_at_start([0.005, 0.001]);
            (points.len(), chords)
        };
        assert_eq!(line(0.0014, 0.1), (3, vec![1, 2]));
        assert_eq!(line(0.5, 0.1), (4, vec![0, 1, 2]));
        assert_eq!(line(0.004, 9.0), (4, vec![0, 1, 2]));
    }
}
