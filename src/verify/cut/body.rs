//! Points that a stroke cuts: the body of the blade at the plunge, then the path of the tip.

use crate::geom::{Point, polyline};

/// Spacing of the points on the body of a plunged blade, mm.
pub(super) const BODY_STEP: f64 = 0.25;

/// Points that a stroke cuts: first those of the body, then those of the tip.
pub(in crate::verify) struct Cut {
    pub(in crate::verify) points: Vec<Point>,
    /// Path length from the first point to each point, mm.
    pub(in crate::verify) stations: Vec<f64>,
    /// Number of points of the body.
    pub(in crate::verify) body: usize,
    /// Row of each point of the tip.
    pub(in crate::verify) rows: Vec<usize>,
    /// Bow of the tip's path between two points.
    pub(in crate::verify) sagitta: Sagitta,
    /// True for a plunge cut: the blade plunges and lifts, and its tip stays within the permitted deviation of a cut.
    stands_still: bool,
}

/// Bow of the tip's path away from the straight line between two of its points.
#[derive(Debug, Clone, Copy)]
pub(in crate::verify) enum Sagitta {
    /// Points at equal times: an eighth of their second difference, as for a parabola.
    Timed,
    /// Upper bound, mm, for points placed along a known path.
    Within(f64),
}

impl Cut {
    /// Cut of a stroke with the tip at `tips` and the heel plunging at `heel`. It is a plunge cut if the tip stays within
    /// `still` mm of its first place.
    pub(in crate::verify) fn new(tips: &[Point], heel: Point, sagitta: Sagitta, still: f64) -> Self {
        let steps = ((tips[0] - heel).norm() / BODY_STEP).ceil() as usize;
        let body = (0..steps).map(|i| heel + (tips[0] - heel) * (i as f64 / steps as f64));
        let mut points: Vec<Point> = Vec::with_capacity(steps + tips.len());
        points.extend(body);
        let mut rows = Vec::with_capacity(tips.len());
        for (i, &tip) in tips.iter().enumerate() {
            // Rows at rest repeat their point; distinct points suffice.
            if i == 0 || tip != tips[i - 1] {
                points.push(tip);
                rows.push(i);
            }
        }
        let stands_still = tips.iter().all(|tip| (tip - tips[0]).norm() <= still);
        let stations = polyline::stations(&points);
        Self { stations, points, body: steps, rows, sagitta, stands_still }
    }

    /// Heel and tip of a plunge cut; the tip at its farthest position along the blade.
    pub(in crate::verify) fn blade(&self) -> [Point; 2] {
        let heel = self.points[0];
        let Some(axis) = polyline::direction(heel, self.points[self.body]) else { return [heel; 2] };
        let reach = self.points[self.body..].iter().map(|tip| (tip - heel).dot(&axis)).fold(0.0, f64::max);
        [heel, heel + axis * reach]
    }

    /// Length of the whole cut, mm: body and path of the tip.
    pub(in crate::verify) fn length(&self) -> f64 {
        self.stations[self.stations.len() - 1]
    }

    /// Length of the tip's path, mm.
    pub(in crate::verify) fn way(&self) -> f64 {
        self.length() - self.stations[self.body]
    }

    /// Greatest distance of the tip from its place at the plunge, mm.
    pub(in crate::verify) fn tip_travel(&self) -> f64 {
        let [plunged, ..] = self.points[self.body..] else { return 0.0 };
        self.points[self.body..].iter().map(|tip| (tip - plunged).norm()).fold(0.0, f64::max)
    }

    /// True for a plunge cut: the blade plunges and lifts without moving along a line.
    pub(in crate::verify) fn is_plunge_cut(&self) -> bool {
        self.stands_still
    }
}
