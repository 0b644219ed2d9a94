//! Pass `down`: no run is longer than the knife may stay down.
//!
//! Needs runs split at corners. Leaves none longer than `knife.max_down_mm`, when that is set: a longer one is lifted
//! after equal parts and rejoined as at a corner, with overlap.

use super::ToolpathPass;
use crate::diagnostic::Diagnostics;
use crate::geom::{Point, polyline};
use crate::ir::list::Joint;
use crate::ir::toolpath::{End, Run, Shape, Step, Toolpath};
use crate::machine::Job;
use crate::source::Span;

pub(super) const PASS: ToolpathPass =
    ToolpathPass { name: "down", about: "lifts runs that are longer than knife.max_down_mm", run };

fn run(toolpath: &mut Toolpath, job: &Job, _: &mut Diagnostics) {
    let Some(longest) = job.profile.knife.max_down_mm else { return };
    let steps = std::mem::take(&mut toolpath.steps);
    for step in steps {
        match step {
            Step::Run(run) => toolpath.steps.extend(split(run, longest).into_iter().map(Step::Run)),
            Step::Stab(_) | Step::Turn(_) | Step::Travel(_) | Step::Drill(_) | Step::Event(_) => {
                toolpath.steps.push(step);
            }
        }
    }
}

/// Equal parts of a run, as few as keep below `longest`.
fn split(run: Run, longest: f64) -> Vec<Run> {
    let stations = polyline::stations(&run.points);
    let length = stations[stations.len() - 1];
    let parts = (length / longest).ceil();
    if parts <= 1.0 {
        return vec![run];
    }
    let rejoined = End { corner: true, bare: false };
    let mut runs = vec![start(&run, run.points[0], run.joints[0], run.ends[0])];
    let mut current = 0;
    for (i, ends) in run.points.windows(2).enumerate() {
        loop {
            let cut = length * runs.len() as f64 / parts;
            if runs.len() as f64 >= parts || cut >= stations[i + 1] {
                break;
            }
            let share = (cut - stations[i]) / (stations[i + 1] - stations[i]);
            let point = ends[0] + (ends[1] - ends[0]) * share;
            extend(&mut runs[current], point, run.spans[i], Joint::default());
            runs[current].ends[1] = rejoined;
            runs.push(start(&run, point, Joint::default(), rejoined));
            current += 1;
        }
        extend(&mut runs[current], ends[1], run.spans[i], run.joints[i + 1]);
    }
    runs[current].ends[1] = run.ends[1];
    runs
}

/// A part of a run that has only its first point yet.
fn start(run: &Run, point: Point, joint: Joint, end: End) -> Run {
    let ends = [end, End::default()];
    Run { points: vec![point], spans: Vec::new(), joints: vec![joint], shape: Shape::Open, ends, ..*run }
}

/// Leads a part on to a point, unless it stands there.
fn extend(part: &mut Run, point: Point, span: Span, joint: Joint) {
    if part.points.last() != Some(&point) {
        part.points.push(point);
        part.spans.push(span);
        part.joints.push(joint);
    }
}
