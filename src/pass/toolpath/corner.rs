//! Pass `corner`: splits a contour where the blade cannot turn in the cloth.
//!
//! Needs raw runs. Leaves runs without a corner inside, each with its two ends named; a closed contour with corners
//! starts at the one nearest to the file's start, a closed contour without any stays a ring.

use super::ToolpathPass;
use super::scene::Scene;
use crate::diagnostic::Diagnostics;
use crate::geom::{angle, polyline};
use crate::ir::toolpath::{End, Run, Shape, Step, Toolpath};

pub(super) const PASS: ToolpathPass = ToolpathPass {
    name: "corner",
    about: "splits contours at corners and at lifts that the file asks for",
    run,
    chained: false,
};

fn run(toolpath: &mut Toolpath, scene: &Scene, _: &mut Diagnostics) {
    let job = scene.job;
    let angle = job.profile.corner.angle();
    let steps = std::mem::take(&mut toolpath.steps);
    for step in steps {
        match step {
            Step::Run(run) => toolpath.steps.extend(split(run, angle).into_iter().map(Step::Run)),
            Step::Stab(_) | Step::Turn(_) | Step::Travel(_) | Step::Drill(_) | Step::Event(_) => {
                toolpath.steps.push(step);
            }
        }
    }
}

/// The runs between the corners of a run.
fn split(mut run: Run, angle: f64) -> Vec<Run> {
    let last = run.points.len() - 1;
    let mut corners: Vec<usize> = (1..last).filter(|&i| is_corner(&run, i, angle)).collect();
    if run.shape == Shape::Ring {
        let at_start = is_corner(&run, 0, angle);
        if corners.is_empty() && !at_start {
            run.ends = ends(&run, [false, false], &[]);
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
    let (mut asked_from, mut from) = (0, 0);
    for &to in corners.iter().chain(std::iter::once(&last)) {
        let points = run.points[from..=to].to_vec();
        let joints = run.joints[from..=to].to_vec();
        let spans = run.spans[from..to].to_vec();
        let feeds = run.feeds[from..to].to_vec();
        let asked = &run.joints[asked_from..=from];
        let mut part = Run { points, spans, joints, feeds, ..empty_like(&run) };
        part.ends = ends(&part, [from > 0, to < last], asked);
        runs.push(part);
        (asked_from, from) = (from + 1, to);
    }
    runs
}

/// A run without points that is otherwise the same.
fn empty_like(run: &Run) -> Run {
    Run { points: Vec::new(), spans: Vec::new(), joints: Vec::new(), feeds: Vec::new(), ..*run }
}

/// Whether the knife is lifted at a point; point 0 of a ring lies between its last and its first chord.
fn is_corner(run: &Run, i: usize, angle: f64) -> bool {
    let before = if i == 0 { run.points[run.points.len() - 2] } else { run.points[i - 1] };
    run.joints[i].lift || angle::is_turned(run.points[i] - before, run.points[i + 1] - run.points[i], angle)
}

/// The corner that is least far along the contour from its start, the later one of two alike.
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

/// The ends of a run: `corner` says which of them lie inside a contour; `asked` are the joints since the plunge before
/// this one, because a code before a plunge acts at the next plunge, and one before a lift at the next lift.
fn ends(run: &Run, corner: [bool; 2], asked: &[crate::ir::list::Joint]) -> [End; 2] {
    let full_advance = run.joints[0].full_advance || asked.iter().any(|j| j.full_advance);
    let no_overcut = run.joints[1..].iter().any(|j| j.no_overcut);
    let end = |corner: bool, bare: bool| End { corner, bare, ..End::default() };
    [end(corner[0], full_advance), end(corner[1], no_overcut)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::Point;
    use crate::ir::list::Joint;
    use crate::ir::toolpath::{Edge, Law, Pose};
    use crate::source::Span;

    fn ring(coordinates: &[(f64, f64)]) -> Run {
        let mut points: Vec<Point> = coordinates.iter().map(|&(x, y)| Point::new(x, y)).collect();
        points.push(points[0]);
        Run {
            spans: (0..coordinates.len() as u32).map(|block| Span { block, ..Span::default() }).collect(),
            joints: vec![Joint::default(); points.len()],
            points,
            shape: Shape::Ring,
            law: Law::Tangent,
            front: 0.0,
            heel: 0.0,
            feeds: vec![1.0; coordinates.len()],
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
        let runs = split(square, 0.8);
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
        let runs = split(ring(&circle), 0.8);
        assert_eq!((runs.len(), runs[0].shape), (1, Shape::Ring));
    }

    #[test]
    fn a_code_acts_at_the_next_plunge_or_lift() {
        let mut square = ring(&[(0.0, 0.0), (5.0, 0.0), (10.0, 0.0), (10.0, 10.0), (0.0, 10.0)]);
        square.joints[1] = Joint { lift: false, full_advance: true, no_overcut: true };
        let bare: Vec<[bool; 2]> = split(square, 0.8).iter().map(|r| r.ends.map(|e| e.bare)).collect();
        assert_eq!(bare, [[false, true], [true, false], [false, false], [false, false]]);
    }
}
