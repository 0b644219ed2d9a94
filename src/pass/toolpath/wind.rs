//! Pass `wind`: a run that winds C past `c.range_deg` is lifted where it would, and goes on with C unwound in the air.
//!
//! Needs runs split at corners. Leaves runs that can be cut at one equivalent of C inside the range; as few of them as that
//! takes. Each is led on along the contour by the overlaps of a corner.

use super::ToolpathPass;
use super::scene::Scene;
use super::stretch::{REJOINED, Way};
use crate::diagnostic::Diagnostics;
use crate::geom::{Heading, polyline};
use crate::ir::toolpath::{Run, Step, Toolpath};
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
/// Rounding of an angle, rad.
const ANGLE_EPSILON: f64 = 1e-9;
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
    // Round a ring the last chord turns on to the first one.
    let whole = chords + isize::from(way.is_ring());
    let [least, greatest] = range;
    let inner = [least + MARGIN, greatest - MARGIN];
    if chords == 1 || winding.reach(0, whole, inner) == Some(whole) {
        return None;
    }
    let (heel, front) = (knife.corner_heel_overlap_mm, knife.corner_front_overlap_mm);
    let last = if way.is_ring() { length + front } else { length };
    let mut from = if way.is_ring() { -heel } else { 0.0 };
    let mut ends = run.ends;
    if way.is_ring() {
        ends = [REJOINED; 2];
    }
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
        let rest = |to: f64| winding.reach(way.chord_at(to - front - heel), end, inner);
        let halves = is_short && half > from + front + heel && rest(half) == Some(end);
        let to = if halves { half } else { way.station(reached) };
        // Amid a curve the blade would plunge beside it: better somewhere on the second half of the part that is straight.
        let to = way.gentlest([f64::midpoint(from, to), to], [heel + front, knife.width_mm]);
        if to <= from + STATION_EPSILON {
            return None;
        }
        // Over a bend at which C must unwind no overlap can lead on along the contour.
        let overlapped = to - front - heel;
        let is_gentle = way.leads_on(to, [heel + front, knife.width_mm]);
        let leads_on =
            is_gentle && overlapped > from && reach(overlapped).is_some_and(|reached| way.station(reached) > to);
        let next = if leads_on { overlapped } else { to };
        parts.push(way.part(from, to, [start, REJOINED]));
        from = next;
    }
}

/// The directions of the chords of a run, unwrapped.
struct Winding {
    /// Of one lap, rad.
    headings: Vec<f64>,
    /// By how much a lap turns, rad.
    lap: f64,
    /// After which turn the blade cuts the same again, rad.
    period: f64,
}

impl Winding {
    fn new(run: &Run, way: &Way, knife: &Knife) -> Self {
        let mut heading = Heading::of(run.points[1] - run.points[0]).radians();
        let mut headings = vec![heading];
        headings.extend(run.points.windows(3).map(|w| {
            heading += polyline::turn_at(w[0], w[1], w[2]);
            heading
        }));
        let closing = polyline::turn_at(run.points[way.chords() - 1], run.points[0], run.points[1]);
        Self { lap: heading + closing - headings[0], headings, period: knife.period() }
    }

    /// The direction of a chord, which may be of another lap.
    fn at(&self, chord: isize) -> f64 {
        let chords = self.headings.len().cast_signed();
        self.headings[chord.rem_euclid(chords) as usize] + self.lap * chord.div_euclid(chords) as f64
    }

    /// The chord, up to `end`, before which C leaves its range, from the equivalent of chord `first` that goes on longest;
    /// `None` when not even that is in the range.
    fn reach(&self, first: isize, end: isize, [least, greatest]: [f64; 2]) -> Option<isize> {
        let heading = self.at(first);
        let low = ((least - heading) / self.period - ANGLE_EPSILON).ceil();
        let high = ((greatest - heading) / self.period + ANGLE_EPSILON).floor();
        let is_in = |c: f64| (least - ANGLE_EPSILON..=greatest + ANGLE_EPSILON).contains(&c);
        // Of all equivalents the first or the last goes on longest, unless the way swings both ways; few are legal at all.
        let turns = (0..=(high - low).max(-1.0) as isize).map(|k| (low + k as f64) * self.period);
        turns.map(|turns| (first..end).find(|&chord| !is_in(self.at(chord) + turns)).unwrap_or(end)).max()
    }
}
