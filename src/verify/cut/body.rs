//! What a stroke cuts: the body of the blade where it plunges, then the way of its tip.

use crate::geom::{Point, polyline};

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
    /// Whether the blade plunges and lifts without a way: its tip stays where a cut may be off anyway.
    stands_still: bool,
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
    /// What a stroke cuts whose tip comes by `tips` and whose heel plunges at `heel`; a tip that stays within `still` mm of
    /// where it plunges goes no way.
    pub(in crate::verify) fn new(tips: &[Point], heel: Point, sagitta: Sagitta, still: f64) -> Self {
        let steps = ((tips[0] - heel).norm() / BODY_STEP).ceil() as usize;
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
        let stands_still = tips.iter().all(|tip| (tip - tips[0]).norm() <= still);
        let stations = polyline::stations(&points);
        Self { stations, points, body: steps, rows, sagitta, stands_still }
    }

    /// The heel and the tip of one that only plunges; the tip as far along the blade as it comes.
    pub(in crate::verify) fn blade(&self) -> [Point; 2] {
        let heel = self.points[0];
        let Some(axis) = polyline::direction(heel, self.points[self.body]) else { return [heel; 2] };
        let reach = self.points[self.body..].iter().map(|tip| (tip - heel).dot(&axis)).fold(0.0, f64::max);
        [heel, heel + axis * reach]
    }

    /// Length of all that it cuts, mm: of the body, and of the tip's way.
    pub(in crate::verify) fn length(&self) -> f64 {
        self.stations[self.stations.len() - 1]
    }

    /// Length of the tip's way, mm.
    pub(in crate::verify) fn way(&self) -> f64 {
        self.length() - self.stations[self.body]
    }

    /// Greatest distance of the tip from where it plunges, mm.
    pub(in crate::verify) fn tip_travel(&self) -> f64 {
        let [plunged, ..] = self.points[self.body..] else { return 0.0 };
        self.points[self.body..].iter().map(|tip| (tip - plunged).norm()).fold(0.0, f64::max)
    }

    /// Whether the blade plunges and lifts without a way.
    pub(in crate::verify) fn is_plunge_cut(&self) -> bool {
        self.stands_still
    }
}
