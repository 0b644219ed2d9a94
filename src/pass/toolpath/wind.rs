//! Pass `wind`: lifts a run where it would wind C past `c.range_deg`, and continues it with C unwound in the air.
//!
//! Needs runs split at corners. Leaves the fewest runs each of which can be cut at one equivalent of C inside the range. A
//! smooth contour that can be cut without a lift from another place begins there. The parts of any other run continue along the
//! contour by the overlaps of a corner. A hole too narrow to be split is left as it is, for `place` to refuse.

use super::lap::{Lap, SLIM_MARGIN, Winding};
use super::pass::ToolpathPass;
use super::scene::Scene;
use super::stretch::{REJOINED, Way};
use crate::diagnostic::Diagnostics;
use crate::geom::Extent;
use crate::ir::toolpath::{End, Run, Step, Toolpath};
use crate::machine::Knife;

pub(super) const PASS: ToolpathPass = ToolpathPass {
    name: "wind",
    about: "lifts runs that wind C past its range, to unwind in the air",
    run,
    chained: false,
};

/// Margin of C from the ends of its range where a run is split, rad (5 degrees): smoothing turns the blade a little beyond the
/// direction of its last chord. A range too narrow for that is used up to its ends.
pub(super) const MARGIN: f64 = 0.087_266_462_599_716_47;
/// Length below which a stretch is too short for a part of its own, in blade widths.
const SHORT: f64 = 3.0;
/// Size below which a contour is too narrow to be split, in blade widths.
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
            Step::PlungeCut(_) | Step::Turn(_) | Step::Travel(_) | Step::Drill(_) | Step::Event(_) => {
                toolpath.steps.push(step);
            }
        }
    }
}

/// Parts of a run that winds; `None` if it need not or cannot be split.
fn parts(run: &Run, range: [f64; 2], knife: &Knife) -> Option<Vec<Run>> {
    let way = Way::new(run);
    let winding = Winding::new(run, &way, knife);
    let chords = way.chords().cast_signed();
    let [least, greatest] = range;
    let inner = [least + MARGIN, greatest - MARGIN];
    let lap = Lap { way: &way, winding: &winding, knife, orientation: run.orientation };
    let is_in_one = if way.is_ring() { lap.fits(0.0, inner) } else { winding.reach(0, chords, inner) == Some(chords) };
    if chords == 1 || is_in_one {
        return None;
    }
    if way.is_ring() {
        if let Some(ring) = in_one(&lap, range) {
            return Some(vec![ring]);
        }
        // Parts of a contour hardly wider than the blade could only be plunges, across the part around it.
        let (width, height) = Extent::of(&run.points).size();
        if width.max(height) < NARROW * knife.width_mm {
            return None;
        }
    }
    // A ring begins where C is in the middle of its range, so that no part is short.
    let (from, last, ends) = if way.is_ring() {
        let from = way.station(winding.amid(range));
        let last = from + knife.corner_heel_overlap_mm + way.length() + knife.corner_front_overlap_mm;
        (from, last, [REJOINED; 2])
    } else {
        (0.0, way.length(), run.ends)
    };
    let end = way.chord_at(last - STATION_EPSILON) + 1;
    Parting { way: &way, winding: &winding, knife, ranges: [inner, range], last, end }.parts(from, ends)
}

/// Ring with its start where it can be cut without a lift; `None` if there is no such place.
fn in_one(lap: &Lap, [least, greatest]: [f64; 2]) -> Option<Run> {
    let start = |margin: f64| lap.start([least + margin, greatest - margin]);
    let from = start(MARGIN).or_else(|| start(SLIM_MARGIN))?;
    Some(lap.way.ring_from(from))
}

/// Run that is being split.
struct Parting<'a> {
    way: &'a Way<'a>,
    winding: &'a Winding,
    knife: &'a Knife,
    /// Range of C less its margins, and the whole range, rad.
    ranges: [[f64; 2]; 2],
    /// Station of the final lift, mm, and the chord behind the one on which it lies.
    last: f64,
    end: isize,
}

impl Parting<'_> {
    /// Parts from a station on; `None` if C cannot continue from some place.
    fn parts(&self, from: f64, ends: [End; 2]) -> Option<Vec<Run>> {
        let (mut parts, mut from, mut start) = (Vec::new(), from, ends[0]);
        loop {
            let reached = self.reach(from)?;
            if reached >= self.end {
                parts.push(self.way.part(from, self.last, [start, ends[1]]));
                return Some(parts);
            }
            let [to, next] = self.lift(from, self.stop(from, reached));
            if to <= from + STATION_EPSILON {
                return None;
            }
            parts.push(self.way.part(from, to, [start, REJOINED]));
            (from, start) = (next, REJOINED);
        }
    }

    /// Chord before which C leaves its range, from a station on.
    fn reach(&self, from: f64) -> Option<isize> {
        let first = self.way.chord_at(from);
        self.ranges.into_iter().find_map(|range| self.winding.reach(first, self.end, range))
    }

    /// Station where a part ends, mm, when C reaches the end of its range at a chord: that chord, or half of the remaining
    /// length if the blade would hardly fit on the rest behind it.
    fn stop(&self, from: f64, reached: isize) -> f64 {
        let way = self.way;
        let half = way.station(way.chord_at(f64::midpoint(from, self.last)));
        let is_short = self.last - way.station(reached) < SHORT * self.knife.width_mm;
        let [front, heel] = self.overlaps();
        let rest = |to: f64| self.reach(to - front - heel);
        let halves = is_short && half > from + front + heel && rest(half) == Some(self.end);
        if halves { half } else { way.station(reached) }
    }

    /// Front and heel overlap of a part, mm.
    fn overlaps(&self) -> [f64; 2] {
        [self.knife.corner_front_overlap_mm, self.knife.corner_heel_overlap_mm]
    }

    /// Station of the lift on a part that extends at most to `stop`, and start station of the next part, mm.
    fn lift(&self, from: f64, stop: f64) -> [f64; 2] {
        let Self { way, knife, .. } = *self;
        let [front, heel] = self.overlaps();
        // On a curve the blade would plunge beside the line: a straight place in the second half of the part is better.
        let places = [f64::midpoint(from, stop), stop];
        let gentle = way.gentlest(places, [heel + front, knife.width_mm], |_| true).unwrap_or(stop);
        // Over a bend no overlap can continue along the contour.
        let is_gentle = way.leads_on(gentle, [heel + front, knife.width_mm]);
        let overlapped = if is_gentle { (gentle - front - heel).max(from) } else { gentle };
        // From the place where C must unwind it goes farther with another equivalent; from before that place it may not.
        let goes_on =
            |next: f64| self.reach(next).is_some_and(|to| to >= self.end || way.station(to) > stop + knife.width_mm);
        let lifts = [[gentle, overlapped], [gentle; 2]];
        lifts.into_iter().find(|&[_, next]| next > from && goes_on(next)).unwrap_or([stop; 2])
    }
}
