//! Swing: deviation of the body of a blade from a curve that its tip follows.

use super::plunge::Plunge;
use crate::geom::{Point, polyline};
use crate::ir::toolpath::{OrientationMode, Run, Shape};
use crate::machine::Knife;

/// Distance before and behind a place between which its direction is taken, mm: nearer points show only their rounding.
const LOOK: f64 = 0.5;
/// Length of the path behind the tip that is examined, in blade widths.
const BEHIND: f64 = 2.0;

/// Greatest swing of a run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Swing {
    /// Distance of the body from the line, mm.
    pub off: f64,
    /// Vertex of the run behind which it occurs.
    pub vertex: usize,
}

/// Greatest deviation of the body of a blade from a run that its tip follows, without the deviation at its plunge; `None` if
/// there is none.
pub fn swing(run: &Run, width: f64) -> Option<Swing> {
    let followed = Followed::new(run, width)?;
    let swings = followed.vertices(0, 0.0).map(|vertex| Swing { off: followed.off(vertex, 0), vertex });
    let worst = swings.reduce(|worst, next| if next.off > worst.off { next } else { worst })?;
    (worst.off > 0.0).then(|| Swing { vertex: worst.vertex % run.spans.len(), ..worst })
}

/// Vertices at which a blade must be lifted for its body to stay within `knife.max_swing_mm` of a run. For a ring only the
/// first: it becomes an open run there.
pub fn bends(run: &Run, knife: &Knife) -> Vec<usize> {
    let Some(limit) = knife.max_swing_mm else { return Vec::new() };
    let Some(followed) = Followed::new(run, knife.width_mm) else { return Vec::new() };
    let mut bends = Vec::new();
    let mut lifted = 0;
    // The heel plunges again that far before a lift.
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

/// Motion of a blade along a run.
struct Followed {
    /// Points; a ring is included twice, because the heel follows the lap before.
    path: Vec<Point>,
    stations: Vec<f64>,
    orientation: OrientationMode,
    /// Length from the plunge after which the blade follows the path, mm.
    from: f64,
    width: f64,
}

impl Followed {
    /// `None` for a blade of zero width, which has no body.
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

    /// Inner vertices that the tip passes while the blade follows the path, for a plunge `before` mm before vertex `plunged`.
    fn vertices(&self, plunged: usize, before: f64) -> std::ops::Range<usize> {
        let from = self.stations[plunged] + self.from - before;
        self.stations.partition_point(|&station| station < from).max(plunged + 1)..self.path.len() - 1
    }

    /// Point at a station, searched from a nearby vertex.
    fn place(&self, station: f64, vertex: usize) -> Point {
        polyline::place_near(&self.path, &self.stations, station, vertex)
    }

    /// Deviation of the body right behind a vertex, where it is greatest, mm, for a blade that was plunged at vertex `plunged`.
    fn off(&self, vertex: usize, plunged: usize) -> f64 {
        let station = self.stations[vertex] + LOOK;
        let tip = self.place(station, vertex);
        let first = self.stations.partition_point(|&passed| passed < station - BEHIND * self.width);
        // The chord that reaches back so far may begin much earlier.
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

/// Greatest distance of the path behind the tip from a blade that is its chord, mm.
fn chord_off(behind: &[Point], tip: Point, width: f64) -> f64 {
    let back: Vec<Point> = std::iter::once(tip).chain(behind.iter().rev().copied()).collect();
    let blade = Plunge::at_start(&back, width);
    back[1..=blade.chord].iter().map(|&point| blade.distance(point)).fold(0.0, f64::max)
}
