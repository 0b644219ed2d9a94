//! Pass `entry`: splits where a plunged blade would leave the path.
//!
//! Needs runs split at corners. On the runs it leaves, the blade that plunges as a chord at the start lies along the path, and
//! as near to it as to an arc with the same turn under the blade (w^2 k / 8 at small turns, k = curvature). A sharper bend that
//! close to a start is cut like a corner, although it is not one: up to the bend, then on from it, without overlaps, because
//! these would leave the path.

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

/// Splits a run into parts that the blade can enter. The part before a bend is checked again, because the blade lies
/// differently over it once the bend is cut off.
pub(super) fn split(run: Run, around: &Surroundings) -> Vec<Run> {
    let Some(bend) = bend(&run, around) else { return vec![run] };
    let ([start, end], last) = (run.ends, run.points.len() - 1);
    let before = between(&run, [0, bend], [start, REJOINED]);
    let behind = between(&run, [bend, last], [REJOINED, end]);
    [before, behind].into_iter().flat_map(|part| split(part, around)).collect()
}

/// First point at which an open run must be split for the blade to enter it; `None` if it need not be split.
fn bend(run: &Run, around: &Surroundings) -> Option<usize> {
    let deviation = if run.shape == Shape::Open { Deviation::of(run, around)? } else { return None };
    (!deviation.fits && !deviation.is_curve).then_some(deviation.vertex)
}
