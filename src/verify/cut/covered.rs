//! A short curve under a blade that never moves: one plunge stands for all of it.

use super::body::Cut;
use crate::geom::polyline;
use crate::verify::reference::line::Line;
use crate::verify::reference::nibbled::is_curve;

/// Cosine of the blade with the line at its start below which it stands across it, by a little.
const COSINE: f64 = 0.35;
/// Greatest turn of a curve that one straight plunge may stand for, rad (110 degrees).
const TURN: f64 = 1.92;

/// A line from one end of which to the other a plunged blade lies, and between which it is a curve.
#[derive(Debug, Clone, Copy)]
pub(in crate::verify) struct Covered {
    /// How far the line bows away from the blade, mm.
    pub(in crate::verify) sag: f64,
}

impl Covered {
    /// `None` unless the blade passes both ends of the line by at most `allowed` mm, the line turns as a curve by no
    /// more than [`TURN`] between them and not across the blade, and it bows no farther than an arc of the same turn.
    pub(in crate::verify) fn new(line: &Line, cut: &Cut, allowed: f64) -> Option<Self> {
        if line.ring || !cut.is_plunge_cut() || line.chords() < 2 {
            return None;
        }
        let (heel, tip) = (cut.points[0], cut.points[cut.body]);
        let [start, end] = [line.point(0), line.point(line.chords())];
        let is_near = |place| polyline::distance_to_segment(place, heel, tip) <= allowed;
        let turns: Vec<f64> = (1..line.chords()).map(|vertex| line.turn(vertex)).collect();
        // What it turns to either side and back may be rounding.
        let turned = turns.iter().sum::<f64>().abs();
        let along = end - start;
        let is_across = along.dot(&line.direction(0)) < COSINE * along.norm();
        if !is_near(start) || !is_near(end) || turned > TURN || is_across {
            return None;
        }
        let turns: Vec<f64> = turns.iter().map(|turn| turn.abs()).collect();
        let all = turns.iter().sum::<f64>();
        // It turns along both halves of the chords at its ends, too.
        let arc = all + f64::midpoint(turns[0], turns[turns.len() - 1]);
        let away = line.points().map(|point| polyline::distance_to_segment(point, start, end));
        let sag = away.fold(0.0, f64::max);
        (is_curve(&turns) && sag <= polyline::sagitta(along.norm(), arc) + allowed).then_some(Self { sag })
    }
}
