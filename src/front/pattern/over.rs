//! Pieces that the file places on others, where no cloth has room for both, or far from them.

use super::chain::Chain;
use super::lay::Laid;
use super::piece::Piece;
use crate::geom::boxes::Boxes;
use crate::geom::budget::Budget;
use crate::geom::shape::Shape;
use crate::geom::{Extent, Point, ring};
use crate::source::Span;

/// A piece on the cloth.
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
    /// Source spans of pieces with a place, well inside, in the cloth of another.
    pub(super) spans: Vec<Span>,
    /// Number of pieces that lie on another or have another on them.
    pub(super) count: usize,
}

/// The pieces that lie on others, as far as the work budget lasts. The pass that looks for overlapping edges in every marker
/// reports those.
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

/// Longest stretch of cloth without a piece, mm: no marker leaves so much, and a table is hardly as long.
const LONGEST_EMPTY: f64 = 20_000.0;

/// A piece far from all others or, with some, from most: the start of its block and the distance, mm.
pub(super) fn far_off(laid: &[Laid]) -> Option<(Span, f64)> {
    let places = laid.iter().filter_map(|laid| {
        let first = laid.piece.plain.vertices.first()?;
        Some((laid.motion.place(first.at), laid.piece.span))
    });
    let mut places: Vec<(Point, Span)> = places.collect();
    (0..2).find_map(|axis| {
        places.sort_by(|a, b| a.0[axis].total_cmp(&b.0[axis]).then(a.1.cmp(&b.1)));
        let gap = |k: usize| places[k + 1].0[axis] - places[k].0[axis];
        let wide = (0..places.len().saturating_sub(1)).find(|&k| gap(k) > LONGEST_EMPTY)?;
        let far = if 2 * (wide + 1) <= places.len() { wide } else { wide + 1 };
        Some((places[far].1, gap(wide)))
    })
}
