//! Slits that meet across their part: it comes apart there.

use crate::analysis::outlines::Outlines;
use crate::geom::budget::Budget;
use crate::geom::polyline::{distance_of_segments, distance_to_segment};
use crate::geom::{Extent, Point};
use crate::ir::marker::{Notch, Piece};

/// Cloth that is left between two cuts below this tears at the next touch, mm.
const LEAST_BRIDGE: f64 = 0.5;
/// Edges and slits so near to where a slit begins, mm, are those that it begins on.
const AT_ROOT: f64 = 1.0;

/// A slit of a piece that comes to another one, or through the part to another edge; `None` where there is none, or no work is
/// left to find out.
pub(super) fn severing(piece: &Piece, part: &Outlines, work: &mut Budget) -> Option<Notch> {
    let slits = &piece.notches;
    let is_long = |slit: &Notch| slit.depth() > LEAST_BRIDGE;
    (0..slits.len()).find(|&i| is_long(&slits[i]) && meets(i, slits, part, work)).map(|i| slits[i])
}

fn meets(i: usize, slits: &[Notch], part: &Outlines, work: &mut Budget) -> bool {
    let slit = &slits[i];
    let ends = |slit: &Notch| [slit.root, slit.tip];
    let comes_to = |line: [Point; 2]| distance_of_segments(ends(slit), line) < LEAST_BRIDGE;
    // Strokes from one place are one notch.
    let is_other = |other: &Notch| (other.root - slit.root).norm() > AT_ROOT;
    if work.spend(i) && slits[..i].iter().any(|other| is_other(other) && comes_to(ends(other))) {
        return true;
    }
    let around = Extent::of(&ends(slit)).grown(LEAST_BRIDGE);
    let is_across = |[from, to]: [Point; 2]| distance_to_segment(slit.root, from, to) > AT_ROOT;
    part.edges_near(around).any(|edge| work.spend(1) && is_across(edge) && comes_to(edge))
}
