//! Pass `entry`: splits where a plunged blade would leave the path.
//!
//! Needs runs split at corners. Leaves runs on which the blade, plunged as a chord at the start, lies as near to the
//! path as to an arc that turns as much under it (w^2 k / 8 when it turns little, k its curvature), and not across it.
//! A sharper bend that near to a start, though no corner, is cut as one: up to it, and on from it, without overlaps,
//! because they would leave the path.

use super::pass::ToolpathPass;
use super::runs;
use super::scene::Scene;
use super::stretch::{REJOINED, between};
use crate::analysis::cloth::Surroundings;
use crate::analysis::plunge::Deviation;
use crate::diagnostic::Diagnostics;
use crate::ir::toolpath::{Run, Shape, Toolpath};

pub(super) const PASS: ToolpathPass = ToolpathPass {
    name: "entry",
    about: "splits runs at bends that a plunged blade cannot follow",
    run,
    chained: false,
};

fn run(toolpath: &mut Toolpath, scene: &Scene, _: &mut Diagnostics) {
    let around = scene.around(toolpath);
    if around.knife.width_mm == 0.0 {
        return;
    }
    runs::replace(toolpath, |run| split(run, &around));
}

/// The parts of a run that the blade can enter. What lies before a bend is looked at anew: the blade that went over the bend
/// lies otherwise over that alone.
pub(super) fn split(run: Run, around: &Surroundings) -> Vec<Run> {
    let Some(bend) = bend(&run, around) else { return vec![run] };
    let ([start, end], last) = (run.ends, run.points.len() - 1);
    let before = between(&run, [0, bend], [start, REJOINED]);
    let behind = between(&run, [bend, last], [REJOINED, end]);
    [before, behind].into_iter().flat_map(|part| split(part, around)).collect()
}

/// The first point at which an open run must be split so that the blade can enter it; `None` when it can.
fn bend(run: &Run, around: &Surroundings) -> Option<usize> {
    let deviation = if run.shape == Shape::Open { Deviation::of(run, around)? } else { return None };
    (!deviation.fits && !deviation.is_curve).then_some(deviation.vertex)
}
