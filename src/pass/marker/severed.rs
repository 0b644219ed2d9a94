//! Slits that meet across their part: it comes apart there.

use crate::analysis::outlines::Outlines;
use crate::geom::Point;
use crate::geom::budget::Budget;
use crate::geom::polyline::{distance_of_segments, distance_to_segment};
use crate::ir::marker::{Notch, Piece};

/// Cloth that is left between two cuts below this tears at the next touch, mm.
const LEAST_BRIDGE: f64 = 0.5;

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
    // Two strokes from one place are one notch.
    let is_other = |other: &Notch| (other.root - slit.root).norm() > LEAST_BRIDGE;
    let meets_slit = |other: &Notch| is_other(other) && distance_of_segments(ends(slit), ends(other)) < LEAST_BRIDGE;
    if !work.spend(i) || slits[..i].iter().any(meets_slit) {
        return !work.is_spent();
    }
    part.edges_near(slit.tip, LEAST_BRIDGE).any(|edge| work.spend(1) && comes_to(slit, edge))
}

/// Whether a slit comes to an edge that it does not begin on.
fn comes_to(slit: &Notch, [from, to]: [Point; 2]) -> bool {
    let near = |at: Point| distance_to_segment(at, from, to);
    near(slit.tip) < LEAST_BRIDGE && near(slit.root) > slit.depth() / 2.0
}
