//! Where the tip may run beside a polyline: within a part of the tolerance, and on chords of a flattened curve also
//! outside of them, by the sagitta that the turns at their ends suggest.

use crate::geom::{Point, Vector, left, polyline};
use crate::machine::{Fit, MachineProfile};

/// Longest chord that is taken for one of a flattened curve, mm.
const CURVE_CHORD_MAX: f64 = 25.0;
/// Smaller turns are none, rad.
const TURN_EPSILON: f64 = 1e-6;

/// A polyline and what counts as on it.
#[derive(Debug)]
pub(super) struct Tube {
    /// Its points, no two in a row equal.
    pub(super) points: Vec<Point>,
    /// Chord length from the first point to each point, mm.
    pub(super) stations: Vec<f64>,
    /// Turn at each point, rad; 0 at the ends.
    pub(super) turns: Vec<f64>,
    /// Outward bulge in the middle of each chord.
    pub(super) bulges: Vec<Vector>,
    /// Permitted deviation, mm.
    pub(super) tolerance: f64,
}

impl Tube {
    pub(super) fn new(points: Vec<Point>, tolerance: f64, profile: &MachineProfile) -> Self {
        let stations = polyline::stations(&points);
        let mut turns = vec![0.0; points.len()];
        for i in 1..points.len().saturating_sub(1) {
            turns[i] = polyline::turn_at(points[i - 1], points[i], points[i + 1]);
        }
        let corner = profile.corner.angle();
        let bulge = |i: usize| {
            let [before, after] = [turns[i], turns[i + 1]];
            let along = points[i + 1] - points[i];
            let length = along.norm();
            let is_turn = |turn: f64| turn.abs() > TURN_EPSILON && turn.abs() < corner;
            let is_curve = before * after > 0.0 && is_turn(before) && is_turn(after) && length <= CURVE_CHORD_MAX;
            if profile.path.fit == Fit::Polygon || !is_curve {
                return Vector::zeros();
            }
            let mean = f64::midpoint(before, after);
            let height = (length * mean.abs() / 8.0).min(profile.path.chord_sag_max_mm);
            left(along) * (-mean.signum() * height / length)
        };
        let bulges = (0..points.len() - 1).map(bulge).collect();
        Self { points, stations, turns, bulges, tolerance }
    }

    /// Number of chords.
    pub(super) fn chords(&self) -> usize {
        self.bulges.len()
    }

    /// Unit vector along a chord.
    pub(super) fn direction(&self, chord: usize) -> Vector {
        (self.points[chord + 1] - self.points[chord]) / (self.stations[chord + 1] - self.stations[chord])
    }

    /// How far a point is from what counts as on the path, mm, beside `chord` or one behind it, which then is the one.
    pub(super) fn deviation(&self, point: Point, chord: &mut usize) -> f64 {
        loop {
            let (a, b) = (self.points[*chord], self.points[*chord + 1]);
            let along = b - a;
            let share = (point - a).dot(&along) / along.norm_squared();
            if share > 1.0 && *chord + 1 < self.chords() {
                *chord += 1;
                continue;
            }
            let x = share.clamp(0.0, 1.0);
            let away = point - (a + along * x);
            let bulge = self.bulges[*chord] * (4.0 * x * (1.0 - x));
            let height = bulge.norm();
            if height == 0.0 {
                return away.norm();
            }
            let outward = bulge / height;
            return (away - outward * away.dot(&outward).clamp(0.0, height)).norm();
        }
    }
}
