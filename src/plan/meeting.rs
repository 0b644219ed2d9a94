//! Runs that meet at a vertex of their contour: permitted deviation of each tip there, so that the cuts cross.
//!
//! Each tip may deviate from its line by the tolerance, and two cuts beside each other leave a thread between them. An overlap
//! has known ends. An overlap of length o that leads back over a line at the angle a starts o sin a beside that line. The other
//! cut passes between this start and the vertex if it deviates by less. At a needle-shaped tip both overlaps lead ahead of the
//! vertex, and an overlap of length p reaches at most p tan a. Where o sin a or p tan a is less than the tolerance (the contour
//! hardly turns at the lift, or an overlap has no room), the deviation of the tip is limited to it.

use crate::geom::{Point, Vector, cross, polyline};
use crate::ir::toolpath::{End, PlungeCut, Run, Shape, Side, Step, Toolpath};
use crate::machine::Job;
use crate::plan::spline::Near;

/// Minimum deviation required of a tip, in widths of the widest uncut thread. Two tips that deviate to opposite sides are then
/// 0.9 of a width apart.
const LEAST: f64 = 0.45;
/// Length before the vertex with limited deviation, in tolerances, in addition to both overlaps. Before that stretch the full
/// tolerance holds.
const STRETCH: f64 = 2.0;

/// Distance below which two places are equal, mm: rounding.
pub(super) const SAME_EPSILON: f64 = 1e-6;

/// A cut as seen by its neighbours on the contour: a run or a plunge cut.
#[derive(Clone, Copy)]
struct Stroke<'a> {
    points: &'a [Point],
    ends: [End; 2],
    turned: bool,
    run: Option<&'a Run>,
    /// The plunge cut, whose straight blade lies along its points; `None` for a run.
    plunge: Option<&'a PlungeCut>,
}

impl<'a> Stroke<'a> {
    fn of_step(step: &'a Step) -> Option<Self> {
        match step {
            Step::Run(run) => Some(Self::of(run)),
            Step::PlungeCut(cut) => {
                Some(Self { points: &cut.points, ends: cut.ends, turned: cut.turned, run: None, plunge: Some(cut) })
            }
            Step::Turn(_) | Step::Travel(_) | Step::Drill(_) | Step::Event(_) => None,
        }
    }

    fn of(run: &'a Run) -> Self {
        Self { points: &run.points, ends: run.ends, turned: run.turned, run: Some(run), plunge: None }
    }
}

/// One end of a stroke.
struct Place {
    at: Point,
    /// Unit vector along the overlap, away from the stroke.
    beyond: Vector,
    /// Length of the overlap, mm.
    overlap: f64,
}

impl Place {
    /// The start (0) or the end (1) of a run.
    fn of(run: &Run, end: usize) -> Self {
        let last = run.points.len() - 1;
        let ([from, to], overlap) = [([1, 0], run.heel), ([last - 1, last], run.front)][end];
        let beyond = polyline::direction(run.points[from], run.points[to]);
        Self { at: run.points[to], beyond: beyond.expect("no chord of a run has length zero"), overlap }
    }

    /// The start (0) or the end (1) of a plunge cut.
    fn of_plunge(cut: &PlungeCut, end: usize) -> Self {
        let last = cut.points.len() - 1;
        let (at, beyond, overlap) = [(0, -cut.along, cut.heel), (last, cut.along, cut.front)][end];
        Self { at: cut.points[at], beyond, overlap }
    }

    /// Maximum deviation at which this cut still crosses the cut of another end, mm.
    fn beside(&self, other: &Self) -> f64 {
        let sin = cross(self.beyond, other.beyond).abs();
        let reach = other.overlap * sin;
        let cos = self.beyond.dot(&other.beyond);
        if cos > 0.0 { reach.min(self.overlap * sin / cos) } else { reach }
    }
}

/// Limits on the deviation of the tip at the start and the end of each run of a toolpath, in order.
pub(super) fn near(toolpath: &Toolpath, job: &Job) -> Vec<[Near; 2]> {
    let tolerance = toolpath.tolerance;
    let strokes: Vec<Stroke> = toolpath.steps.iter().filter_map(Stroke::of_step).collect();
    let runs: Vec<&Run> = toolpath.runs().collect();
    let count = runs.len();
    let least = (LEAST * job.profile.verify.max_uncut_mm / tolerance).min(1.0);
    let near = |k: usize, (end, beside): (usize, [usize; 2])| {
        if runs[k].shape == Shape::Ring {
            return Near::default();
        }
        let own = Place::of(runs[k], end);
        let neighbours = [(k + count - 1) % count, (k + 1) % count];
        let ends = neighbours.iter().flat_map(|&other| [(other, 0), (other, 1)]).filter(|&other| other != (k, end));
        let of_runs = ends.map(|(other, end)| Place::of(runs[other], end));
        let plunges = beside.iter().filter_map(|&other| strokes[other].plunge);
        let of_plunges = plunges.flat_map(|cut| [0, 1].map(|end| Place::of_plunge(cut, end)));
        let met = of_runs.chain(of_plunges).filter(|other| other.at == own.at);
        met.fold(Near::default(), |near, other| {
            let beside = own.beside(&other);
            if beside >= tolerance {
                return near;
            }
            let length = own.overlap + other.overlap + STRETCH * tolerance;
            Near { length: length.max(near.length), share: (beside / tolerance).max(least).min(near.share) }
        })
    };
    // Along a stretch that two strokes share, neither crosses the other.
    let shared = |before: usize, behind: usize| {
        let length = shared(strokes[before], strokes[behind])?.length;
        Some(Near { length: length + STRETCH * tolerance, share: least })
    };
    let all = strokes.len();
    let ends = |(k, i): (usize, usize)| {
        let beside = [(i + all - 1) % all, (i + 1) % all];
        let [start, end] = [shared(beside[0], i), shared(i, beside[1])];
        [start.unwrap_or_else(|| near(k, (0, beside))), end.unwrap_or_else(|| near(k, (1, beside)))]
    };
    let of_runs = (0..all).filter(|&i| strokes[i].run.is_some());
    (0..).zip(of_runs).map(ends).collect()
}

