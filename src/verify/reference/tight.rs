//! Places where a line is too tight for the blade, found by laying the blade on it as a chord, place by place.

use super::line::Line;
use crate::geom::{Point, Vector, polyline};
use crate::machine::Knife;

/// Cosines of the angle between blade and line at heel and tip, below which the blade might be unable to follow: a little above
/// the actual limits, because of overlaps and of the space between two sampled places.
const HEEL_COSINE: f64 = 0.47;
const TIP_COSINE: f64 = 0.1;
/// Spacing of the places at which a blade is laid on a line, mm.
const STEP: f64 = 0.1;
/// Least turn of a line that may be tight, rad (46 degrees): less than the cosines above require.
const TURN_MIN: f64 = 0.8;
/// Length of a line on which it turns that much where it is tight, in blade widths: twice the greatest span of a blade.
const WIDTHS: f64 = 3.0;

/// True if a blade, from heel to tip, may stand across a line with that direction at the heel.
pub(in crate::verify) fn stands_across(blade: Vector, direction: Vector) -> bool {
    blade.dot(&direction) < HEEL_COSINE * blade.norm()
}

/// Stretches of a line, by the stations of heel and tip, on which a blade as its chord would stand across it.
pub(in crate::verify) fn stretches(line: &Line, knife: &Knife) -> Vec<[f64; 2]> {
    let width = knife.width_mm;
    if width == 0.0 || line.chords() < 2 {
        return Vec::new();
    }
    let (path, start) = led_on(line, knife);
    let stations = polyline::stations(&path);
    let last = if line.ring { line.length() } else { stations[stations.len() - 1] };
    let mut found: Vec<[f64; 2]> = Vec::new();
    for [low, high] in sharp(&path, &stations, WIDTHS * width) {
        let (low, high) = ((low - WIDTHS * width).max(0.0), high.min(last));
        let steps = ((high - low) / STEP).ceil().max(0.0) as usize;
        for heel in (0..=steps).map(|i| (low + STEP * i as f64).min(high)) {
            let Some(tip) = across_at(&path, &stations, heel, width) else { continue };
            match found.last_mut() {
                Some(stretch) if heel - start <= stretch[1] => stretch[1] = stretch[1].max(tip - start),
                _ => found.push([heel - start, tip - start]),
            }
        }
    }
    found
}

/// Line extended straight by its greatest overlaps, or two laps of a ring; and the length added at the start, mm.
fn led_on(line: &Line, knife: &Knife) -> (Vec<Point>, f64) {
    let mut path = line.twice_round();
    if line.ring {
        return (path, 0.0);
    }
    let [heel, front] = knife.most_overlaps();
    let n = path.len();
    if let Some(along) = polyline::direction(path[n - 2], path[n - 1]).filter(|_| front > 0.0) {
        path.push(path[n - 1] + along * front);
    }
    match polyline::direction(path[0], path[1]).filter(|_| heel > 0.0) {
        Some(along) => {
            path.insert(0, path[0] - along * heel);
            (path, heel)
        }
        None => (path, 0.0),
    }
}

/// Stretches of a path on which it turns enough to be tight; at most `reach` mm long unless several were joined.
fn sharp(path: &[Point], stations: &[f64], reach: f64) -> Vec<[f64; 2]> {
    let turn = |vertex: usize| polyline::turn_at(path[vertex - 1], path[vertex], path[vertex + 1]).abs();
    let mut found: Vec<[f64; 2]> = Vec::new();
    let (mut first, mut sum) = (1, 0.0);
    for vertex in 1..path.len() - 1 {
        sum += turn(vertex);
        while stations[vertex] - stations[first] > reach {
            sum -= turn(first);
            first += 1;
        }
        if sum >= TURN_MIN {
            let stretch = [stations[first], stations[vertex]];
            match found.last_mut() {
                // Stretches whose blades overlap are joined.
                Some(last) if stretch[0] <= last[1] + reach => last[1] = stretch[1],
                _ => found.push(stretch),
            }
        }
    }
    found
}

/// Station of the tip if the blade with its heel at a station stands across the path or does not fit on it; `None` for an
/// ordinary chord.
fn across_at(path: &[Point], stations: &[f64], heel: f64, width: f64) -> Option<f64> {
    let chord = stations.partition_point(|&s| s <= heel).clamp(1, path.len() - 1) - 1;
    let along = |chord: usize| -> Vector { (path[chord + 1] - path[chord]) / (stations[chord + 1] - stations[chord]) };
    let from = path[chord] + along(chord) * (heel - stations[chord]);
    let rest: Vec<Point> = std::iter::once(from)
        .chain(path[chord + 1..].iter().copied().take_while({
            let mut is_left = false;
            move |point| !std::mem::replace(&mut is_left, (point - from).norm() > width)
        }))
        .collect();
    let found = polyline::first_at_distance(&rest, width);
    let (tip, at) = found.unwrap_or((path[path.len() - 1], path.len() - 2 - chord));
    let at = chord + at;
    let blade = tip - from;
    let is_across = stands_across(blade, along(chord)) || blade.dot(&along(at)) < TIP_COSINE * blade.norm();
    is_across.then(|| stations[at] + (tip - path[at]).norm())
}
