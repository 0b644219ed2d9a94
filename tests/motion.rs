//! What planning promises: certified samples, near time-optimal, inside the tube.

mod support;

use cutc::geom::Point;
use cutc::ir::list::Joint;
use cutc::ir::toolpath::{End, Law, Pose, Run, Shape, Step, Toolpath};
use cutc::machine::{Fit, Job};
use cutc::plan;
use cutc::source::Span;

/// Knife a point, no overlaps, no feed cap, tolerance 0.05 mm.
fn score_job(fit: Fit) -> Job {
    let mut job = Job::default();
    job.profile.knife.width_mm = 0.0;
    job.profile.knife.feed_mm_s = None;
    job.profile.path.fit = fit;
    job
}

fn toolpath(points: Vec<Point>, feed: f64) -> Toolpath {
    let run = Run {
        spans: vec![Span::default(); points.len() - 1],
        joints: vec![Joint::default(); points.len()],
        points,
        shape: Shape::Open,
        law: Law::Tangent,
        front: 0.0,
        heel: 0.0,
        feed,
        ends: [End::default(); 2],
        start: Pose::default(),
        end: Pose::default(),
    };
    Toolpath { piece: 1, tolerance: 0.05, entry: Pose::default(), steps: vec![Step::Run(run)] }
}

fn duration(points: Vec<Point>, fit: Fit) -> f64 {
    let cuts = plan::solve(&toolpath(points, f64::INFINITY), &score_job(fit)).expect("a motion");
    cuts[0].duration
}

#[test]
fn the_four_contours_come_near_their_references() {
    for (name, reference) in
        [("contour2m_flat", 2.2276), ("sleeve_flat", 0.7023), ("circle64_flat", 0.4051), ("rrect5_flat", 1.5324)]
    {
        let time = duration(support::contour(name), Fit::Polygon);
        assert!(time <= 1.01 * reference, "{name}: {time:.4} s against {reference} s");
    }
}

#[test]
fn a_straight_line_takes_its_analytic_time() {
    let time = duration(vec![Point::new(0.0, 0.0), Point::new(500.0, 0.0)], Fit::Polygon);
    assert!((time - 0.606_67).abs() < 2e-4 * 0.606_67);
}
