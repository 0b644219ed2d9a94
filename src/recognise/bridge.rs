//! Bridges: short straight lines between the strokes of an outline that nearly meet.
//!
//! Ends up to `drawing.close_mm` apart that have no other end near them are bridged where the strokes then go around something
//! and come back. A dashed line has more gap than that, and stays as it is.

use super::chains::{Chains, End, place};
use super::line::SMALL_OUTLINE;
use crate::geom::{Extent, polyline};
use crate::ir::drawing::Drawing;

/// Share of an outline that its bridges take at the most: the gaps of dashed lines take a fifth and more.
const MOST_BRIDGED: f64 = 0.05;

/// Bridges among pairs of ends of chains that have no other end near them.
pub(super) fn find(drawing: &Drawing, chains: &Chains, pairs: &[[End; 2]]) -> Vec<[End; 2]> {
    let mut across = vec![None; chains.links.len()];
    for &[a, b] in pairs.iter().filter(|[a, b]| chains.far(*a) != *b) {
        (across[a], across[b]) = (Some(b), Some(a));
    }
    let mut found = Vec::new();
    let mut seen = vec![false; across.len()];
    for &end in pairs.iter().flatten() {
        let ring = ring(end, chains, &across, &mut seen);
        found.extend(ring.filter(|ring| goes_around(drawing, chains, ring)).into_iter().flatten());
    }
    found
}

/// The bridges of the ring that leads on from an end, if one does: each from an end to the one across from it.
fn ring(first: End, chains: &Chains, across: &[Option<End>], seen: &mut [bool]) -> Option<Vec<[End; 2]>> {
    let mut bridges = Vec::new();
    let mut at = first;
    loop {
        let next = across[at].filter(|_| !std::mem::replace(&mut seen[at], true))?;
        seen[next] = true;
        bridges.push([at, next]);
        at = chains.far(next);
        if at == first {
            return Some(bridges);
        }
    }
}

/// Whether a ring is as large as an outline, and drawn for the most part.
fn goes_around(drawing: &Drawing, chains: &Chains, bridges: &[[End; 2]]) -> bool {
    let (mut extent, mut drawn, mut bridged) = (Extent::EMPTY, 0.0, 0.0);
    for &[from, to] in bridges {
        bridged += (place(drawing, from) - place(drawing, to)).norm();
        for stroke in chains.from(to) {
            let places = &drawing.vertices[drawing.strokes[stroke / 2].range()];
            let points: Vec<_> = places.iter().map(|vertex| vertex.at).collect();
            extent.join(&Extent::of(&points));
            drawn += polyline::length(&points);
        }
    }
    let (width, height) = extent.size();
    width.max(height) > SMALL_OUTLINE && bridged <= MOST_BRIDGED * drawn
}
