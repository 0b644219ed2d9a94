//! Pass `entry`: splits where a plunged blade would leave the path.
//!
//! Needs runs split at corners. Leaves runs on which the blade, plunged as a chord at the start, lies as near to the path as
//! to an arc that turns as much under it (w^2 k / 8 when it turns little, k its curvature), and not across it. A sharper bend
//! that near to a start, though no corner, is cut as one: up to it, and on from it, without overlaps, because they would
//! leave the path.

use super::ToolpathPass;
use super::bow::Bow;
use super::scene::{Around, Scene};
use super::stretch::REJOINED;
use crate::diagnostic::Diagnostics;
use crate::ir::toolpath::{Run, Shape, Step, Toolpath};

pub(super) const PASS: ToolpathPass = ToolpathPass {
    name: "entry",
    about: "splits runs at bends that a plunged blade cannot follow",
    run,
    chained: false,
};

fn run(toolpath: &mut Toolpath, scene: &Scene, _: &mut Diagnostics) {
    let around = scene.around(toolpath);
    if around.knife().width_mm == 0.0 {
        return;
    }
    for step in std::mem::take(&mut toolpath.steps) {
        match step {
            Step::Run(mut run) if run.shape == Shape::Open => {
                while let Some(bend) = bend(&run, &around) {
                    let (before, behind) = split(&run, bend);
                    toolpath.steps.push(Step::Run(before));
                    run = behind;
                }
                toolpath.steps.push(Step::Run(run));
            }
            Step::Run(_) | Step::Stab(_) | Step::Turn(_) | Step::Travel(_) | Step::Drill(_) | Step::Event(_) => {
                toolpath.steps.push(step);
            }
        }
    }
}

/// The first point at which the path must be split so that the blade can enter it; `None` when it can.
fn bend(run: &Run, around: &Around) -> Option<usize> {
    Bow::new(run, around).filter(|bow| !bow.fits && !bow.is_curve).map(|bow| bow.at)
}

/// A run up to a point, and from there on.
fn split(run: &Run, at: usize) -> (Run, Run) {
    let [start, end] = run.ends;
    let before = Run {
        points: run.points[..=at].to_vec(),
        spans: run.spans[..at].to_vec(),
        joints: run.joints[..=at].to_vec(),
        feeds: run.feeds[..at].to_vec(),
        ends: [start, REJOINED],
        ..*run
    };
    let behind = Run {
        points: run.points[at..].to_vec(),
        spans: run.spans[at..].to_vec(),
        joints: run.joints[at..].to_vec(),
        feeds: run.feeds[at..].to_vec(),
        ends: [REJOINED, end],
        ..*run
    };
    (before, behind)
}
