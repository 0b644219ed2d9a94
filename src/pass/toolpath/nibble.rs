//! Nibbling: cuts stretches of a run by plunges without motion, each along as many chords as stay near its blade.

use super::stretch::{REJOINED, Way};
use crate::analysis::cloth::Surroundings;
use crate::analysis::plunge::{BladePlacement, PASSING_SHARE, overlaps};
use crate::analysis::tight::TightCurve;
use crate::geom::polyline;
use crate::ir::toolpath::Run;

/// Number of bisection steps that equalise plunges: to a thousandth of a curve, finer than its chords.
const HALVINGS: usize = 10;
/// Longest step of rounded points, in tolerances.
const STEP_TOLERANCES: f64 = 1.5;
/// Share of the tolerance by which a spread plunge may miss a vertex of its curve. Points that are rounded to a unit leave a
/// line by nearly the whole tolerance of that unit.
const PLUNGE_SHARE: f64 = 0.999;
/// Difference of lengths that count as equal, mm: rounding.
const LENGTH_EPSILON: f64 = 1e-6;
/// Least length of a nibbled stretch of short chords, in tolerances: over a shorter one rounding may turn the line.
const LEAST_TOLERANCES: f64 = 8.0;
/// Number of vertices behind the start of a plunge up to which each is tried as its end, and the step behind them: each test
/// costs as much as its length.
const NEAR: usize = 64;
const FAR_STEP: usize = 8;
/// Number of vertices behind the end of a plunge at which it might end as well: more than a step of a rounded line has.
const STEPS: usize = 16;

/// Stretch of a nibbled run; `is_plunge` is true if it is meant to be cut by one plunge.
pub(super) struct Stretch {
    pub(super) run: Run,
    pub(super) is_plunge: bool,
}

/// Splits a run with at least one tight curve into plunges along the curves and the stretches before, between and behind them.
pub(super) fn nibbled(run: &Run, curves: &[TightCurve], around: &Surroundings) -> Vec<Stretch> {
    let way = Way::new(run);
    let chords = way.chords();
    // A ring begins at its first tight curve and ends there; an open run keeps its own ends.
    let start = if way.is_ring() { *curves[0].vertices.start() } else { 0 };
    let end = start + chords;
    let mut stretches = Vec::new();
    let mut add = |[from, to]: [usize; 2], is_plunge: bool| {
        let is_end = [from == 0, to == chords].map(|is_end| is_end && !way.is_ring());
        let ends = [0, 1].map(|i| if is_end[i] { run.ends[i] } else { REJOINED });
        let run = way.part(way.station(from.cast_signed()), way.station(to.cast_signed()), ends);
        stretches.push(Stretch { run, is_plunge });
    };
    let mut at = start;
    let least = LEAST_TOLERANCES * around.tolerance;
    for [from, to] in lengthened(&way, [start, end], curves, [around.knife.width_mm, least]) {
        if from > at {
            add([at, from], false);
        }
        for plunge in plunges(&way, [from, to], around.tolerance) {
            add(plunge, true);
        }
        at = to;
    }
    if at < end {
        add([at, end], false);
    }
    stretches
}

/// Vertex ranges of the curves of a run between two vertices. Each includes an adjacent stretch that is shorter than the blade,
/// since that could only be a plunge as well, and chords beside it that make it `least` mm long, if they are shorter than that:
/// a single step of rounded points leads elsewhere than the line. Adjoining ranges are joined.
fn lengthened(way: &Way, [start, end]: [usize; 2], curves: &[TightCurve], [width, least]: [f64; 2]) -> Vec<[usize; 2]> {
    let station = |vertex: usize| way.station(vertex.cast_signed());
    let is_short = |from: usize, to: usize| station(to) - station(from) < width;
    let mut lengthened: Vec<[usize; 2]> = Vec::new();
    for curve in curves {
        let (from, to) = ((*curve.vertices.start()).max(start), (*curve.vertices.end()).min(end));
        let behind = lengthened.last().map_or(start, |last| last[1]);
        let (from, to) = at_least(way, [from, to], [behind, end], least);
        let from = if is_short(behind, from) { behind } else { from };
        let to = if is_short(to, end) { end } else { to };
        match lengthened.last_mut() {
            Some(last) if from <= last[1] => last[1] = to.max(last[1]),
            _ => lengthened.push([from, to]),
        }
    }
    lengthened
}

/// Range of vertices that is grown to both sides between two bounds, by chords shorter than `least` mm, until it is that long.
fn at_least(way: &Way, [mut from, mut to]: [usize; 2], [low, high]: [usize; 2], least: f64) -> (usize, usize) {
    let length = |from: usize, to: usize| way.station(to.cast_signed()) - way.station(from.cast_signed());
    while length(from, to) < least {
        let before = from > low && length(from - 1, from) < least;
        let behind = to < high && length(to, to + 1) < least;
        if !before && !behind {
            break;
        }
        (from, to) = (from - usize::from(before), to + usize::from(behind));
    }
    (from, to)
}

/// Greatest overcut of the plunges by which a whole run is nibbled, mm.
pub(super) fn worst_overcut(run: &Run, curve: &TightCurve, around: &Surroundings) -> f64 {
    let plunges = nibbled(run, std::slice::from_ref(curve), around).into_iter().map(|Stretch { run, .. }| {
        let lengths = overlaps(&run, around).map(|overlap| overlap.length);
        BladePlacement::of(&run, lengths, around).map_or(0.0, |cut| cut.deepest())
    });
    plunges.fold(0.0, f64::max)
}

