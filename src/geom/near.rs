//! Point-on-segment queries between many points and many segments, without testing every pair.

use super::budget::Budget;
use super::{Extent, Point, polyline};

/// Cost of a distance, in units of the comparison of two boxes.
const DISTANCE: usize = 20;
/// Maximum relative displacement of two points by rounding to a grid, in units of the grid: its diagonal.
const ROUNDING: f64 = std::f64::consts::SQRT_2;

/// Points sorted by x, each with its original index.
pub fn sorted(points: impl Iterator<Item = Point>) -> Vec<(Point, usize)> {
    let mut points: Vec<(Point, usize)> = points.zip(0..).collect();
    points.sort_by(|a, b| a.0.x.total_cmp(&b.0.x));
    points
}

/// Finds points on segments, within the rounding of both to a grid.
#[derive(Debug)]
pub struct Near {
    slack: f64,
    budget: Budget,
}

impl Near {
    /// A search for points on a grid of `unit` mm.
    pub fn on_grid(unit: f64) -> Self {
        Self::within(ROUNDING * unit)
    }

    /// A search for points within `slack` mm of their segments.
    pub fn within(slack: f64) -> Self {
        Self { slack, budget: Budget::of_a_marker() }
    }

    /// Maximum distance of a point from a segment that it counts as on, mm.
    pub fn slack(&self) -> f64 {
        self.slack
    }

    /// True if the budget was spent before the search was complete.
    pub fn is_cut_short(&self) -> bool {
        self.budget.is_spent()
    }

    /// True if one of the [`sorted`] points may lie on a line with this bounding box.
    pub fn may_be_in(&mut self, points: &[(Point, usize)], extent: Extent) -> bool {
        let around = extent.grown(self.slack);
        let first = points.partition_point(|point| point.0.x < around.min.x);
        let mut beside = points[first..].iter().take_while(|point| point.0.x <= around.max.x);
        beside.any(|point| self.budget.spend(1) && around.holds(point.0))
    }

    /// Calls `found` with the original index of each of the [`sorted`] points that lies on a segment.
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
