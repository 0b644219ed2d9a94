//! How far the body of a blade that follows a curve leaves it: its swing.

use super::plunge::Plunge;
use crate::geom::{Point, polyline};
use crate::ir::toolpath::{OrientationMode, Run, Shape};
use crate::machine::Knife;

/// How far behind a place its direction is looked for, mm: points as near as their rounding show none.
const LOOK: f64 = 0.5;
/// How much of the path behind the tip is looked at, in widths of the blade.
const BEHIND: f64 = 2.0;

/// The greatest swing of a run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Swing {
    /// How far the body is off the line, mm.
    pub off: f64,
    /// The vertex behind which it is, of the run.
    pub vertex: usize,
}

/// How far the body of a blade of a width leaves a run at the most while its tip follows that; what it does where it
/// plunges is not in it. `None` where it never leaves it.
pub fn swing(run: &Run, width: f64) -> Option<Swing> {
    let followed = Followed::new(run, width)?;
    let swings = followed.vertices(0, 0.0).map(|vertex| Swing { off: followed.off(vertex, 0), vertex });
    let worst = swings.reduce(|worst, next| if next.off > worst.off { next } else { worst })?;
    (worst.off > 0.0).then(|| Swing { vertex: worst.vertex % run.spans.len(), ..worst })
}

/// The vertices at which a blade must be lifted so that its body leaves a run by at most `knife.max_swing_mm`. Of a ring
/// the first alone: from there on it is an open run.
pub fn bends(run: &Run, knife: &Knife) -> Vec<usize> {
    let Some(limit) = knife.max_swing_mm else { return Vec::new() };
    let Some(followed) = Followed::new(run, knife.width_mm) else { return Vec::new() };
    let mut bends = Vec::new();
    let mut lifted = 0;
    // It is plunged again so far before a lift.
    let heel = |lifted: usize| if lifted == 0 { 0.0 } else { knife.corner_heel_overlap_mm };
    while let Some(next) = followed.vertices(lifted, heel(lifted)).find(|&vertex| followed.off(vertex, lifted) > limit)
    {
        bends.push(next % run.spans.len());
        if run.shape == Shape::Ring {
            break;
        }
        lifted = next;
    }
    bends
}

/// The way of a blade along a run.
struct Followed {
    /// Points; a ring goes round twice, because the heel follows the lap before.
    path: Vec<Point>,
    stations: Vec<f64>,
    orientation: OrientationMode,
    /// How far from its plunge on the blade follows the path, mm.
    from: f64,
    width: f64,
}

impl Followed {
    /// `None` for a point, which has no body.
    fn new(run: &Run, width: f64) -> Option<Self> {
        let (path, from) = match run.shape {
            Shape::Open => (run.points.clone(), width),
            Shape::Ring => {
                (run.points.iter().chain(&run.points[1..]).copied().collect(), polyline::length(&run.points))
            }
        };
        let stations = polyline::stations(&path);
        (width > 0.0).then_some(Self { path, stations, orientation: run.orientation, from, width })
    }

    /// Inner vertices that the tip passes while the blade follows the path, for a plunge `before` mm before a vertex.
    fn vertices(&self, plunged: usize, before: f64) -> std::ops::Range<usize> {
        let from = self.stations[plunged] + self.from - before;
        self.stations.partition_point(|&station| station < from).max(plunged + 1)..self.path.len() - 1
    }

    /// The place at a station, which is looked for from a vertex before it or behind it on.
    fn place(&self, station: f64, vertex: usize) -> Point {
        polyline::place_near(&self.path, &self.stations, station, vertex)
    }

    /// How far the body is off the path that it was plunged on at a vertex, right behind another, mm: there it is off
    /// the most.
    fn off(&self, vertex: usize, plunged: usize) -> f64 {
        let station = self.stations[vertex] + LOOK;
        let tip = self.place(station, vertex);
        let first = self.stations.partition_point(|&passed| passed < station - BEHIND * self.width);
        // The chord that reaches so far back may begin long before.
        let first = first.saturating_sub(1).max(plunged);
        let behind = &self.path[first..=vertex];
        match self.orientation {
            OrientationMode::Tangent => {
                let ends = [station - LOOK, station + LOOK].map(|station| self.place(station, vertex));
                polyline::direction(ends[0], ends[1]).map_or(0.0, |along| {
                    let heel = tip - along * self.width;
                    polyline::distance(heel, behind).min(polyline::distance_to_segment(heel, self.path[vertex], tip))
                })
            }
            OrientationMode::Chord => chord_off(behind, tip, self.width),
        }
    }
}

/// How far the path behind the tip is off a blade that is its chord.
fn chord_off(behind: &[Point], tip: Point, width: f64) -> f64 {
    let back: Vec<Point> = std::iter::once(tip).chain(behind.iter().rev().copied()).collect();
    let blade = Plunge::at_start(&back, width);
    back[1..=blade.chord].iter().map(|&point| blade.distance(point)).fold(0.0, f64::max)
}
