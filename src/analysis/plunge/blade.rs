//! Blade plunged at the start of a path: position of its tip, and the chord of the path on which it is.

use crate::geom::{Point, Vector, angle, polyline};

/// Share of the tolerance by which a plunged blade may miss a point of its cut; rounding takes a little of the rest.
pub const PASSING_SHARE: f64 = 0.9;

/// Least cosine of the blade with the path at its heel, reached on an arc of 0.55 blade widths. Below it the heel darts along
/// the path, and the blade swings.
const HEEL_COSINE_MIN: f64 = 0.4;

/// Longest motion of a tip that counts as standing still, in tolerances: smoothing moves a tip as far.
pub(super) const STILL_TOLERANCES: f64 = 2.0;

/// Least radius, mm, on which a moving blade turns from its chord to the tangent of its path. Decimals of a controller, 0.0001 mm,
/// cannot tell the headings on a tighter one to within half a degree.
const TURN_RADIUS_MIN: f64 = 0.75;

/// True if a blade, given from heel to tip, stands across a path with this direction at its heel.
pub fn stands_across(blade: Vector, direction: Vector) -> bool {
    blade.dot(&direction) < HEEL_COSINE_MIN * blade.norm()
}

/// Blade plunged with its heel at the first point of a path, as a chord of it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Plunge {
    /// Position of the heel.
    pub heel: Point,
    /// Position of the tip: the first place of the path at one blade width from its start, else the end of the path.
    pub tip: Point,
    /// Chord of the path on which the tip is.
    pub chord: usize,
    /// True if the whole path is within one blade width of its start. The tip is then set to the end of the path; the real one
    /// may be beyond it.
    pub covers_all: bool,
}

impl Plunge {
    /// Blade of `width` mm at the start of a path of at least two points.
    pub fn at_start(path: &[Point], width: f64) -> Self {
        match polyline::first_at_distance(path, width) {
            Some((tip, chord)) => Self { heel: path[0], tip, chord, covers_all: false },
            None => Self::over(path),
        }
    }

    /// Blade over all of a path, from its start to its end.
    pub fn over(path: &[Point]) -> Self {
        let last = path.len() - 1;
        Self { heel: path[0], tip: path[last], chord: last - 1, covers_all: true }
    }

    /// True if the blade can move along the path by more than `least` mm between plunge and lift.
    pub fn has_way(&self, path: &[Point], least: f64) -> bool {
        let last = path.len() - 1;
        !self.covers_all && (self.chord + 1 < last || (path[last] - self.tip).norm() > least)
    }

    /// Length of the path behind its tip, mm.
    pub fn way(&self, path: &[Point]) -> f64 {
        let next = self.chord + 1;
        (path[next] - self.tip).norm() + polyline::length(&path[next..])
    }

    /// True if the tip stays within the reach of smoothing from plunge to lift.
    pub fn stands_still(&self, path: &[Point], tolerance: f64) -> bool {
        self.covers_all || self.way(path) <= STILL_TOLERANCES * tolerance
    }

    /// True if the way is too short for the blade to turn from the chord to the tangent of the path.
    pub fn turns_on_the_spot(&self, path: &[Point]) -> bool {
        let along = polyline::direction(path[self.chord], path[self.chord + 1]).filter(|_| !self.covers_all);
        along.is_some_and(|along| self.way(path) < TURN_RADIUS_MIN * angle::turn(self.blade(), along).abs())
    }

    /// Vector from heel to tip, mm.
    pub fn blade(&self) -> Vector {
        self.tip - self.heel
    }

    /// Distance of a point from the blade, mm.
    pub fn distance(&self, point: Point) -> f64 {
        polyline::distance_to_segment(point, self.heel, self.tip)
    }

    /// Angle of the blade against the first chord of the path, rad, unwrapped along the path; zero if the blade covers all of
    /// it.
    pub fn lag(&self, path: &[Point]) -> f64 {
        let Some(first) = polyline::direction(path[0], path[1]).filter(|_| !self.covers_all) else { return 0.0 };
        let under = path[1..=self.chord].iter().chain([&self.tip]);
        let directions = under.filter_map(|&point| polyline::direction(path[0], point));
        directions.fold(0.0, |lag, along| lag + angle::wrap(angle::turn(first, along) - lag))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_blade_exactly_as_long_as_its_path_has_no_way_to_go() {
        let path = [Point::new(0.0, 0.0), Point::new(4.0, 0.0), Point::new(6.0, 0.0)];
        let plunges = [5.0, 6.0, 7.0].map(|width| Plunge::at_start(&path, width));
        assert_eq!(plunges.map(|plunge| plunge.has_way(&path, 0.0)), [true, false, false]);
        assert_eq!(plunges.map(|plunge| plunge.covers_all), [false, false, true]);
        assert_eq!(plunges.map(|plunge| plunge.tip.x), [5.0, 6.0, 6.0]);
    }

    #[test]
    fn a_blade_turns_on_the_spot_where_little_way_is_left_behind_a_bend() {
        // The path turns by 45 degrees under a blade of 6 mm, whose chord is between both directions.
        let turns = |end: f64| {
            let path = [Point::new(0.0, 0.0), Point::new(5.0, 0.0), Point::new(5.0 + end, end)];
            Plunge::at_start(&path, 6.0).turns_on_the_spot(&path)
        };
        assert_eq!([0.5, 1.0, 2.0].map(turns), [false, true, false]);
        let straight = [Point::new(0.0, 0.0), Point::new(6.1, 0.0)];
        assert!(!Plunge::at_start(&straight, 6.0).turns_on_the_spot(&straight));
    }

    #[test]
    fn the_lag_is_counted_along_the_path() {
        // Three quarters of a turn to the left: the blade is turned by more than half a turn from its first chord.
        let around = [(0.0, 0.0), (3.0, 0.0), (3.0, 1.0), (-1.0, 1.0), (-1.0, -9.0)];
        let path = around.map(|(x, y)| Point::new(x, y));
        let lag = Plunge::at_start(&path, 8.0).lag(&path);
        assert!(lag > std::f64::consts::PI, "{lag}");
    }
}
