//! Pass `turn`: reverses short cuts that lead out of the part, so that they are cut from the edge inwards.
//!
//! Needs runs split at corners. Reverses every straight run that is at most as long as a notch is deep, begins inside the part
//! and ends at its edge. The legs of V notches, of castles and of darts in a seam are then cut from the edge to the innermost
//! point, where the tip stands exactly, and the surplus of the blade lies in the waste. Both legs of a V then have nearly the
//! same heading, so that the blade turns less between them.

use super::pass::ToolpathPass;
use super::runs;
use super::scene::Scene;
use crate::analysis::cloth::Surroundings;
use crate::diagnostic::Diagnostics;
use crate::geom::polyline;
use crate::geom::region::Ray;
use crate::ir::marker::Notch;
use crate::ir::toolpath::{Run, Shape, Toolpath};

pub(super) const PASS: ToolpathPass =
    ToolpathPass { name: "turn", about: "turns short cuts round that lead out of the part", run, chained: false };

/// Distance beyond an end at which the side is tested, mm: more than rounding, less than the width of a notch.
const LOOK: f64 = 0.5;

fn run(toolpath: &mut Toolpath, scene: &Scene, _: &mut Diagnostics) {
    let around = scene.around(toolpath);
    runs::each(toolpath).filter(|run| leads_out(run, &around)).for_each(turn);
}

/// True if a run is short and straight, begins inside the part and ends at its edge.
fn leads_out(run: &Run, around: &Surroundings) -> bool {
    let (first, last) = (run.points[0], run.points[run.points.len() - 1]);
    let Some(along) = polyline::direction(first, last) else { return false };
    let is_short = run.shape == Shape::Open && (last - first).norm() <= Notch::LONGEST;
    if !is_short || around.knife.width_mm == 0.0 || !polyline::is_straight(&run.points, around.tolerance) {
        return false;
    }
    around.leads_inside(&Ray { from: first, along: -along, reach: LOOK })
        && !around.leads_inside(&Ray { from: last, along, reach: LOOK })
}

fn turn(run: &mut Run) {
    run.points.reverse();
    run.spans.reverse();
    run.joints.reverse();
    run.feeds.reverse();
    run.ends.reverse();
    run.turned = !run.turned;
}
