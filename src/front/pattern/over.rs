//! Pieces that the file puts on others: no cloth has room for both.

use super::chain::Chain;
use super::lay::Laid;
use super::piece::Piece;
use crate::geom::boxes::Boxes;
use crate::geom::budget::Budget;
use crate::geom::shape::Shape;
use crate::geom::{Extent, Point, ring};
use crate::source::Span;

/// A piece where it lies.
struct Cloth<'p> {
    laid: Laid<'p>,
    extent: Extent,
    /// A place in its cloth.
    middle: Option<Point>,
}

/// The lines that bound a piece.
fn rings(piece: &Piece) -> Vec<Vec<Point>> {
    std::iter::once(&piece.plain).chain(&piece.inner).map(Chain::points).collect()
}

impl<'p> Cloth<'p> {
    fn of(laid: &Laid<'p>, work: &mut Budget) -> Option<Self> {
        let outline = &laid.piece.plain;
        if !work.spend(outline.vertices.len()) {
            return None;
        }
        let mut extent = Extent::EMPTY;
        outline.vertices.iter().for_each(|vertex| extent.add(laid.motion.place(vertex.at)));
        let middle = Shape::new(&rings(laid.piece)).inner().map(|at| laid.motion.place(at));
        Some(Self { laid: *laid, extent, middle })
    }

    fn has(&self, at: Point, work: &mut Budget) -> bool {
        let at = self.laid.motion.back(at);
        let rings = rings(self.laid.piece);
        let vertices = rings.iter().map(Vec::len).sum();
        work.spend(vertices) && rings.iter().filter(|points| ring::contains(points, at)).count() == 1
    }
}

/// Pieces that lie on each other.
#[derive(Debug, Default)]
pub(super) struct OnOthers {
    /// Those a place of which, well inside, lies in the cloth of another.
    pub(super) spans: Vec<Span>,
    /// How many of all lie on another or have another on them.
    pub(super) count: usize,
}

/// The pieces that lie on others, as far as there is work left to find out. Pieces whose edges overlap are told by the pass
/// that looks for that in every marker.
pub(super) fn on_others(laid: &[Laid], work: &mut Budget) -> OnOthers {
    let cut = laid.iter().filter(|laid| !laid.piece.is_at_fault());
    let all: Vec<Cloth> = cut.map_while(|laid| Cloth::of(laid, work)).collect();
    let boxes = Boxes::new(all.iter().map(|cloth| cloth.extent).collect());
    let mut is_met = vec![false; all.len()];
    let mut spans = Vec::new();
    for (i, cloth) in all.iter().enumerate() {
        let Some(middle) = cloth.middle else { continue };
        if let Some(k) = boxes.at(middle).find(|&k| k != i && all[k].has(middle, work)) {
            (is_met[i], is_met[k]) = (true, true);
            spans.push(cloth.laid.piece.span);
        }
    }
    OnOthers { spans, count: is_met.iter().filter(|is_met| **is_met).count() }
}
