//! Nibbling: stretches of a run are cut by plunges without motion, each along as many chords as stay near to its blade.

use super::chord::Tight;
use super::scene::Around;
use super::stretch::{REJOINED, Way};
use super::{overlap, stab};
use crate::geom::polyline;
use crate::ir::toolpath::Run;

/// Part of the tolerance by which a plunge may pass a vertex; rounding takes a little of the rest.
pub(super) const NIBBLE_SHARE: f64 = 0.9;
/// Halvings that make plunges alike: to a thousandth of a curve, which is finer than its chords.
const HALVINGS: usize = 10;

/// A part of a run, and whether it is meant to be one plunge.
pub(super) struct Part {
    pub(super) run: Run,
    pub(super) is_plunge: bool,
}

/// What becomes of a run whose tight curves, one at least, are nibbled: what lies before, between and behind them, and the plunges.
pub(super) fn parts(run: &Run, curves: &[Tight], around: &Around) -> Vec<Part> {
    let way = Way::new(run);
    let chords = way.chords();
    // A ring begins at its first tight curve and ends where that begins again; an open run has its own ends.
    let start = if way.is_ring() { *curves[0].vertices.start() } else { 0 };
    let end = start + chords;
    let station = |vertex: usize| way.station(vertex.cast_signed());
    // What lies before or behind a curve and is shorter than the blade is cut with it: it could only be a plunge, too.
    let is_short = |from: usize, to: usize| station(to) - station(from) < around.knife().width_mm;
    let mut stretches: Vec<[usize; 2]> = Vec::new();
    for curve in curves {
        let (from, to) = ((*curve.vertices.start()).max(start), (*curve.vertices.end()).min(end));
        let behind = stretches.last().map_or(start, |last| last[1]);
        let from = if is_short(behind, from) { behind } else { from };
        let to = if is_short(to, end) { end } else { to };
        match stretches.last_mut() {
            Some(last) if from <= last[1] => last[1] = to.max(last[1]),
            _ => stretches.push([from, to]),
        }
    }
    let mut parts = Vec::new();
    let mut add = |[from, to]: [usize; 2], is_plunge: bool| {
        let is_end = [from == 0, to == chords].map(|is_end| is_end && !way.is_ring());
        let ends = [0, 1].map(|i| if is_end[i] { run.ends[i] } else { REJOINED });
        parts.push(Part { run: way.part(station(from), station(to), ends), is_plunge });
    };
    let mut at = start;
    for [from, to] in stretches {
        if from > at {
            add([at, from], false);
        }
        for piece in nibbles(&way, [from, to], NIBBLE_SHARE * around.tolerance()) {
            add(piece, true);
        }
        at = to;
    }
    if at < end {
        add([at, end], false);
    }
    parts
}

/// How far the worst of the plunges that a whole run is nibbled with would cut into parts beyond one of its ends, mm, when
/// it does so alike at both.
pub(super) fn harm(run: &Run, curve: &Tight, around: &Around) -> f64 {
    let plunges = parts(run, std::slice::from_ref(curve), around).into_iter().map(|Part { mut run, .. }| {
        overlap::give(&mut run, around);
        stab::stab(&run, around).map_or(0.0, |stab| stab::total(&stab) / 2.0)
    });
    plunges.fold(0.0, f64::max)
}

/// The pieces of a stretch between two vertices, each within `allowed` of its chord: as few as there can be, and of these
/// the ones whose longest is shortest, because what the blade before has cut is no piece.
fn nibbles(way: &Way, stretch: [usize; 2], allowed: f64) -> Vec<[usize; 2]> {
    let station = |vertex: usize| way.station(vertex.cast_signed());
    let pieces = |longest: f64| {
        let [mut from, last] = stretch;
        let mut pieces = Vec::new();
        while from < last {
            let is_near = |to: usize| {
                let (a, b) = (way.vertex(from), way.vertex(to));
                (from + 1..to).all(|vertex| polyline::distance_to_segment(way.vertex(vertex), a, b) <= allowed)
            };
            let is_in = |to: &usize| station(*to) - station(from) <= longest && is_near(*to);
            // Twice as far each time, then halving: each look costs as much as it looks at.
            let (mut to, mut step) = (from + 1, 1);
            while to + step <= last && is_in(&(to + step)) {
                (to, step) = (to + step, 2 * step);
            }
            while step > 0 {
                if to + step <= last && is_in(&(to + step)) {
                    to += step;
                }
                step /= 2;
            }
            pieces.push([from, to]);
            from = to;
        }
        pieces
    };
    let length = station(stretch[1]) - station(stretch[0]);
    let fewest = pieces(length).len();
    let (mut low, mut high) = (0.0, length);
    for _ in 0..HALVINGS {
        let middle = f64::midpoint(low, high);
        if pieces(middle).len() > fewest {
            low = middle;
        } else {
            high = middle;
        }
    }
    pieces(high)
}
