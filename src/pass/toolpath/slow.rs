//! Pass `slow`: the knife slows down beside another part's edge, and before it is lifted at a corner.
//!
//! Needs runs split at corners, on their lines. Leaves near lines capped at `knife.near_percent` of the speed that holds
//! there, and the last `slow.before_corner_mm` of every run that ends at a corner at `slow.before_corner_percent` of that,
//! with points where these stretches begin and end.

use super::pass::ToolpathPass;
use super::runs;
use super::scene::Scene;
use crate::diagnostic::Diagnostics;
use crate::geom::polyline;
use crate::ir::list::Joint;
use crate::ir::toolpath::{Run, Toolpath};

/// Places of a run that are nearer to each other are one, mm: rounding.
const SAME: f64 = 1e-6;

pub(super) const PASS: ToolpathPass = ToolpathPass {
    name: "slow",
    about: "slows the knife down along thin strips and before corners, when the profile says so",
    run,
    chained: false,
};

fn run(toolpath: &mut Toolpath, scene: &Scene, _: &mut Diagnostics) {
    let job = scene.job;
    // A slowed cut needs something to be slower than: without any feed, what the tip can always reach.
    let [x, y, _] = job.profile.axes.limits();
    let fastest = x.speed.min(y.speed);
    if let Some(share) = job.profile.knife.near_share() {
        let piece = toolpath.part;
        for run in runs::each(toolpath) {
            for ends in scene.near.along(piece, &run.points) {
                let [first, last] = ends.map(|station| divide(run, station));
                for feed in &mut run.feeds[first..last] {
                    *feed = feed.min(fastest) * share;
                }
            }
        }
    }
    let Some(reach) = job.profile.slow.before_corner_mm else { return };
    let share = job.profile.slow.before_corner_percent / 100.0;
    for run in runs::each(toolpath).filter(|run| run.ends[1].corner) {
        let first = divide(run, polyline::length(&run.points) - reach);
        for feed in &mut run.feeds[first..] {
            *feed = feed.min(fastest) * share;
        }
    }
}

/// Puts a point at a station of a run, mm, and gives the first chord behind it.
fn divide(run: &mut Run, from: f64) -> usize {
    let stations = polyline::stations(&run.points);
    let behind = stations.partition_point(|&station| station < from - SAME);
    if behind == 0 || behind == stations.len() || stations[behind] <= from + SAME {
        return behind.min(run.feeds.len());
    }
    let chord = behind - 1;
    let share = (from - stations[chord]) / (stations[behind] - stations[chord]);
    run.points.insert(behind, run.points[chord] + (run.points[behind] - run.points[chord]) * share);
    run.joints.insert(behind, Joint::default());
    run.spans.insert(behind, run.spans[chord]);
    run.feeds.insert(behind, run.feeds[chord]);
    behind
}
