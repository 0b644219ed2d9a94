//! What a cut passes between two of its places, and the longest stretch of places that hold.

use std::ops::RangeInclusive;

use super::body::{Cut, Sagitta};
use super::follow::Foot;
use crate::geom::{Point, polyline};
use crate::verify::reference::line::Line;

/// Distance at which the tip's way passes the vertices between the stations of places `i - 1` and `i`, mm. Inside a bend it may
/// come by a vertex a little before or behind these places: that is looked for where the distance is more than allowed.
pub(super) fn skipped(line: &Line, cut: &Cut, feet: &[Foot], i: usize, allowed: f64) -> f64 {
    let (a, b) = (feet[i - 1].station, feet[i].station);
    let chord = feet[i].chord;
    if feet[i - 1].chord == chord && (a - b).abs() <= line.station(chord + 1) - line.station(chord) {
        // Between two places on one chord, on the same lap, there is no vertex.
        return 0.0;
    }
    let points = &cut.points;
    let (low, high) = (a.min(b), a.max(b));
    let sagitta = |k: usize| match cut.sagitta {
        Sagitta::Within(sagitta) => sagitta,
        // The blade's own places are no part of the way.
        Sagitta::Timed if k <= cut.body || k + 1 >= points.len() => 0.0,
        Sagitta::Timed => ((points[k + 1] - points[k]) - (points[k] - points[k - 1])).norm() / 8.0,
    };
    let away = |vertex: usize| {
        let distance = |k: usize| polyline::distance_to_segment(line.point(vertex), points[k - 1], points[k]);
        let here = distance(i);
        if here <= allowed {
            return here;
        }
        // On from there as long as it comes nearer.
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

/// The stations of the first and the last vertex between two places of a straight blade that it cuts; `None` when there are
/// none.
pub(in crate::verify) fn passed(line: &Line, places: &[Point], feet: &[Foot], allowed: f64) -> Option<[f64; 2]> {
    let (a, b) = (feet[0].station, feet[1].station);
    let (low, high) = (a.min(b), a.max(b));
    let chord = feet[0].chord;
    if low == high || feet[1].chord == chord && low > line.station(chord) && high < line.station(chord + 1) {
        // No vertex lies between two places amid one chord, and none that counts between two past the end of a line.
        return None;
    }
    let is_cut = |vertex: &usize| polyline::distance_to_segment(line.point(*vertex), places[0], places[1]) <= allowed;
    let lap = if line.ring { (low / line.length()).floor() * line.length() } else { 0.0 };
    let cut = line.vertices(low, high).filter(is_cut).map(|vertex| line.station(vertex) + lap);
    cut.filter(|station| (low..=high).contains(station)).fold(None, |found, station| {
        Some(found.map_or([station; 2], |[first, last]: [f64; 2]| [first.min(station), last.max(station)]))
    })
}

/// The longest stretch of places that hold; the first of two alike.
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
