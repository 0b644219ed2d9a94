//! Pass `down`: no run is longer than the knife may stay down.
//!
//! Needs runs split at corners. Leaves none that with its overlaps is longer than `knife.max_down_mm`, when that is set: a
//! longer one is lifted after equal parts and rejoined with the overlaps of a corner, which here lie along the contour.

use super::pass::ToolpathPass;
use super::runs;
use super::scene::Scene;
use super::stretch::{REJOINED, Way};
use crate::diagnostic::Diagnostics;
use crate::ir::toolpath::{Run, Toolpath};
use crate::machine::Knife;

pub(super) const PASS: ToolpathPass =
    ToolpathPass { name: "down", about: "lifts runs that are longer than knife.max_down_mm", run, chained: false };

/// Least length of a part, in what it would be if all were alike.
const SHARE_MIN: f64 = 0.5;

fn run(toolpath: &mut Toolpath, scene: &Scene, _: &mut Diagnostics) {
    let knife = &scene.job.profile.knife;
    let Some(longest) = knife.longest_cut() else { return };
    runs::replace(toolpath, |run| split(run, longest, knife));
}

/// Parts of a run, as few as keep below `longest`, each led on along the contour by the overlaps of a corner. They are
/// as long as each other but for what lets the next one begin where the run is straight.
fn split(run: Run, longest: f64, knife: &Knife) -> Vec<Run> {
    let way = Way::new(&run);
    let length = way.length();
    let (heel, front) = (knife.corner_heel_overlap_mm, knife.corner_front_overlap_mm);
    let last = if way.is_ring() { length + front } else { length };
    if length <= longest {
        return vec![run];
    }
    let mut parts: Vec<Run> = Vec::new();
    let mut at = 0.0;
    let lead =
        |station: f64| if way.leads_on(station, [heel + front, knife.width_mm]) { [heel, front] } else { [0.0; 2] };
    loop {
        let is_start = parts.is_empty() && !way.is_ring();
        let (from, first) = if is_start { (0.0, run.ends[0]) } else { (at - lead(at)[0], REJOINED) };
        let rest = length - at;
        let count = (rest / longest).ceil();
        if count <= 1.0 {
            let end = if way.is_ring() { REJOINED } else { run.ends[1] };
            parts.push(way.part(from, last, [first, end]));
            return parts;
        }
        // At the least as long as leaves the rest no part more, and half of what is alike; at the most what is alike.
        let least = (rest - (count - 1.0) * longest).max(SHARE_MIN * rest / count);
        let to = way.gentlest([at + least.min(rest / count), at + rest / count], [heel + front, knife.width_mm]);
        parts.push(way.part(from, to + lead(to)[1], [first, REJOINED]));
        at = to;
    }
}
