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
    let deepest = slits.iter().map(Notch::depth).fold(0.0, f64::max);
    (0..slits.len())
        .find(|&i| {
            let others = Others { slits: &slits[..i], deepest, part };
            others.meet(&slits[i], work) || meets_edge(&slits[i], part, work)
        })
        .map(|i| slits[i])
}

fn ends(slit: &Notch) -> [Point; 2] {
    [slit.root, slit.tip]
}

/// Other slits of a part.
struct Others<'a> {
    slits: &'a [Notch],
    /// The depth of the deepest one, mm.
    deepest: f64,
    part: &'a Outlines<'a>,
}

impl Others<'_> {
    /// Whether a slit comes to one of them. Strokes from one place are one notch, and so are a slit and its branch.
    fn meet(&self, slit: &Notch, work: &mut Budget) -> bool {
        let reach = 2.0 * self.deepest + LEAST_BRIDGE;
        let mut meets = |other: &Notch| {
            let apart = (other.root - slit.root).norm_squared();
            apart < reach * reach
                && apart > AT_ROOT * AT_ROOT
                && distance_of_segments(ends(slit), ends(other)) < LEAST_BRIDGE
                && !self.is_branch(slit, other, work)
                && !self.is_branch(other, slit, work)
        };
        let met = self.slits.iter().any(&mut meets);
        work.spend(self.slits.len()) && met
    }

    /// Whether a slit begins on another one, and not on the edge.
    fn is_branch(&self, slit: &Notch, other: &Notch, work: &mut Budget) -> bool {
        let [root, tip] = ends(other);
        let around = Extent::between(slit.root, slit.root).grown(AT_ROOT);
        let is_near = |[from, to]: [Point; 2]| distance_to_segment(slit.root, from, to) <= AT_ROOT;
        distance_to_segment(slit.root, root, tip) < LEAST_BRIDGE
            && !self.part.edges_near(around).any(|edge| work.spend(1) && is_near(edge))
    }
}

/// Whether a slit comes to an edge that it does not begin on.
fn meets_edge(slit: &Notch, part: &Outlines, work: &mut Budget) -> bool {
    let around = Extent::of(&ends(slit)).grown(LEAST_BRIDGE);
    let is_across = |[from, to]: [Point; 2]| distance_to_segment(slit.root, from, to) > AT_ROOT;
    let comes_to = |edge: [Point; 2]| distance_of_segments(ends(slit), edge) < LEAST_BRIDGE;
    part.edges_near(around).any(|edge| work.spend(1) && is_across(edge) && comes_to(edge))
}
