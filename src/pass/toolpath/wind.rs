//! Pass `wind`: a run that winds C past `c.range_deg` is lifted where it would, and goes on with C unwound in the air.
//!
//! Needs runs split at corners. Leaves runs that can be cut at one equivalent of C inside the range; as few of them as that
//! takes. A smooth contour that can be cut in one from another place on begins there. Of any other run each part is led on
//! along the contour by the overlaps of a corner. A hole that is too narrow to be parted is left as it is, for `place` to
//! refuse.

use super::lap::{Lap, SLIM_MARGIN, Winding};
use super::pass::ToolpathPass;
use super::scene::Scene;
use super::stretch::{REJOINED, Way};
use crate::diagnostic::Diagnostics;
use crate::geom::Extent;
use crate::ir::toolpath::{Run, Shape, Step, Toolpath};
use crate::machine::Knife;

pub(super) const PASS: ToolpathPass = ToolpathPass {
    name: "wind",
    about: "lifts runs that wind C past its range, to unwind in the air",
    run,
    chained: false,
};

/// How far C stays away from the ends of its range where a run is parted, rad (5 degrees): smoothing turns the blade a
/// little beyond the direction of its last chord. A range that is too narrow for that is used up to its ends.
pub(super) const MARGIN: f64 = 0.087_266_462_599_716_47;
/// In widths of the blade, what is too short for a part of its own.
const SHORT: f64 = 3.0;
/// In widths of the blade, what is too narrow a contour to be parted.
const NARROW: f64 = 1.9;
/// Rounding of a station, mm.
const STATION_EPSILON: f64 = 1e-9;

fn run(toolpath: &mut Toolpath, scene: &Scene, _: &mut Diagnostics) {
    let Some(range) = scene.job.profile.blade_range() else { return };
    for step in std::mem::take(&mut toolpath.steps) {
        match step {
            Step::Run(run) => match parts(&run, range, &scene.job.profile.knife) {
                Some(parts) => toolpath.steps.extend(parts.into_iter().map(Step::Run)),
                None => toolpath.steps.push(Step::Run(run)),
            },
            Step::Stab(_) | Step::Turn(_) | Step::Travel(_) | Step::Drill(_) | Step::Event(_) => {
                toolpath.steps.push(step);
            }
        }
    }
}

/// The parts of a run that winds; `None` when it need not be parted, or cannot.
fn parts(run: &Run, range: [f64; 2], knife: &Knife) -> Option<Vec<Run>> {
    let way = Way::new(run);
    let winding = Winding::new(run, &way, knife);
    let (chords, length) = (way.chords().cast_signed(), way.length());
    let [least, greatest] = range;
    let inner = [least + MARGIN, greatest - MARGIN];
    let lap = Lap { way: &way, winding: &winding, knife, law: run.law };
    let is_in_one = if way.is_ring() { lap.fits(0.0, inner) } else { winding.reach(0, chords, inner) == Some(chords) };
    if chords == 1 || is_in_one {
        return None;
    }
    if way.is_ring() {
        let start = |margin: f64| lap.start([least + margin, greatest - margin]);
        if let Some(from) = start(MARGIN).or_else(|| start(SLIM_MARGIN)) {
            let mut ring = Run { shape: Shape::Ring, ..way.part(from, from + way.length(), run.ends) };
            let last = ring.points.len() - 1;
            ring.points[last] = ring.points[0];
            return Some(vec![ring]);
        }
        // Parts of what is hardly wider than the blade could only be plunges, across the part around it.
        let (width, height) = Extent::of(&run.points).size();
        if width.max(height) < NARROW * knife.width_mm {
            return None;
        }
    }
    let (heel, front) = (knife.corner_heel_overlap_mm, knife.corner_front_overlap_mm);
    // A ring begins where C is amid its range, so that no part of it is short.
    let (mut from, last, ends) = if way.is_ring() {
        let from = way.station(winding.amid(range));
        (from, from + heel + length + front, [REJOINED; 2])
    } else {
        (0.0, length, run.ends)
    };
    let mut parts = Vec::new();
    let end = way.chord_at(last - STATION_EPSILON) + 1;
    let reach = |from: f64| {
        let first = way.chord_at(from);
        winding.reach(first, end, inner).or_else(|| winding.reach(first, end, range))
    };
    loop {
        let reached = reach(from)?;
        let start = if parts.is_empty() { ends[0] } else { REJOINED };
        if reached >= end {
            parts.push(way.part(from, last, [start, ends[1]]));
            return Some(parts);
        }
        // A rest that the blade hardly fits on is cut better with half of what is before it.
        let half = way.station(way.chord_at(f64::midpoint(from, last)));
        let is_short = last - way.station(reached) < SHORT * knife.width_mm;
        let rest = |to: f64| reach(to - front - heel);
        let halves = is_short && half > from + front + heel && rest(half) == Some(end);
        let stop = if halves { half } else { way.station(reached) };
        // Amid a curve the blade would plunge beside it: better somewhere on the second half of the part that is straight.
        let gentle = way.gentlest([f64::midpoint(from, stop), stop], [heel + front, knife.width_mm]);
        // Over a bend no overlap can lead on along the contour.
        let is_gentle = way.leads_on(gentle, [heel + front, knife.width_mm]);
        let overlapped = if is_gentle { (gentle - front - heel).max(from) } else { gentle };
        // From where C must unwind on it goes farther, with another equivalent; from before that it may be no farther than here.
        let goes_on = |next: f64| reach(next).is_some_and(|to| to >= end || way.station(to) > stop + knife.width_mm);
        let lifts = [[gentle, overlapped], [gentle; 2]];
        let [to, next] = lifts.into_iter().find(|&[_, next]| next > from && goes_on(next)).unwrap_or([stop; 2]);
        if to <= from + STATION_EPSILON {
            return None;
        }
        parts.push(way.part(from, to, [start, REJOINED]));
        from = next;
    }
}
