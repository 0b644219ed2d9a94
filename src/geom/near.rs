//! Which of many points lie on which of many segments, without looking at every pair.

use super::budget::Budget;
use super::{Point, polyline};

/// What a distance costs beside the comparison of two boxes.
const DISTANCE: usize = 20;
/// How far the rounding of two points to a grid may move one against the other, in units of the grid: its diagonal.
const ROUNDING: f64 = std::f64::consts::SQRT_2;

/// Points by their X, each with its place in the order that they came in.
pub fn sorted(points: impl Iterator<Item = Point>) -> Vec<(Point, usize)> {
    let mut points: Vec<(Point, usize)> = points.zip(0..).collect();
    points.sort_by(|a, b| a.0.x.total_cmp(&b.0.x));
    points
}

/// Looks for points on segments, as far as the rounding of both to a grid lets it tell.
#[derive(Debug)]
pub struct Near {
    slack: f64,
    budget: Budget,
}

impl Near {
    /// For points on a grid of `unit` mm.
    pub fn on_grid(unit: f64) -> Self {
        Self::within(ROUNDING * unit)
    }

    /// For points up to so far from their segments, mm.
    pub fn within(slack: f64) -> Self {
        Self { slack, budget: Budget::of_a_marker() }
    }

    /// Farthest that a point may lie from a segment that it is on, mm.
    pub fn slack(&self) -> f64 {
        self.slack
    }

    /// Whether the search was ended before its time.
    pub fn is_cut_short(&self) -> bool {
        self.budget.is_spent()
    }

    /// Calls `found` with the place of each of the [`sorted`] points that lies on the segment between two ends.
    pub fn each(&mut self, points: &[(Point, usize)], [a, b]: [Point; 2], mut found: impl FnMut(usize)) {
        let (least, greatest) = (a.x.min(b.x) - self.slack, a.x.max(b.x) + self.slack);
        let first = points.partition_point(|point| point.0.x < least);
        for &(point, place) in points[first..].iter().take_while(|point| point.0.x <= greatest) {
            if !self.budget.spend(DISTANCE) {
                return;
            }
            if polyline::distance_to_segment(point, a, b) <= self.slack {
                found(place);
            }
        }
    }
}
