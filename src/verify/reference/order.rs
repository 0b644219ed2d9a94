//! Whether events, holes, slits and contours come in the order of the marker, and what lies in a part before it comes free.

use std::ops::Range;

use super::held::Held;
use super::line::Line;
use crate::ir::Finding;
use crate::ir::verdict::{Sighting, Worst};
use crate::verify::rules;

/// What was told, drilled and cut, each with its time and its rank in the marker.
#[derive(Debug)]
pub(in crate::verify) struct Order<'a> {
    lines: &'a [Line<'a>],
    /// The strokes, in time: a large marker has a hundred thousand of them.
    strokes: Vec<Begun>,
    /// Where those began that come behind a later one, each with its place among them.
    late: Vec<(usize, Sighting)>,
    /// The greatest rank of them so far.
    greatest: u32,
    /// Events and holes.
    told: Vec<Seen>,
}

/// When a line begins to be cut.
#[derive(Debug, Clone, Copy)]
struct Begun {
    tick: u64,
    line: u32,
}

/// Something else of the marker that is told or drilled.
#[derive(Debug, Clone, Copy)]
pub(in crate::verify) struct Seen {
    pub(in crate::verify) tick: u64,
    /// Its rank in the marker.
    pub(in crate::verify) rank: usize,
    pub(in crate::verify) place: Sighting,
}

impl<'a> Order<'a> {
    /// Nothing yet, of these lines.
    pub(in crate::verify) fn new(lines: &'a [Line<'a>]) -> Self {
        // A line is one stroke, as a rule.
        let strokes = Vec::with_capacity(lines.len());
        Self { lines, strokes, late: Vec::new(), greatest: 0, told: Vec::new() }
    }

    /// A line begins to be cut somewhere at a tick, no earlier than the one before.
    pub(in crate::verify) fn cut(&mut self, tick: u64, line: usize, place: Sighting) {
        let rank = self.lines[line].rank;
        if rank < self.greatest {
            self.late.push((self.strokes.len(), place));
        }
        self.greatest = self.greatest.max(rank);
        self.strokes.push(Begun { tick, line: line as u32 });
    }

    /// Takes what was told and drilled.
    pub(in crate::verify) fn add(&mut self, told: Vec<Seen>) {
        self.told.extend(told);
    }

    /// How many come behind a later one, and how many in a part that is free, a tick being that long, s.
    pub(in crate::verify) fn findings(self, held: &[Held], period: f64) -> [Finding; 2] {
        let freed = self.freed(held, period);
        [self.late(period), freed]
    }

    /// How many are cut or drilled in a part behind the last cut of its outline.
    fn freed(&self, held: &[Held], period: f64) -> Finding {
        let mut worst = Worst::new(&rules::FREED, Some(0.0));
        let strokes = self.strokes.iter().map(|&Begun { tick, line }| {
            let line = &self.lines[line as usize];
            Seen { tick, rank: line.rank as usize, place: Sighting::at(0.0, line.point(0), line.block(0)) }
        });
        // When the last of each rank begins.
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

    /// How many come behind a later one. Holes are known only when the program is over, so all are brought into time first.
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
            // What is late against holes and events alone is shown where its line begins.
            let place = places.next_if(|late| late.0 == i).map(|late| late.1);
            let place = place.unwrap_or_else(|| Sighting::at(0.0, line.point(0), line.block(0)));
            see(Seen { tick, rank: line.rank as usize, place });
        }
        told.for_each(see);
        worst.finding()
    }
}
