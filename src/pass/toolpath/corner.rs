//! Pass `corner`: splits a contour where the blade cannot turn in the cloth.
//!
//! Needs raw runs. Leaves runs without a corner inside and with both ends described. A closed contour with corners starts at
//! the corner nearest to the start in the file; one without corners stays a ring.

use super::pass::ToolpathPass;
use super::runs;
use super::scene::Scene;
use super::stretch::between;
use crate::diagnostic::Diagnostics;
use crate::geom::corner::Corners;
use crate::geom::polyline;
use crate::ir::list::Joint;
use crate::ir::toolpath::{End, Run, Shape, Toolpath};

pub(super) const PASS: ToolpathPass = ToolpathPass {
    name: "corner",
    about: "splits contours at corners and at lifts that the file asks for",
    run,
    chained: false,
};

fn run(toolpath: &mut Toolpath, scene: &Scene, _: &mut Diagnostics) {
    let limit = Limit { angle: scene.job.profile.corner_angle(), unit: scene.unit };
    runs::replace(toolpath, |run| split(run, limit));
}

/// Criterion for a corner.
#[derive(Clone, Copy)]
struct Limit {
    /// Least turn of a corner, rad.
    angle: f64,
    /// Grid to which the points are rounded, mm; 0 = none.
    unit: f64,
}

/// Splits a run at its corners.
fn split(mut run: Run, limit: Limit) -> Vec<Run> {
    let last = run.points.len() - 1;
    let is_ring = run.shape == Shape::Ring;
    // A ring ends with its first point.
    let count = if is_ring { last } else { last + 1 };
    let Limit { angle: limit, unit } = limit;
    let places = Corners { point: |i: usize| run.points[i], count, is_ring, limit, unit };
    let is_corner = |i: usize| run.joints[i].lift || places.is_at(i);
    let mut corners: Vec<usize> = (1..last).filter(|&i| is_corner(i)).collect();
    if is_ring {
        let at_start = is_corner(0);
        if corners.is_empty() && !at_start {
            run.ends = ends([false; 2], &run.joints[..1], &run.joints[1..]);
            return vec![run];
        }
        if !at_start {
            let first = nearest_to_start(&run, &corners);
            rotate(&mut run, first);
            corners = corners.iter().filter(|&&i| i != first).map(|&i| (i + last - first) % last).collect();
            corners.sort_unstable();
        }
        run.shape = Shape::Open;
    }
    let mut runs = Vec::with_capacity(corners.len() + 1);
    // First joint since the last plunge: the codes of joints take effect at the next plunge.
    let (mut asked, mut from) = (0, 0);
    for to in corners.into_iter().chain([last]) {
        let ends = ends([from > 0, to < last], &run.joints[asked..=from], &run.joints[from + 1..=to]);
        runs.push(between(&run, [from, to], ends));
        (asked, from) = (from + 1, to);
    }
    runs
}

/// Corner nearest to the start of the contour, measured along it; the first of two at the same distance.
fn nearest_to_start(run: &Run, corners: &[usize]) -> usize {
    let stations = polyline::stations(&run.points);
    let length = stations[stations.len() - 1];
    let away = |i: usize| stations[i].min(length - stations[i]);
    corners.iter().copied().min_by(|&a, &b| away(a).total_cmp(&away(b))).expect("a ring with corners has one")
}

/// Makes a closed run start at its point `first`.
fn rotate(run: &mut Run, first: usize) {
    run.points.pop();
    run.joints.pop();
    run.points.rotate_left(first);
    run.joints.rotate_left(first);
    run.spans.rotate_left(first);
    run.feeds.rotate_left(first);
    run.points.push(run.points[0]);
    run.joints.push(run.joints[0]);
}

/// Ends of a run. `corner` tells which of them lie inside a contour. A code takes effect at the next plunge or lift: `before`
/// are the joints from the plunge of the previous run to the plunge of this one, `along` the joints from there to its lift.
fn ends(corner: [bool; 2], before: &[Joint], along: &[Joint]) -> [End; 2] {
    let bare = [before.iter().any(|joint| joint.full_advance), along.iter().any(|joint| joint.no_overcut)];
    [0, 1].map(|i| End { corner: corner[i], bare: bare[i], ..End::default() })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::Point;
    use crate::ir::toolpath::{Edge, OrientationMode, Pose};
    use crate::source::Span;

    const LIMIT: Limit = Limit { angle: 0.8, unit: 0.0 };

    fn ring(coordinates: &[(f64, f64)]) -> Run {
        let mut points: Vec<Point> = coordinates.iter().map(|&(x, y)| Point::new(x, y)).collect();
        points.push(points[0]);
        Run {
            spans: (0..coordinates.len() as u32).map(|block| Span { block, ..Span::default() }).collect(),
            joints: vec![Joint::default(); points.len()],
            points,
            shape: Shape::Ring,
            orientation: OrientationMode::Tangent,
            front: 0.0,
            heel: 0.0,
            feeds: vec![1.0; coordinates.len()],
            junctions: Vec::new(),
            ends: [End::default(); 2],
            turned: false,
            edge: Edge::Front,
            start: Pose::default(),
            end: Pose::default(),
        }
    }

    #[test]
    fn a_closed_contour_starts_at_the_corner_nearest_to_its_start() {
        let square = ring(&[(2.0, 0.0), (10.0, 0.0), (10.0, 10.0), (0.0, 10.0), (0.0, 0.0)]);
        let runs = split(square, LIMIT);
        assert_eq!(runs.len(), 4);
        assert_eq!(runs[0].points, [Point::new(0.0, 0.0), Point::new(2.0, 0.0), Point::new(10.0, 0.0)]);
        assert_eq!(runs[0].spans.iter().map(|s| s.block).collect::<Vec<_>>(), [4, 0]);
        assert_eq!(runs[3].points[1], Point::new(0.0, 0.0));
        assert_eq!(
            runs.iter().map(|r| (r.ends[0].corner, r.ends[1].corner)).collect::<Vec<_>>(),
            [(false, true), (true, true), (true, true), (true, false)]
        );
    }

    #[test]
    fn a_smooth_closed_contour_stays_whole() {
        let circle: Vec<(f64, f64)> = (0..20).map(|i| f64::from(i) * 0.314_159).map(|a| (a.cos(), a.sin())).collect();
        let runs = split(ring(&circle), LIMIT);
        assert_eq!((runs.len(), runs[0].shape), (1, Shape::Ring));
    }

    #[test]
    fn a_code_acts_at_the_next_plunge_or_lift() {
        let mut square = ring(&[(0.0, 0.0), (5.0, 0.0), (10.0, 0.0), (10.0, 10.0), (0.0, 10.0)]);
        square.joints[1] = Joint { lift: false, full_advance: true, no_overcut: true };
        let bare: Vec<[bool; 2]> = split(square, LIMIT).iter().map(|r| r.ends.map(|e| e.bare)).collect();
        assert_eq!(bare, [[false, true], [true, false], [false, false], [false, false]]);
    }
}