/// Plunges that cut the stretch between two vertices. A plunge along a single step of rounded points leads elsewhere than the
/// line: where there would be one, the plunges are spread instead.
fn plunges(way: &Way, ends: [usize; 2], tolerance: f64) -> Vec<[usize; 2]> {
    let evened = evened(way, ends, PASSING_SHARE * tolerance);
    let length = |[from, to]: [usize; 2]| way.station(to.cast_signed()) - way.station(from.cast_signed());
    if evened.iter().all(|&plunge| length(plunge) > STEP_TOLERANCES * tolerance) {
        return evened;
    }
    spread(way, ends, PLUNGE_SHARE * tolerance)
}

/// Plunges that cut the stretch between two vertices, each within `allowed` mm of its chord: the fewest possible, with the
/// longest of them as short as possible, so that the last is not a remnant which the previous one has cut already.
fn evened(way: &Way, [first, last]: [usize; 2], allowed: f64) -> Vec<[usize; 2]> {
    let length = way.station(last.cast_signed()) - way.station(first.cast_signed());
    let no_longer_than = |longest: f64| {
        let (mut plunges, mut from) = (Vec::new(), first);
        while from < last {
            let to = plunge_end(way, [from, last], [longest, allowed]);
            plunges.push([from, to]);
            from = to;
        }
        plunges
    };
    let fewest = no_longer_than(length).len();
    let (mut low, mut high) = (0.0, length);
    for _ in 0..HALVINGS {
        let middle = f64::midpoint(low, high);
        if no_longer_than(middle).len() > fewest {
            low = middle;
        } else {
            high = middle;
        }
    }
    no_longer_than(high)
}

/// Farthest vertex that a plunge from another vertex reaches, at least one chord on: at most `longest` mm away, with all
/// vertices between within `allowed` mm of the plunge.
fn plunge_end(way: &Way, [from, last]: [usize; 2], [longest, allowed]: [f64; 2]) -> usize {
    let is_near = |to: usize| {
        let (a, b) = (way.vertex(from), way.vertex(to));
        (from + 1..to).all(|vertex| polyline::distance_to_segment(way.vertex(vertex), a, b) <= allowed)
    };
    let length = |to: usize| way.station(to.cast_signed()) - way.station(from.cast_signed());
    let is_in = |to: usize| to <= last && length(to) <= longest && is_near(to);
    // Exponential search, then bisection: each test costs as much as its length.
    let (mut to, mut step) = (from + 1, 1);
    while is_in(to + step) {
        (to, step) = (to + step, 2 * step);
    }
    while step > 0 {
        if is_in(to + step) {
            to += step;
        }
        step /= 2;
    }
    to
}

/// Plunges that cut the stretch between two vertices, each within `allowed` mm of its chord: the fewest possible, with the
/// shortest of them as long as possible: a short one may be a remnant that its neighbours have cut already, or a single step
/// of rounded points, which leads elsewhere than the line.
fn spread(way: &Way, [first, last]: [usize; 2], allowed: f64) -> Vec<[usize; 2]> {
    let length = |from: usize, to: usize| way.station(to.cast_signed()) - way.station(from.cast_signed());
    // Best plunges up to each vertex.
    let mut best: Vec<Option<Reached>> = vec![None; last - first + 1];
    best[0] = Some(Reached { count: 0, shortest: f64::INFINITY, from: first });
    for from in first..last {
        let Some(reached) = best[from - first] else { continue };
        for to in ends(way, [from, last], allowed) {
            let next = Reached { count: reached.count + 1, shortest: reached.shortest.min(length(from, to)), from };
            let known = &mut best[to - first];
            if known.is_none_or(|known| next.is_better(&known)) {
                *known = Some(next);
            }
        }
    }
    let mut plunges = Vec::new();
    let mut to = last;
    while let Some(Reached { from, .. }) = best[to - first].filter(|_| to > first) {
        plunges.push([from, to]);
        to = from;
    }
    plunges.reverse();
    plunges
}

/// Plunges up to a vertex.
#[derive(Debug, Clone, Copy)]
struct Reached {
    /// Number of plunges.
    count: usize,
    /// Length of the line under the shortest of them, mm.
    shortest: f64,
    /// Vertex at which the last of them begins.
    from: usize,
}

impl Reached {
    fn is_better(&self, other: &Self) -> bool {
        self.count < other.count || self.count == other.count && self.shortest > other.shortest + LENGTH_EPSILON
    }
}

/// Vertices that a plunge from another vertex may reach, with all vertices between within `allowed` mm of the plunge; the next
/// vertex always. In the steps of rounded points a plunge may end at one vertex and not at the one before it.
fn ends(way: &Way, [from, last]: [usize; 2], allowed: f64) -> impl Iterator<Item = usize> {
    let is_near = move |to: usize| {
        let (a, b) = (way.vertex(from), way.vertex(to));
        (from + 1..to).all(|vertex| polyline::distance_to_segment(way.vertex(vertex), a, b) <= allowed)
    };
    let near = from + 1..=last.min(from + NEAR);
    let far = (from + NEAR + FAR_STEP..last).step_by(FAR_STEP).chain((last > from + NEAR).then_some(last));
    let mut reached = from + 1;
    let tried = near.chain(far).map_while(move |to| {
        let is_end = is_near(to);
        reached = if is_end { to } else { reached };
        (is_end || to <= reached + STEPS).then_some((to, is_end))
    });
    tried.filter_map(|(to, is_end)| is_end.then_some(to))
}