/// Common stretch of two runs.
#[derive(Debug, Clone, Copy)]
pub(super) struct Overlap {
    /// Index of the chord of the first run on which the second run starts.
    pub(super) chord: usize,
    /// Length of the stretch, mm.
    pub(super) length: f64,
}

/// The common stretch of the end of a run and the start of another; `None` where the second run does not continue the first.
pub(super) fn overlap(before: &Run, behind: &Run) -> Option<Overlap> {
    shared(Stroke::of(before), Stroke::of(behind))
}

/// The common stretch of the end of a stroke and the start of another.
fn shared(before: Stroke, behind: Stroke) -> Option<Overlap> {
    let is_lifted = |end: End| end.bare && end.side == Side::Contour;
    let is_open = |run: Option<&Run>| run.is_none_or(|run| run.shape == Shape::Open);
    let runs = before.run.zip(behind.run);
    let are_alike = is_open(before.run)
        && is_open(behind.run)
        && [before.turned, behind.turned] == [false; 2]
        && before.run.is_none_or(|run| run.front == 0.0)
        && behind.run.is_none_or(|run| run.heel == 0.0)
        && runs.is_none_or(|(before, behind)| before.orientation == behind.orientation);
    if !are_alike || !is_lifted(before.ends[1]) || !is_lifted(behind.ends[0]) {
        return None;
    }
    let (points, first) = (before.points, behind.points[0]);
    let mut length = 0.0;
    for chord in (0..points.len() - 1).rev() {
        let [from, to] = [points[chord], points[chord + 1]];
        if polyline::distance_to_segment(first, from, to) <= SAME_EPSILON {
            length += (to - first).norm();
            let is_along = length > SAME_EPSILON && goes_along(&points[chord + 1..], behind.points);
            return is_along.then_some(Overlap { chord, length });
        }
        length += (to - from).norm();
    }
    None
}

/// True if the vertices at the end of a stroke are those after the first vertex of another stroke. The last vertex may lie
/// inside a chord of the other stroke, which must continue beyond it.
fn goes_along(end: &[Point], start: &[Point]) -> bool {
    let (last, inner) = end.split_last().expect("a chord has an end");
    start.len() > end.len()
        && (start[start.len() - 1] - last).norm() > SAME_EPSILON
        && inner.iter().zip(&start[1..]).all(|(a, b)| (a - b).norm() <= SAME_EPSILON)
        && polyline::distance_to_segment(*last, start[end.len() - 1], start[end.len()]) <= SAME_EPSILON
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::Rotation;
    use crate::ir::list::Joint;
    use crate::ir::toolpath::{Edge, OrientationMode, Pose};
    use crate::source::Span;

    fn run(points: [Point; 2], [heel, front]: [f64; 2]) -> Run {
        let pose = Pose { centre: points[0], c: Rotation(0.0) };
        Run {
            points: points.to_vec(),
            spans: vec![Span::default()],
            joints: vec![Joint::default(); 2],
            shape: Shape::Open,
            orientation: OrientationMode::Tangent,
            front,
            heel,
            feeds: vec![f64::INFINITY],
            junctions: Vec::new(),
            ends: [End::default(); 2],
            turned: false,
            edge: Edge::Front,
            start: pose,
            end: pose,
        }
    }

    #[test]
    fn ends_keep_near_where_overlaps_are_short_or_lines_go_on() {
        let contour = |turn: f64, [front, heel]: [f64; 2]| {
            let corner = Point::new(50.0, 0.0);
            let (sin, cos) = turn.to_radians().sin_cos();
            let before = run([Point::origin(), corner], [1.0, front]);
            let behind = run([corner, corner + Vector::new(cos, sin) * 40.0], [heel, 1.0]);
            let steps = [before, behind].map(Step::Run).to_vec();
            let toolpath = Toolpath { steps, tolerance: 0.05, ..Toolpath::default() };
            let [[far, front], [heel, end]] = near(&toolpath, &Job::default())[..] else { panic!() };
            assert_eq!([far, end], [Near::default(); 2]);
            [front, heel].map(|near| [near.length, near.share].map(|value| (value * 1e6).round() / 1e6))
        };
        assert_eq!(contour(90.0, [0.5, 0.8]), [[0.0, 1.0]; 2]);
        // The tip of each run deviates by at most the overlap of the other.
        assert_eq!(contour(90.0, [0.03, 0.8]), [[0.0, 1.0], [0.93, 0.6]]);
        assert_eq!(contour(30.0, [0.05, 0.05]), [[0.2, 0.5]; 2]);
        assert_eq!(contour(0.0, [3.0, 3.0]), [[6.1, 0.09]; 2]);
        assert_eq!(contour(170.0, [0.0, 3.0]), [[3.1, 0.09]; 2]);
        // At a needle both overlaps lead the same way, so the shorter one counts.
        assert_eq!(contour(178.0, [0.8, 4.5]), [[5.4, 0.558_732], [5.4, 0.558_392]]);
    }
}
