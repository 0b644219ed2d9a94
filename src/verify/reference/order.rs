//! Check of the order of events, holes, slits and contours, and of cuts inside a part before the part comes free.

use std::ops::Range;

use super::held::Held;
use super::line::Line;
use crate::ir::Finding;
use crate::ir::verdict::{Sighting, Worst};
use crate::verify::rules;

/// Events, holes and strokes, each with its time and its rank in the marker.
#[derive(Debug)]
pub(in crate::verify) struct Order<'a> {
    lines: &'a [Line<'a>],
    /// Strokes in time order: a large marker has a hundred thousand of them.
    strokes: Vec<Begun>,
    /// Places of strokes that begin after a stroke of greater rank, each with its index in `strokes`.
    late: Vec<(usize, Sighting)>,
    /// Greatest rank of a stroke so far.
    greatest: u32,
    /// Events and holes so far.
    told: Vec<Seen>,
}

/// Start of the cut of a line.
#[derive(Debug, Clone, Copy)]
struct Begun {
    tick: u64,
    line: u32,
}

/// Event or hole of the marker in the program.
#[derive(Debug, Clone, Copy)]
pub(in crate::verify) struct Seen {
    pub(in crate::verify) tick: u64,
    /// Rank in the marker.
    pub(in crate::verify) rank: usize,
    pub(in crate::verify) place: Sighting,
}

impl<'a> Order<'a> {
    /// Empty order for these lines.
    pub(in crate::verify) fn new(lines: &'a [Line<'a>]) -> Self {
        // A line usually is one stroke.
        let strokes = Vec::with_capacity(lines.len());
        Self { lines, strokes, late: Vec::new(), greatest: 0, told: Vec::new() }
    }

    /// Records that the cut of a line begins at a tick, which must not be earlier than the previous one.
    pub(in crate::verify) fn cut(&mut self, tick: u64, line: usize, place: Sighting) {
        let rank = self.lines[line].rank;
        if rank < self.greatest {
            self.late.push((self.strokes.len(), place));
        }
        self.greatest = self.greatest.max(rank);
        self.strokes.push(Begun { tick, line: line as u32 });
    }

    /// Adds events and holes.
    pub(in crate::verify) fn add(&mut self, told: Vec<Seen>) {
        self.told.extend(told);
    }

    /// Findings on the number of items out of order, and on cuts in a part that is already free; `period` is the length of a
    /// tick, s.
    pub(in crate::verify) fn findings(self, held: &[Held], period: f64) -> [Finding; 2] {
        let freed = self.freed(held, period);
        [self.late(period), freed]
    }

    /// Finding on the number of parts in which something is cut or drilled after the last cut of the outline.
    fn freed(&self, held: &[Held], period: f64) -> Finding {
        let mut worst = Worst::new(&rules::FREED, Some(0.0));
        let strokes = self.strokes.iter().map(|&Begun { tick, line }| {
            let line = &self.lines[line as usize];
            Seen { tick, rank: line.rank as usize, place: Sighting::at(0.0, line.point(0), line.block(0)) }
        });
        // Last item of each rank.
        let mut last: Vec<Option<Seen>> = Vec::new();
        for seen in strokes.chain(self.told.iter().copied()) {
            last.resize(last.len().max(seen.rank + 1), None);
            if last[seen.rank].is_none_or(|known| known.tick <= seen.tick) {
                last[seen.rank] = Some(seen);
            }
        }
        let of_ranks = |ranks: &Range<u32>| {
            let end = (ranks.end as usize).min(last.len());
            let seen = last[(ranks.start as usize).min(end)..end].iter().flatten();
            seen.max_by_key(|seen| seen.tick).copied()
        };
        let mut count = 0.0;
        for Held { inner, outline } in held {
            let (Some(inner), Some(outline)) = (of_ranks(inner), of_ranks(outline)) else { continue };
            if inner.tick > outline.tick {
                count += 1.0;
                worst.see(count, || Sighting { time: Some(inner.tick as f64 * period), ..inner.place });
            }
        }
        worst.finding()
    }

    /// Finding on the number of items out of order. Holes are known only at the end of the program, so all items are merged by
    /// time first.
    fn late(mut self, period: f64) -> Finding {
        let mut worst = Worst::new(&rules::ORDER, Some(0.0));
        let (mut greatest, mut late) = (0, 0.0);
        let mut see = |Seen { tick, rank, place }: Seen| {
            if rank < greatest {
                late += 1.0;
                worst.see(late, || Sighting { time: Some(tick as f64 * period), ..place });
            }
            greatest = greatest.max(rank);
        };
        self.told.sort_by_key(|seen| seen.tick);
        let (mut told, mut places) = (self.told.into_iter().peekable(), self.late.into_iter().peekable());
        for (i, Begun { tick, line }) in self.strokes.into_iter().enumerate() {
            while let Some(before) = told.next_if(|told| told.tick < tick) {
                see(before);
            }
            let line = &self.lines[line as usize];
            // An item that is late only against holes and events is shown at the start of its line.
            let place = places.next_if(|late| late.0 == i).map(|late| late.1);
            let place = place.unwrap_or_else(|| Sighting::at(0.0, line.point(0), line.block(0)));
            see(Seen { tick, rank: line.rank as usize, place });
        }
        told.for_each(see);
        worst.finding()
    }
}
