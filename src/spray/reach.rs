//! Stretches of edges that the head cannot reach, as where a slot or a bay is narrower than twice its distance.

use super::edge::Ring;
use super::offset::{Beside, Element};
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::geom::Point;
use crate::units::number::fixed;

/// Length below which a stretch is rounding, mm.
const SHORT: f64 = 0.1;

/// A stretch of a ring that the head cannot reach.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Gap {
    /// Start and end on the ring, mm from its first vertex.
    from: f64,
    to: f64,
    /// Start point.
    at: Point,
    /// Index of the chord at the start.
    block: usize,
}

/// Reports for each ring the stretches that the head cannot reach.
pub(super) fn report(ways: &[Vec<Element>], rings: &[Ring], distance: f64, out: &mut Diagnostics) {
    for (number, ring) in rings.iter().enumerate() {
        let gaps = gaps(ways, ring, number, distance);
        let Some(worst) = gaps.iter().max_by(|a, b| (a.to - a.from).total_cmp(&(b.to - b.from))) else { continue };
        let all: f64 = gaps.iter().map(|gap| gap.to - gap.from).sum();
        let message = format!(
            "{} mm of an edge cannot be followed at {} mm, in {}; the longest stretch is {} mm",
            fixed(all, 1),
            fixed(distance, 1),
            if gaps.len() == 1 { "one place".to_owned() } else { format!("{} places", gaps.len()) },
            fixed(worst.to - worst.from, 1)
        );
        let hint =
            "what faces it is nearer than twice the distance, or the edge turns inwards there: it stays without coat";
        let place = worst.at;
        out.push(
            Diagnostic::new(&code::SPRAY_UNREACHED, message).hint(hint).at(ring.spans[worst.block]).on_cloth(place),
        );
    }
}

/// Stretches of a ring that no path runs beside. Adjoining ones are joined.
fn gaps(ways: &[Vec<Element>], ring: &Ring, number: usize, distance: f64) -> Vec<Gap> {
    let mut covered: Vec<Vec<[f64; 2]>> = vec![Vec::new(); ring.points.len()];
    for element in ways.iter().flatten() {
        if let Beside::Chord { ring: of, chord } = element.beside
            && of == number
        {
            let along = ring.along(chord);
            covered[chord].push(element.ends.map(|end| (end - ring.points[chord]).dot(&along)));
        }
    }
    let mut gaps: Vec<Gap> = Vec::new();
    let mut start = 0.0;
    for (chord, covered) in covered.iter_mut().enumerate() {
        covered.sort_by(|a, b| a[0].total_cmp(&b[0]));
        let (length, end) = (ring.length(chord), (chord + 1) % ring.points.len());
        // In a bay the paths beside two chords meet before their vertex. The curve there is followed nevertheless.
        let bay = |vertex: usize| {
            if ring.is_corner(vertex) { 0.0 } else { distance * (-0.5 * ring.turns[vertex]).max(0.0).tan() }
        };
        let is_followed = !covered.is_empty();
        let mut at = if is_followed { bay(chord).min(covered[0][0].max(0.0)) } else { 0.0 };
        let last = if is_followed { length - bay(end) } else { length };
        let ends: Vec<[f64; 2]> = covered.iter().copied().chain([[last, last]]).collect();
        for [from, to] in ends {
            if from - at > SHORT {
                let place = ring.points[chord] + ring.along(chord) * at;
                gaps.push(Gap { from: start + at, to: start + from, at: place, block: chord });
            }
            at = at.max(to);
        }
        start += length;
    }
    joined(gaps)
}

/// Joins adjoining gaps.
fn joined(gaps: Vec<Gap>) -> Vec<Gap> {
    let mut joined: Vec<Gap> = Vec::new();
    for gap in gaps {
        match joined.last_mut() {
            Some(last) if gap.from - last.to < SHORT => last.to = gap.to,
            Some(_) | None => joined.push(gap),
        }
    }
    joined
}
