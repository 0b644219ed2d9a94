//! How far the body of a blade that follows a curve leaves it: its swing.

use super::plunge::Plunge;
use crate::geom::{Point, polyline};
use crate::ir::toolpath::{OrientationMode, Run, Shape};

/// How far behind a place its direction is looked for, mm: points as near as their rounding show none.
const LOOK: f64 = 0.5;
/// How much of the path behind the tip is looked at, in widths of the blade.
const BEHIND: f64 = 2.0;

/// How far the body of a blade of a width leaves a run at the most while its tip follows that, mm; what it does where it
/// plunges is not in it.
pub(super) fn swing(run: &Run, width: f64) -> f64 {
    if width == 0.0 {
        return 0.0;
    }
    // On a ring the heel follows the lap before.
    let (path, from) = match run.shape {
        Shape::Open => (run.points.clone(), width),
        Shape::Ring => (run.points.iter().chain(&run.points[1..]).copied().collect(), polyline::length(&run.points)),
    };
    let stations = polyline::stations(&path);
    let place = |station: f64| polyline::place(&path, &stations, station);
    let off = |vertex: usize| {
        // Right behind a bend the body is off the most.
        let station = stations[vertex] + LOOK;
        let tip = place(station);
        let first = stations.partition_point(|&passed| passed < station - BEHIND * width);
        // The chord that reaches so far back may begin long before.
        let behind: Vec<Point> = path[first.saturating_sub(1)..=vertex].iter().copied().chain([tip]).collect();
        match run.orientation {
            OrientationMode::Tangent => {
                let along = polyline::direction(place(station - LOOK), place(station + LOOK));
                along.map_or(0.0, |along| polyline::distance(tip - along * width, &behind))
            }
            OrientationMode::Chord => chord_off(&behind, width),
        }
    };
    let first = stations.partition_point(|&station| station < from).max(1);
    (first..path.len() - 1).map(off).fold(0.0, f64::max)
}

/// How far the path behind the tip is off a blade that is its chord.
fn chord_off(behind: &[Point], width: f64) -> f64 {
    let back: Vec<Point> = behind.iter().rev().copied().collect();
    let blade = Plunge::at_start(&back, width);
    back[1..=blade.chord].iter().map(|&point| blade.distance(point)).fold(0.0, f64::max)
}
