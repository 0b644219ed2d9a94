//! Pass `bend`: lifts the knife where the heel would swing out by more than `knife.max_swing_mm`.
//!
//! Needs runs split at corners, including single vertices that turn too far for that key. Leaves runs that are lifted on a
//! curve before the heel swings out too far, and plunged again with the heel overlap of a corner, which here lies along the
//! contour. There is no front overlap: the heel would swing out behind the bend.

use super::pass::ToolpathPass;
use super::runs;
use super::scene::Scene;
use super::stretch::{REJOINED, Way};
use crate::analysis::swing::bends;
use crate::diagnostic::Diagnostics;
use crate::geom::polyline;
use crate::ir::toolpath::{Run, Toolpath};
use crate::machine::Knife;

pub(super) const PASS: ToolpathPass = ToolpathPass {
    name: "bend",
    about: "lifts runs behind whose bends the heel would leave the line by more than knife.max_swing_mm",
    run,
    chained: false,
};

fn run(toolpath: &mut Toolpath, scene: &Scene, _: &mut Diagnostics) {
    runs::replace(toolpath, |run| split(run, &scene.job.profile.knife));
}

/// Splits a run at its lifts.
pub(super) fn split(run: Run, knife: &Knife) -> Vec<Run> {
    let found = bends(&run, knife);
    let Some(&first) = found.first() else { return vec![run] };
    let way = Way::new(&run);
    // A ring with a bend becomes an open run that starts at its first bend.
    let (from, ends, lifts) = if way.is_ring() {
        let from = way.station(first.cast_signed());
        let open = way.part(from, from + way.length(), [REJOINED; 2]);
        let along = polyline::stations(&open.points);
        (from, [REJOINED; 2], bends(&open, knife).into_iter().map(|bend| from + along[bend]).collect())
    } else {
        (0.0, run.ends, found.into_iter().map(|bend| way.station(bend.cast_signed())).collect::<Vec<f64>>())
    };
    let stations: Vec<f64> = std::iter::once(from).chain(lifts).chain([from + way.length()]).collect();
    let last = stations.len() - 2;
    let part = |i: usize| {
        let start = if i == 0 { ends[0] } else { REJOINED };
        let end = if i == last { ends[1] } else { REJOINED };
        way.part(stations[i] - way.lead(stations[i], knife)[0], stations[i + 1], [start, end])
    };
    (0..=last).map(part).collect()
}
