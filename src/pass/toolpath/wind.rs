//! Pass `wind`: a run that winds C past `c.range_deg` is lifted where it would, and goes on with C unwound in the air.
//!
//! Needs runs split at corners. Leaves runs that can be cut at one equivalent of C inside the range; as few of them as that
//! takes. A smooth contour that can be cut in one from another place on begins there. Of any other run each part is led on
//! along the contour by the overlaps of a corner. A hole that is too narrow to be parted is left as it is, for `place` to
//! refuse.

use super::ToolpathPass;
use super::scene::Scene;
use super::stretch::{REJOINED, Way};
use crate::diagnostic::Diagnostics;
use crate::geom::{Heading, polyline};
use crate::ir::toolpath::{Law, Run, Shape, Step, Toolpath};
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
/// The same for a ring that is cut in one, where there is no more room, rad (4 degrees).
const SLIM_MARGIN: f64 = 0.069_813_170_079_773_18;
/// In widths of the blade, what is too narrow a contour to be parted.
const NARROW: f64 = 1.5;
/// Turns that differ by less are alike where a ring begins, rad (2 degrees).
const TURN_STEP: f64 = 0.034_906_585_039_886_59;
/// Places of a smooth contour at which it is tried to begin, at the most: one a degree.
const STARTS: usize = 360;
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
        polyline::first_at_distance(&run.points, NARROW * knife.width_mm)?;
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

/// Once round a ring.
struct Lap<'a> {
    way: &'a Way<'a>,
    winding: &'a Winding,
    knife: &'a Knife,
    law: Law,
}

impl Lap<'_> {
    /// Whether it can be cut in one from a station on, its overlap included, with C inside a range.
    fn fits(&self, at: f64, [least, greatest]: [f64; 2]) -> bool {
        let Self { way, winding, knife, law } = self;
        // The blade plunges along the ring, or as a chord of what lies behind its tip.
        let from = match law {
            Law::Tangent => at,
            Law::Chord => at - knife.width_mm,
        };
        let to = at + way.length() + knife.front_overlap_mm;
        let inner = (way.chord_at(from) + 1..way.chord_at(to)).map(|chord| winding.at(chord));
        let ends = [from, to].map(|station| self.heading(station));
        let [low, high] = inner
            .chain(ends)
            .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], heading| [low.min(heading), high.max(heading)]);
        let turns = |angle: f64| angle / winding.period;
        (turns(least - low) - ANGLE_EPSILON).ceil() <= (turns(greatest - high) + ANGLE_EPSILON).floor()
    }

    /// The direction at a station, unwrapped: that of a chord in its middle, turning on from one to the next.
    fn heading(&self, station: f64) -> f64 {
        let Self { way, winding, .. } = self;
        let here = way.chord_at(station);
        let before = if station < self.middle(here) { here - 1 } else { here };
        let [a, b] = [before, before + 1].map(|chord| (self.middle(chord), winding.at(chord)));
        a.1 + (b.1 - a.1) * ((station - a.0) / (b.0 - a.0))
    }

    /// The station amid a chord.
    fn middle(&self, chord: isize) -> f64 {
        f64::midpoint(self.way.station(chord), self.way.station(chord + 1))
    }

    /// The station, amid a chord, from which on the ring can be cut in one, its overlap included, with C inside a range: where it
    /// turns least, and of such places the nearest to where it starts.
    fn start(&self, range: [f64; 2]) -> Option<f64> {
        let Self { way, knife, .. } = self;
        let chords = way.chords();
        let turned = |at: f64| {
            let turned = way.turned([at - knife.width_mm, at + knife.width_mm]);
            (turned / TURN_STEP).round()
        };
        let away = |at: f64| at.min(way.length() - at);
        let starts = (0..chords).step_by(chords.div_ceil(STARTS)).map(|chord| self.middle(chord.cast_signed()));
        let best = |a: &f64, b: &f64| turned(*a).total_cmp(&turned(*b)).then(away(*a).total_cmp(&away(*b)));
        starts.filter(|&at| self.fits(at, range)).min_by(best)
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
