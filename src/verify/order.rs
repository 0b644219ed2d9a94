//! Whether events, holes, slits and contours come in the order of the marker.

use super::worst::{Worst, at};
use crate::geom::Point;
use crate::ir::Finding;
use crate::ir::finding::Sighting;

/// What was told, drilled and cut, each with its time and its rank in the marker.
#[derive(Debug, Default)]
pub(super) struct Order {
    seen: Vec<Seen>,
}

/// Kept small: a marker has a hundred thousand of them.
#[derive(Debug)]
struct Seen {
    tick: u64,
    point: Point,
    rank: u32,
    block: u32,
}

impl Order {
    /// Nothing yet, with room for so many.
    pub(super) fn with_room(count: usize) -> Self {
        Self { seen: Vec::with_capacity(count) }
    }

    /// Something of the marker is told or drilled, or begins to be cut, at a tick.
    pub(super) fn see(&mut self, tick: u64, rank: usize, place: Sighting) {
        let Sighting { point, block, .. } = place;
        let rank = u32::try_from(rank).expect("a source below 4 GiB has fewer than 2^32 lines");
        self.seen.push(Seen { tick, point, rank, block });
    }

    /// Takes what another saw of the same program.
    pub(super) fn add(&mut self, other: Self) {
        self.seen.extend(other.seen);
    }

    /// How many come behind a later one, a tick being that long, s. Holes are known only when the program is over, so all are
    /// brought into time first.
    pub(super) fn finding(mut self, period: f64) -> Finding {
        let mut worst = Worst::new("verify/order", "operations", Some(0.0));
        if !self.seen.is_sorted_by_key(|seen| seen.tick) {
            self.seen.sort_by_key(|seen| seen.tick);
        }
        let (mut greatest, mut late) = (0, 0.0);
        for seen in &self.seen {
            if seen.rank < greatest {
                late += 1.0;
                worst.see(late, || at(seen.tick as f64 * period, seen.point, seen.block));
            }
            greatest = greatest.max(seen.rank);
        }
        worst.finding()
    }
}
