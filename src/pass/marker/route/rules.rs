//! Rules for the order of pieces that hold regardless of savings.

use super::small;
use crate::analysis::nesting::Nesting;
use crate::geom::Extent;
use crate::ir::Marker;
use crate::ir::list::SegmentList;
use crate::ir::marker::Piece;
use crate::machine::{Job, Order, OrderPolicy};

/// Rules for the order of the pieces of a marker, which are identified by index.
pub(super) struct Rules {
    /// Pieces that must follow each piece: those whose outlines contain it, and, if it is small, the larger ones next to it.
    pub(super) held: Vec<Vec<usize>>,
    /// Greatest distance of a piece behind the foremost so far, mm; `None` = any.
    pub(super) window: Option<f64>,
    /// Number of events before each piece: pieces stay between the same two events.
    block: Vec<usize>,
    /// Left edge of each piece, mm; `None` if nothing is cut.
    along: Vec<Option<f64>>,
}

impl Rules {
    /// Rules for a marker.
    pub(super) fn of(marker: &Marker, job: &Job) -> Self {
        let nesting = Nesting::of(marker, job.profile.band(marker.unit));
        let pieces = &marker.pieces;
        let mut held: Vec<Vec<usize>> = (0..pieces.len()).map(|piece| nesting.holders(piece)).collect();
        let steady = steady(marker, job);
        if let Some(order) = steady {
            for (held, larger) in held.iter_mut().zip(small::held(marker, &nesting, &order)) {
                held.extend(larger);
                held.sort_unstable();
                held.dedup();
            }
        }
        let asked = pieces.iter().scan(0, |asked, piece| {
            *asked += usize::from(!piece.events.is_empty());
            Some(*asked)
        });
        let extents = pieces.iter().map(|piece| extent(piece, &marker.list));
        let along = extents.map(|extent| (!extent.is_empty()).then_some(extent.min.x)).collect();
        Self { held, window: steady.map(|order| order.window_mm), block: asked.collect(), along }
    }

    /// Number of violations in an order.
    pub(super) fn broken(&self, order: &[usize]) -> usize {
        let mut place = vec![0; order.len()];
        order.iter().enumerate().for_each(|(at, &piece)| place[piece] = at);
        let (mut front, mut block, mut broken) = (f64::NEG_INFINITY, 0, 0);
        for (at, &piece) in order.iter().enumerate() {
            let is_early = |&&holder: &&usize| self.block[holder] == self.block[piece] && place[holder] < at;
            broken += self.held[piece].iter().filter(is_early).count();
            let before = std::mem::replace(&mut block, self.block[piece]);
            if before != block {
                broken += usize::from(block < before);
                front = f64::NEG_INFINITY;
            }
            if let Some(along) = self.along[piece] {
                broken += usize::from(self.window.is_some_and(|window| along < front - window));
                front = front.max(along);
            }
        }
        broken
    }
}

/// Settings of a steady order, if it applies.
fn steady(marker: &Marker, job: &Job) -> Option<Order> {
    let order = job.profile.order;
    (order.policy(marker.drawing.is_some()) == OrderPolicy::Steady).then_some(order)
}

/// Bounding box of a piece.
pub(super) fn extent(piece: &Piece, list: &SegmentList) -> Extent {
    let mut extent = Extent::EMPTY;
    piece.contours.iter().for_each(|contour| extent.join(&Extent::of(&list.points(contour.range))));
    piece.notches.iter().for_each(|notch| extent.join(&Extent::between(notch.root, notch.tip)));
    piece.drills.iter().for_each(|drill| extent.join(&Extent::between(drill.at, drill.at)));
    extent
}
