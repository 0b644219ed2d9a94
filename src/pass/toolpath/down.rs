//! Pass `down`: limits the length of runs to what the knife may cut without a lift.
//!
//! Needs runs split at corners. If `knife.max_down_mm` is set, every run, overlaps included, stays within it: a longer run is
//! lifted after equal parts and rejoined with the overlaps of a corner, which here lie along the contour.

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

/// Least length of a part, as a share of the length that equal parts would have.
const SHARE_MIN: f64 = 0.5;
/// Distance behind a place that is checked for a plunge there, in blade widths.
const LOOK: f64 = 3.0;

fn run(toolpath: &mut Toolpath, scene: &Scene, _: &mut Diagnostics) {
    let Some(longest) = scene.job.profile.knife.longest_cut() else { return };
    let around = scene.around(toolpath);
    runs::replace(toolpath, |run| split(run, longest, &around));
}

/// Splits a run into the fewest parts that stay within `longest` mm, each extended along the contour by the overlaps of a
/// corner. The parts have equal lengths, except where a shorter one lets the next begin on a straight stretch.
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
    // Where the blade cannot enter, the first stretch would become a cut of its own over what is already cut. Over a single
    // bend of a curve the blade lies straight, and the smoothed curve bulges away from it.
    let enters = |place: f64, is_good: fn(&Deviation) -> bool| {
        let next = way.part(place - lead(place)[0], place + LOOK * knife.width_mm, [REJOINED; 2]);
        Deviation::of(&next, around).is_none_or(|deviation| is_good(&deviation))
    };
    let goods: [fn(&Deviation) -> bool; 2] =
        [|deviation| deviation.fits && deviation.is_curve, |deviation| deviation.fits];
    let entered = |range| goods.into_iter().find_map(|good| way.gentlest(range, spans, |place| enters(place, good)));
    // A ring begins where the file begins it, or further on.
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
        // A part has at most the equal length. It has at least half of that, and enough to need no additional part for the
        // rest.
        let least = (rest - (count - 1.0) * longest).max(SHARE_MIN * rest / count);
        let range = [at + least.min(rest / count), at + rest / count];
        // An additional part is better than one that the blade cannot enter.
        let to = entered(range).or_else(|| entered([at + SHARE_MIN * rest / count, range[1]]));
        let to = to.or_else(|| way.gentlest(range, spans, |_| true)).unwrap_or(range[1]);
        parts.push(way.part(from, to + lead(to)[1], [first, REJOINED]));
        at = to;
    }
}
