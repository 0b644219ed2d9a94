//! Pass `entry`: splits where a plunged blade would leave the path.
//!
//! Needs runs split at corners. Leaves runs on which the blade, plunged as a chord at the start, lies as near to the path as
//! to an arc that turns as much under it (w^2 k / 8 when it turns little, k its curvature), and not across it. A sharper bend
//! that near to a start, though no corner, is cut as one: up to it, and on from it, without overlaps, because they would
//! leave the path.

use super::chord::stands_across;
use super::scene::{Around, Scene};
use super::{ToolpathPass, overlap};
use crate::diagnostic::Diagnostics;
use crate::geom::polyline;
use crate::ir::toolpath::{End, Run, Shape, Side, Step, Toolpath};

pub(super) const PASS: ToolpathPass = ToolpathPass {
    name: "entry",
    about: "splits runs at bends that a plunged blade cannot follow",
    run,
    chained: false,
};

/// Part of the tolerance that the polyline may take here; smoothing moves the tip by up to the rest.
const SHARE: f64 = 0.45;
/// What a bend is cut as.
const BEND: End = End { corner: true, bare: true, side: Side::Waste };

fn run(toolpath: &mut Toolpath, scene: &Scene, _: &mut Diagnostics) {
    let around = scene.around(toolpath);
    if around.knife().width_mm == 0.0 {
        return;
    }
    let allowance = SHARE * toolpath.tolerance;
    for step in std::mem::take(&mut toolpath.steps) {
        match step {
            Step::Run(mut run) if run.shape == Shape::Open => {
                while let Some(bend) = bend(&run, &around, allowance) {
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
fn bend(run: &Run, around: &Around, allowance: f64) -> Option<usize> {
    let mut run = run.clone();
    overlap::give(&mut run, around);
    let knife = around.knife();
    let path = run.extended();
    let skipped = usize::from(run.heel > 0.0);
    let (tip, chord) =
        polyline::first_at_distance(&path, knife.width_mm).unwrap_or((path[path.len() - 1], path.len() - 2));
    // The chord that is being left counts, too: a curve turns along its chords, not at its vertices.
    let under = path.windows(3).take(chord + 1);
    let turned: f64 = under.map(|w| polyline::turn_at(w[0], w[1], w[2]).abs()).sum();
    let blade = tip - path[0];
    let is_across = polyline::direction(path[0], path[1]).is_some_and(|first| stands_across(blade, first));
    let bow = if is_across { 0.0 } else { polyline::sagitta(blade.norm(), turned) };
    let allowed = bow + allowance;
    let away = |i: usize| polyline::distance_to_segment(path[i], path[0], tip);
    let inner = (skipped + 1..=chord).filter(|&i| i - skipped + 1 < run.points.len());
    let worst = inner.max_by(|&a, &b| away(a).total_cmp(&away(b)))?;
    (away(worst) > allowed).then(|| worst - skipped)
}

/// A run up to a point, and from there on.
fn split(run: &Run, at: usize) -> (Run, Run) {
    let [start, end] = run.ends;
    let before = Run {
        points: run.points[..=at].to_vec(),
        spans: run.spans[..at].to_vec(),
        joints: run.joints[..=at].to_vec(),
        feeds: run.feeds[..at].to_vec(),
        ends: [start, BEND],
        ..*run
    };
    let behind = Run {
        points: run.points[at..].to_vec(),
        spans: run.spans[at..].to_vec(),
        joints: run.joints[at..].to_vec(),
        feeds: run.feeds[at..].to_vec(),
        ends: [BEND, end],
        ..*run
    };
    (before, behind)
}
