//! Nibbling: cuts stretches of a run by plunges without motion, each along as many chords as stay near its blade.

use super::stretch::{REJOINED, Way};
use crate::analysis::cloth::Surroundings;
use crate::analysis::plunge::{BladePlacement, PASSING_SHARE, overlaps};
use crate::analysis::tight::TightCurve;
use crate::geom::polyline;
use crate::ir::toolpath::Run;

/// Number of bisection steps that equalise plunges: to a thousandth of a curve, finer than its chords.
const HALVINGS: usize = 10;

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
    for [from, to] in lengthened(&way, [start, end], curves, around.knife.width_mm) {
        if from > at {
            add([at, from], false);
        }
        for plunge in plunges(&way, [from, to], PASSING_SHARE * around.tolerance) {
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
/// since that could only be a plunge as well. Adjoining ranges are joined.
fn lengthened(way: &Way, [start, end]: [usize; 2], curves: &[TightCurve], width: f64) -> Vec<[usize; 2]> {
    let station = |vertex: usize| way.station(vertex.cast_signed());
    let is_short = |from: usize, to: usize| station(to) - station(from) < width;
    let mut lengthened: Vec<[usize; 2]> = Vec::new();
    for curve in curves {
        let (from, to) = ((*curve.vertices.start()).max(start), (*curve.vertices.end()).min(end));
        let behind = lengthened.last().map_or(start, |last| last[1]);
        let from = if is_short(behind, from) { behind } else { from };
        let to = if is_short(to, end) { end } else { to };
        match lengthened.last_mut() {
            Some(last) if from <= last[1] => last[1] = to.max(last[1]),
            _ => lengthened.push([from, to]),
        }
    }
    lengthened
}

/// Greatest overcut of the plunges by which a whole run is nibbled, mm.
pub(super) fn worst_overcut(run: &Run, curve: &TightCurve, around: &Surroundings) -> f64 {
    let plunges = nibbled(run, std::slice::from_ref(curve), around).into_iter().map(|Stretch { run, .. }| {
        let lengths = overlaps(&run, around).map(|overlap| overlap.length);
        BladePlacement::of(&run, lengths, around).map_or(0.0, |cut| cut.deepest())
    });
    plunges.fold(0.0, f64::max)
}

/// Plunges that cut the stretch between two vertices, each within `allowed` mm of its chord: the fewest possible, with the
/// longest of them as short as possible, so that the last is not a remnant which the previous one has cut already.
fn plunges(way: &Way, [first, last]: [usize; 2], allowed: f64) -> Vec<[usize; 2]> {
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
