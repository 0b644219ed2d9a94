//! Pass `slow`: the knife slows down before it is lifted at a corner.
//!
//! Needs runs split at corners. Leaves the last `slow.before_corner_mm` of every run that ends at a corner capped at
//! `slow.before_corner_percent` of the speed that holds there, with a point where that stretch begins.

use super::pass::ToolpathPass;
use super::runs;
use super::scene::Scene;
use crate::diagnostic::Diagnostics;
use crate::geom::polyline;
use crate::ir::list::Joint;
use crate::ir::toolpath::{Run, Toolpath};

pub(super) const PASS: ToolpathPass = ToolpathPass {
    name: "slow",
    about: "slows the knife down before corners, when the profile says so",
    run,
    chained: false,
};

fn run(toolpath: &mut Toolpath, scene: &Scene, _: &mut Diagnostics) {
    let job = scene.job;
    let Some(reach) = job.profile.slow.before_corner_mm else { return };
    // A slowed cut needs something to be slower than: without any feed, what the tip can always reach.
    let [x, y, _] = job.profile.axes.limits();
    let fastest = x.speed.min(y.speed);
    let share = job.profile.slow.before_corner_percent / 100.0;
    for run in runs::each(toolpath).filter(|run| run.ends[1].corner) {
        let first = divide(run, reach);
        for feed in &mut run.feeds[first..] {
            *feed = feed.min(fastest) * share;
        }
    }
}

/// Puts a point at `reach` mm before the end of a run, and gives the first chord behind it.
fn divide(run: &mut Run, reach: f64) -> usize {
    let stations = polyline::stations(&run.points);
    let from = stations[stations.len() - 1] - reach;
    let chord = stations.partition_point(|&station| station <= from);
    if chord == 0 {
        return 0;
    }
    let (before, behind) = (run.points[chord - 1], run.points[chord]);
    let point = before + (behind - before) * ((from - stations[chord - 1]) / (stations[chord] - stations[chord - 1]));
    if point == before || point == behind {
        return chord - usize::from(point == before);
    }
    run.points.insert(chord, point);
    run.joints.insert(chord, Joint::default());
    run.spans.insert(chord, run.spans[chord - 1]);
    run.feeds.insert(chord, run.feeds[chord - 1]);
    chord
}
