//! Vertices that a cut passes between two of its places, and the longest run of places that hold.

use std::ops::RangeInclusive;

use super::body::{Cut, Sagitta};
use super::follow::Foot;
use crate::geom::{Point, polyline};
use crate::verify::reference::line::Line;

/// Distance at which the tip's path passes the vertices between the stations of places `i - 1` and `i`, mm. In a bend it may
/// pass a vertex slightly before or after these places; neighbouring places are checked where the distance exceeds `allowed`.
#[inline]
pub(super) fn skipped(line: &Line, cut: &Cut, feet: &[Foot], i: usize, allowed: f64) -> f64 {
    let (a, b) = (feet[i - 1].station, feet[i].station);
    let chord = feet[i].chord;
    // Between two places on one chord of the same lap there is no vertex.
    let is_none = feet[i - 1].chord == chord && (a - b).abs() <= line.station(chord + 1) - line.station(chord);
    if is_none { 0.0 } else { between(line, cut, [a, b], i, allowed) }
}

/// Distance at which the tip's path passes the vertices between two stations, those of places `i - 1` and `i`, mm.
fn between(line: &Line, cut: &Cut, [a, b]: [f64; 2], i: usize, allowed: f64) -> f64 {
    let points = &cut.points;
    let (low, high) = (a.min(b), a.max(b));
    let sagitta = |k: usize| match cut.sagitta {
        Sagitta::Within(sagitta) => sagitta,
        // Places of the blade itself do not belong to the path.
        Sagitta::Timed if k <= cut.body || k + 1 >= points.len() => 0.0,
        Sagitta::Timed => ((points[k + 1] - points[k]) - (points[k] - points[k - 1])).norm() / 8.0,
    };
    let away = |vertex: usize| {
        let distance = |k: usize| polyline::distance_to_segment(line.point(vertex), points[k - 1], points[k]);
        let here = distance(i);
        if here <= allowed {
            return here;
        }
        // Continue from here as long as the distance decreases.
        let nearest = |steps: &mut dyn Iterator<Item = usize>| {
            let nearer = steps.map(distance).scan(here, |last, next| {
                let is_nearer = next < *last;
                *last = next;
                is_nearer.then_some(next)
            });
            nearer.fold(here, f64::min)
        };
        nearest(&mut (cut.body + 1..i).rev()).min(nearest(&mut (i + 1..points.len())))
    };
    line.vertices(low.next_up(), high.next_down()).map(away).fold(0.0, f64::max) - sagitta(i).max(sagitta(i - 1))
}

/// Stations of the first and the last vertex that a straight blade cuts between two of its places; `None` without any.
pub(in crate::verify) fn passed(line: &Line, places: &[Point], feet: &[Foot], allowed: f64) -> Option<[f64; 2]> {
    let (a, b) = (feet[0].station, feet[1].station);
    let (low, high) = (a.min(b), a.max(b));
    let chord = feet[0].chord;
    if low == high || feet[1].chord == chord && low > line.station(chord) && high < line.station(chord + 1) {
        // Between two places inside one chord there is no vertex; between two places past the end of a line none counts.
        return None;
    }
    let is_cut = |vertex: &usize| polyline::distance_to_segment(line.point(*vertex), places[0], places[1]) <= allowed;
    let lap = if line.ring { (low / line.length()).floor() * line.length() } else { 0.0 };
    let cut = line.vertices(low, high).filter(is_cut).map(|vertex| line.station(vertex) + lap);
    cut.filter(|station| (low..=high).contains(station)).fold(None, |found, station| {
        Some(found.map_or([station; 2], |[first, last]: [f64; 2]| [first.min(station), last.max(station)]))
    })
}

/// Longest run of places that hold; the first of equally long ones.
pub(in crate::verify) fn longest(on: &[bool]) -> Option<RangeInclusive<usize>> {
    let mut best: Option<RangeInclusive<usize>> = None;
    let mut from = 0;
    for (i, &holds) in on.iter().enumerate() {
        if !holds {
            from = i + 1;
        } else if best.as_ref().is_none_or(|b| i - from > b.end() - b.start()) {
            best = Some(from..=i);
        }
    }
    best
}
