//! Pass `down`: no run is longer than the knife may stay down.
//!
//! Needs runs split at corners. Leaves none that with its overlaps is longer than `knife.max_down_mm`, when that is set: a
//! longer one is lifted after equal parts and rejoined with the overlaps of a corner, which here lie along the contour.

use super::pass::ToolpathPass;
use super::runs;
use super::scene::Scene;
use super::stretch::{REJOINED, Way};
use crate::analysis::cloth::Surroundings;
use crate::analysis::plunge::Deviation;
use crate::diagnostic::Diagnostics;
use crate::ir::toolpath::{Run, Toolpath};

pub(super) const PASS: ToolpathPass =
    ToolpathPass { name: "down", about: "lifts runs that are longer than knife.max_down_mm", run, chained: false };

/// Least length of a part, in what it would be if all were alike.
const SHARE_MIN: f64 = 0.5;
/// How far behind a place it is looked whether the blade can plunge there, in widths of it.
const LOOK: f64 = 3.0;

fn run(toolpath: &mut Toolpath, scene: &Scene, _: &mut Diagnostics) {
    let Some(longest) = scene.job.profile.knife.longest_cut() else { return };
    let around = scene.around(toolpath);
    runs::replace(toolpath, |run| split(run, longest, &around));
}

/// Parts of a run, as few as keep below `longest`, each led on along the contour by the overlaps of a corner. They are
/// as long as each other but for what lets the next one begin where the run is straight.
fn split(run: Run, longest: f64, around: &Surroundings) -> Vec<Run> {
    let knife = around.knife;
    let way = Way::new(&run);
    let length = way.length();
    let (heel, front) = (knife.corner_heel_overlap_mm, knife.corner_front_overlap_mm);
    if length <= longest {
        return vec![run];
    }
    let mut parts: Vec<Run> = Vec::new();
    let lead = |station: f64| way.lead(station, knife);
    let spans = [heel + front, knife.width_mm];
    // Where the blade cannot enter, the first stretch would be a cut of its own over what is cut already. Over one bend of a
    // curve it lies straight, and beside it the smoothed curve bulges away.
    let enters = |place: f64, is_good: fn(&Deviation) -> bool| {
        let next = way.part(place - lead(place)[0], place + LOOK * knife.width_mm, [REJOINED; 2]);
        Deviation::of(&next, around).is_none_or(|deviation| is_good(&deviation))
    };
    let goods: [fn(&Deviation) -> bool; 2] =
        [|deviation| deviation.fits && deviation.is_curve, |deviation| deviation.fits];
    let entered = |range| goods.into_iter().find_map(|good| way.gentlest(range, spans, |place| enters(place, good)));
    // A ring begins where the file has it, or behind that.
    let begins_elsewhere = way.is_ring() && !enters(0.0, goods[0]);
    let start = if begins_elsewhere { entered([0.0, length / (length / longest).ceil()]) } else { None };
    let start = start.unwrap_or(0.0);
    let end = start + length;
    let mut at = start;
    loop {
        let is_start = parts.is_empty() && !way.is_ring();
        let (from, first) = if is_start { (0.0, run.ends[0]) } else { (at - lead(at)[0], REJOINED) };
        let rest = end - at;
        let count = (rest / longest).ceil();
        if count <= 1.0 {
            let (last, ends) = if way.is_ring() { (end + front, REJOINED) } else { (end, run.ends[1]) };
            parts.push(way.part(from, last, [first, ends]));
            return parts;
        }
        // At the least as long as leaves the rest no part more, and half of what is alike; at the most what is alike.
        let least = (rest - (count - 1.0) * longest).max(SHARE_MIN * rest / count);
        let range = [at + least.min(rest / count), at + rest / count];
        // Rather a part more than one that the blade cannot enter.
        let to = entered(range).or_else(|| entered([at + SHARE_MIN * rest / count, range[1]]));
        let to = to.or_else(|| way.gentlest(range, spans, |_| true)).unwrap_or(range[1]);
        parts.push(way.part(from, to + lead(to)[1], [first, REJOINED]));
        at = to;
    }
}
