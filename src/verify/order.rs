//! Whether events, holes, slits and contours come in the order of the marker.

use super::worst::Worst;
use crate::ir::Finding;
use crate::ir::finding::Sighting;

/// What was told, drilled and cut, each with its time and its rank in the marker.
#[derive(Debug, Default)]
pub(super) struct Order {
    seen: Vec<Seen>,
}

#[derive(Debug)]
struct Seen {
    tick: u64,
    rank: usize,
    place: Sighting,
}

impl Order {
    /// Something of the marker is told or drilled, or begins to be cut, at a tick.
    pub(super) fn see(&mut self, tick: u64, rank: usize, place: Sighting) {
        self.seen.push(Seen { tick, rank, place });
    }

    /// Takes what another saw of the same program.
    pub(super) fn add(&mut self, other: Self) {
        self.seen.extend(other.seen);
    }

    /// How many come behind a later one. Holes are known only when the program is over, so all are brought into time first.
    pub(super) fn finding(mut self) -> Finding {
        let mut worst = Worst::new("verify/order", "operations", Some(0.0));
        self.seen.sort_by_key(|seen| seen.tick);
        let (mut greatest, mut late) = (0, 0.0);
        for seen in &self.seen {
            if seen.rank < greatest {
                late += 1.0;
                worst.see(late, || seen.place);
            }
            greatest = greatest.max(seen.rank);
        }
        worst.finding()
    }
}
