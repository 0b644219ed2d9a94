//! Pass `slow`: slows the knife down beside another part's edge, and before a lift at a corner.
//!
//! Needs runs split at corners, on their lines. Caps near lines at `knife.near_percent` of their speed, and the last
//! `slow.before_corner_mm` of every run that ends at a corner at `slow.before_corner_percent` of it. Inserts points at the ends
//! of these stretches.

use super::pass::ToolpathPass;
use super::runs;
use super::scene::Scene;
use crate::diagnostic::Diagnostics;
use crate::geom::polyline;
use crate::ir::list::Joint;
use crate::ir::toolpath::{Run, Toolpath};

/// Distance within which two places of a run are the same, mm: rounding.
const SAME: f64 = 1e-6;

pub(super) const PASS: ToolpathPass = ToolpathPass {
    name: "slow",
    about: "slows the knife down along thin strips and before corners, when the profile says so",
    run,
    chained: false,
};

fn run(toolpath: &mut Toolpath, scene: &Scene, _: &mut Diagnostics) {
    let job = scene.job;
    // A share needs a speed to refer to: without a feed that is the speed which the tip can always reach.
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

/// Inserts a point at a station of a run, mm, and returns the index of the first chord behind it.
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
