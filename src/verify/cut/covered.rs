//! Stretches of a line that a plunge cut covers: those within the permitted deviation of the blade.

use super::heading::on_lap;
use crate::geom::{Point, cross};
use crate::verify::reference::line::{Chord, Line};

/// Distance below which two stretches are joined, mm: rounding.
const JOINED: f64 = 1e-9;
/// Smallest ratio of the extent of a stretch along the blade to its length for it to count as cut along, however it winds.
const ALONG: f64 = 0.5;

/// Distances within which a blade cuts a line, mm.
#[derive(Debug, Clone, Copy)]
pub(super) struct Near {
    /// Length of the line that is searched on either side of the station.
    pub(super) reach: f64,
    /// Greatest distance beside the blade.
    pub(super) beside: f64,
    /// Greatest distance beyond the ends of the blade: rounding.
    pub(super) beyond: f64,
}

/// Stretches of a line under a blade, given by its heel and tip, in order; searched from a station in both directions.
pub(super) fn covered(line: &Line, blade: [Point; 2], station: f64, near: Near) -> Vec<[f64; 2]> {
    let mut found: Vec<[f64; 2]> = Vec::new();
    for (chord, lap) in chords(line, station, near.reach) {
        let chord = line.chord(chord);
        let Some([from, to]) = of_chord(&chord, blade, near) else { continue };
        let (from, to) = (from + lap, to + lap);
        match found.last_mut() {
            Some(last) if from - last[1] <= JOINED => last[1] = to,
            _ => found.push([from, to]),
        }
    }
    // A stretch that only crosses the blade is cut through, not along.
    let axis = (blade[1] - blade[0]).normalize();
    let along = |[a, b]: [f64; 2]| (line.place(on_lap(line, b)) - line.place(on_lap(line, a))).dot(&axis).abs();
    found.retain(|&[a, b]| along([a, b]) >= ALONG * (b - a));
    found
}

/// Chords of a line within `reach` mm of a station, each with the length of the laps before it.
fn chords<'a>(line: &'a Line, near: f64, reach: f64) -> impl Iterator<Item = (usize, f64)> + 'a {
    let (length, count) = (line.length(), line.chords());
    let (low, high) = if line.ring {
        // At most once around.
        let reach = reach.min(length / 2.0);
        (near - reach, near + reach)
    } else {
        ((near - reach).max(0.0), (near + reach).min(length))
    };
    let lap = if line.ring { (low / length).floor() } else { 0.0 };
    let first = line.chord_at(low - lap * length);
    let place = move |i: usize| (i % count, (lap + (i / count) as f64) * length);
    let laps = if line.ring { usize::MAX } else { count };
    (first..laps).map(place).take_while(move |&(chord, lap)| line.station(chord) + lap < high)
}

/// Station range in which a blade lies over a chord, or over the bulge of the curve that the chord approximates.
fn of_chord(chord: &Chord, blade: [Point; 2], near: Near) -> Option<[f64; 2]> {
    let [from, crest, to] = chord.band();
    let straight = within([from, to], blade, near);
    let halves = if crest == Point::from((from.coords + to.coords) / 2.0) {
        [None; 2]
    } else {
        let half = |ends, by: f64| within(ends, blade, near).map(|[a, b]| [by + a / 2.0, by + b / 2.0]);
        [half([from, crest], 0.0), half([crest, to], 0.5)]
    };
    let [a, b] = hull([straight, halves[0], halves[1]])?;
    let [start, length] = chord.stations();
    Some([start + a * length, start + b * length])
}

/// Part of a segment under a blade, from 0 at its start to 1 at its end.
fn within([from, to]: [Point; 2], [heel, tip]: [Point; 2], Near { beside, beyond, .. }: Near) -> Option<[f64; 2]> {
    let (way, blade) = (to - from, tip - heel);
    let width = blade.norm();
    let axis = blade / width;
    let [a, b] = clip(cross(axis, from - heel), cross(axis, way), [-beside, beside])?;
    let [c, d] = clip(axis.dot(&(from - heel)), axis.dot(&way), [-beyond, width + beyond])?;
    let (from, to) = (a.max(c).max(0.0), b.min(d).min(1.0));
    (from <= to).then_some([from, to])
}

/// Range of the argument in which a linear function, `start` at 0 and rising by `slope` per unit, lies between two bounds.
fn clip(start: f64, slope: f64, [low, high]: [f64; 2]) -> Option<[f64; 2]> {
    if slope == 0.0 {
        return (low..=high).contains(&start).then_some([f64::NEG_INFINITY, f64::INFINITY]);
    }
    let (a, b) = ((low - start) / slope, (high - start) / slope);
    Some([a.min(b), a.max(b)])
}

/// Hull of overlapping stretches: from the least start to the greatest end.
fn hull(stretches: [Option<[f64; 2]>; 3]) -> Option<[f64; 2]> {
    stretches.into_iter().flatten().reduce(|[a, b], [c, d]| [a.min(c), b.max(d)])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_segment_is_covered_beside_the_blade_and_not_beyond_its_ends() {
        let blade = [Point::new(0.0, 0.0), Point::new(10.0, 0.0)];
        let near = Near { reach: 20.0, beside: 1.0, beyond: 0.0 };
        let of = |from: (f64, f64), to: (f64, f64)| {
            let part = within([Point::new(from.0, from.1), Point::new(to.0, to.1)], blade, near);
            part.map(|ends| ends.map(|share| (share * 1e4).round() / 1e4))
        };
        assert_eq!(of((0.0, 2.0), (10.0, 2.0)), None);
        assert_eq!(of((5.0, -2.0), (5.0, 2.0)), Some([0.25, 0.75]));
        assert_eq!(of((-4.0, 0.0), (4.0, 0.0)), Some([0.5, 1.0]));
        assert_eq!(of((8.0, 0.5), (8.0, 0.25)), Some([0.0, 1.0]));
        assert_eq!(of((11.0, 0.0), (12.0, 0.0)), None);
    }
}
