//! Swing: deviation of the body of a blade from a curve that its tip follows.

use super::plunge::Plunge;
use crate::geom::{Point, Vector, polyline};
use crate::ir::toolpath::{Edge, OrientationMode, Pose, Run, Shape};
use crate::machine::Knife;

/// Distance before and behind a place between which its direction is taken, mm: nearer points show only their rounding.
const LOOK: f64 = 0.5;
/// Length of the path behind the tip that is examined, in blade widths.
const BEHIND: f64 = 2.0;
/// Travel of the tip between two poses of a motion that are examined, mm.
const POSE_STEP: f64 = 0.2;
/// Greatest distance of a tip from its chord, mm: one that is farther off is past the end of the run, on its overlap.
const TIP_OFF: f64 = 1.0;

/// Greatest swing of a run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Swing {
    /// Distance of the body from the line, mm.
    pub off: f64,
    /// Place of the tip then.
    pub tip: Point,
    /// Place of the body, or of the line beside a chord, that is farthest off.
    pub at: Point,
    /// Vertex of the run behind which it occurs.
    pub vertex: usize,
}

/// Greatest deviation of the body of a blade from a run that its tip follows, without the deviation at its plunge; `None` if
/// there is none.
pub fn swing(run: &Run, width: f64) -> Option<Swing> {
    let followed = Followed::new(run, width)?;
    let swings = followed.vertices(0, 0.0).map(|vertex| followed.swing(vertex, 0));
    let worst = swings.reduce(Swing::greater)?;
    (worst.off > 0.0).then(|| Swing { vertex: worst.vertex % run.spans.len(), ..worst })
}

/// Greatest distance of the trailing end of a blade from a run along whose tangent it moves through these poses; `None` for a
/// blade that is its chord. Smoothing turns the blade before and behind a bend: the distance is less than at the bend as drawn.
pub fn moved(run: &Run, knife: &Knife, poses: impl Iterator<Item = Pose>) -> Option<Swing> {
    if run.orientation == OrientationMode::Chord {
        return None;
    }
    let Followed { path, stations, from, width, .. } = Followed::new(run, knife.width_mm)?;
    let chords = run.spans.len();
    let [ahead, behind] = match run.edge {
        Edge::Front => [knife.radius(), -knife.back()],
        Edge::Back => [-knife.back(), knife.radius()],
    };
    // On a ring the blade has no lap behind it until it has left its plunge.
    let (from, mut chord) = if run.shape == Shape::Ring { (from + width, chords) } else { (from, 0) };
    let (mut last, mut worst): (Option<Point>, Option<Swing>) = (None, None);
    for pose in poses {
        let tip = pose.ahead(ahead);
        if last.is_some_and(|last| (tip - last).norm() < POSE_STEP) {
            continue;
        }
        last = Some(tip);
        while chord + 1 < path.len() - 1 && polyline::foot(tip, path[chord], path[chord + 1]) >= 1.0 {
            chord += 1;
        }
        let station = stations[chord] + (tip - path[chord]).norm();
        if station < from || polyline::distance_to_segment(tip, path[chord], path[chord + 1]) > TIP_OFF {
            continue;
        }
        let first = stations.partition_point(|&passed| passed < station - BEHIND * width).saturating_sub(1).min(chord);
        let at = pose.ahead(behind);
        let off = polyline::distance(at, &path[first..=chord]).min(polyline::distance_to_segment(at, path[chord], tip));
        let next = Swing { off, tip, at, vertex: chord % chords };
        worst = Some(worst.map_or(next, |worst| worst.greater(next)));
    }
    worst
}

impl Swing {
    /// The greater of two, the first of equal ones.
    fn greater(self, next: Self) -> Self {
        if next.off > self.off { next } else { self }
    }
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
    while let Some(next) =
        followed.vertices(lifted, heel(lifted)).find(|&vertex| followed.swing(vertex, lifted).off > limit)
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

    /// Deviation of the body right behind a vertex, where it is greatest, for a blade that was plunged at vertex `plunged`.
    fn swing(&self, vertex: usize, plunged: usize) -> Swing {
        let station = self.stations[vertex] + LOOK;
        let tip = self.place(station, vertex);
        let first = self.stations.partition_point(|&passed| passed < station - BEHIND * self.width);
        // The chord that reaches back so far may begin much earlier.
        let first = first.saturating_sub(1).max(plunged);
        let behind = &self.path[first..=vertex];
        match self.orientation {
            OrientationMode::Tangent => {
                let ends = [station - LOOK, station + LOOK].map(|station| self.place(station, vertex));
                let heel =
                    tip - polyline::direction(ends[0], ends[1]).map_or(Vector::zeros(), |along| along * self.width);
                let off =
                    polyline::distance(heel, behind).min(polyline::distance_to_segment(heel, self.path[vertex], tip));
                Swing { off, tip, at: heel, vertex }
            }
            OrientationMode::Chord => {
                let (off, at) = chord_off(behind, tip, self.width);
                Swing { off, tip, at, vertex }
            }
        }
    }
}

/// Greatest distance of the path behind the tip from a blade that is its chord, mm, and the point of the path there.
fn chord_off(behind: &[Point], tip: Point, width: f64) -> (f64, Point) {
    let back: Vec<Point> = std::iter::once(tip).chain(behind.iter().rev().copied()).collect();
    let blade = Plunge::at_start(&back, width);
    let away = back[1..=blade.chord].iter().map(|&point| (blade.distance(point), point));
    away.fold((0.0, tip), |worst, next| if next.0 > worst.0 { next } else { worst })
}
