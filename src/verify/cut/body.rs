//! What a stroke cuts: the body of the blade where it plunges, then the way of its tip.

use super::follow::Foot;
use crate::geom::{Point, polyline};
use crate::machine::Knife;
use crate::verify::reference::line::Line;
use crate::verify::reference::nibbled::is_curve;

/// Distance of two places at which the body of a plunged blade is looked at, mm.
pub(super) const BODY_STEP: f64 = 0.25;

/// What a stroke cuts: the body's places, then the tip's.
pub(in crate::verify) struct Cut {
    pub(in crate::verify) points: Vec<Point>,
    /// Length of the way from the first place to each, mm.
    pub(in crate::verify) stations: Vec<f64>,
    /// Number of places of the body.
    pub(in crate::verify) body: usize,
    /// The row of each place of the tip.
    pub(in crate::verify) rows: Vec<usize>,
    /// How the tip goes from place to place.
    pub(in crate::verify) sagitta: Sagitta,
}

/// How far the way of a tip bows away from the straight line between two of its places.
#[derive(Debug, Clone, Copy)]
pub(in crate::verify) enum Sagitta {
    /// As places at equal times show: by an eighth of their second difference, as a parabola does.
    Timed,
    /// By no more than this, mm: they were laid so along a way that is known.
    Within(f64),
}

impl Cut {
    /// What a stroke cuts whose tip comes by `tips` and whose heel plunges at `heel`.
    pub(in crate::verify) fn new(tips: &[Point], heel: Point, knife: &Knife) -> Self {
        let steps = (knife.width_mm / BODY_STEP).ceil() as usize;
        let body = (0..steps).map(|i| heel + (tips[0] - heel) * (i as f64 / steps as f64));
        let mut points: Vec<Point> = Vec::with_capacity(steps + tips.len());
        points.extend(body);
        let mut rows = Vec::with_capacity(tips.len());
        for (i, &tip) in tips.iter().enumerate() {
            // Rest rows repeat their place; a track of places that differ is enough.
            if i == 0 || tip != tips[i - 1] {
                points.push(tip);
                rows.push(i);
            }
        }
        Self { stations: polyline::stations(&points), points, body: steps, rows, sagitta: Sagitta::Timed }
    }

    /// Length of all that it cuts, mm: of the body, and of the tip's way.
    pub(in crate::verify) fn length(&self) -> f64 {
        self.stations[self.stations.len() - 1]
    }

    /// Length of the tip's way, mm.
    pub(in crate::verify) fn way(&self) -> f64 {
        self.length() - self.stations[self.body]
    }

    /// Whether the blade plunges and lifts without a way.
    pub(in crate::verify) fn is_plunge_cut(&self) -> bool {
        self.points.len() == self.body + 1
    }
}

/// The body of a plunged blade: a chord of the path, which bows away from it.
#[derive(Debug, Default)]
pub(in crate::verify) struct Body {
    /// How far the path bows away from the blade, mm: what it does, and at the most what an arc of the same turn does.
    pub(in crate::verify) sag: f64,
    /// The places between which it does: heel and tip, or what of a blade that never moves is not its surplus.
    pub(in crate::verify) ends: [usize; 2],
    /// Turn of the path under the blade, rad, when the blade never moves: its surplus then goes off the line straight on.
    turned: f64,
}

impl Body {
    /// The body of a cut whose places stand at `feet` of a line; `allowed` is how far its ends may be off, mm.
    pub(in crate::verify) fn new(line: &Line, cut: &Cut, feet: &[Foot], allowed: f64) -> Self {
        let is_on = |&i: &usize| feet[i].deviation <= allowed;
        let ends = if cut.is_plunge_cut() {
            // The surplus of a blade that never moves may leave the line at either end.
            (0..=cut.body).find(is_on).zip((0..=cut.body).rev().find(is_on))
        } else {
            Some((0, cut.body)).filter(|(heel, tip)| is_on(heel) && is_on(tip))
        };
        // A blade that does not lie along the line is no chord of it.
        let Some((first, last)) = ends else { return Self::default() };
        let (heel, tip) = (cut.points[first], cut.points[last]);
        let (a, b) = (feet[first].station, feet[last].station);
        let (low, high) = (a.min(b), a.max(b));
        let mut body = Self { ends: [first, last], ..Self::default() };
        let mut turns: Vec<f64> = Vec::new();
        for vertex in line.vertices(low, high) {
            body.sag = body.sag.max(polyline::distance_to_segment(line.point(vertex), heel, tip));
            turns.extend(Some(line.turn(vertex).abs()).filter(|&turn| turn > 0.0));
        }
        let turned: f64 = turns.iter().sum();
        body.turned = if cut.is_plunge_cut() { turned } else { 0.0 };
        // The chord that is being left counts, too: a curve turns along its chords, not at its vertices.
        let length = line.length();
        let next = if b >= a { line.vertices(high.next_up(), high + length).next() } else { line.vertex_before(low) };
        let is_inner = |vertex: &usize| line.ring || (1..line.chords()).contains(vertex);
        let next = next.filter(is_inner).map(|vertex| line.turn(vertex).abs());
        // A curve turns along the halves of the chords at its ends, too.
        let beside = match &turns[..] {
            [first, .., last] if !line.ring && is_curve(&turns) => {
                let is_start = line.vertex_before(low.next_up()).is_none_or(|vertex| vertex == 0);
                let is_end = high >= line.station(line.chords() - 1);
                (if is_start { first / 2.0 } else { 0.0 }) + next.unwrap_or(if is_end { last / 2.0 } else { 0.0 })
            }
            _ => next.unwrap_or(0.0),
        };
        body.sag = body.sag.min(polyline::sagitta((tip - heel).norm(), turned + beside));
        body
    }

    /// How far place `i` of the body is off. Its ends stand on the path or its extension; only between them the blade cuts
    /// across.
    pub(in crate::verify) fn off(&self, i: usize, foot: &Foot) -> f64 {
        let [first, last] = self.ends;
        let sag = if first < i && i < last { self.sag } else { 0.0 };
        (foot.deviation - sag.max(self.turned * foot.beyond)).max(0.0)
    }
}
