//! Events for the controller or the operator: their number, kinds and order must agree with the marker, and the knife must be
//! up.
//!
//! A conveyor advances the cloth only at rows with the event advance, and by the length given in the marker.

use crate::geom::Point;
use crate::ir::toolpath::Event;
use crate::ir::verdict::{Sighting, Worst};
use crate::ir::{Finding, Marker};
use crate::verify::program::row::Row;
use crate::verify::reference::lines::Reference;
use crate::verify::reference::order::Seen;
use crate::verify::rules;

/// Event of the marker.
#[derive(Debug, Clone, Copy)]
struct Asked {
    /// Number of the event in rows.
    number: u8,
    /// Advance of the cloth, mm.
    way: u32,
    /// Block of the event in the file.
    block: u32,
    /// Rank among events, holes, slits and contours.
    rank: usize,
}

/// Check of the column `event`.
pub(in crate::verify) struct Events {
    asked: Vec<Asked>,
    /// Number of events of `asked` that the rows have reached.
    told: usize,
    /// Advance of the cloth so far, mm.
    station: u32,
    wrong: f64,
    worst: Worst,
}

impl Events {
    pub(in crate::verify) fn new(reference: &Reference) -> Self {
        let asked = asked(reference.marker).zip(&reference.events);
        let asked = asked.map(|((number, way, block), &rank)| Asked { number, way, block, rank }).collect();
        let station = reference.marker.moved_on;
        Self { asked, told: 0, station, wrong: 0.0, worst: Worst::new(&rules::EVENTS, Some(0.0)) }
    }

    /// Processes a row. An expected event is added to `told`; an unexpected one counts as wrong.
    pub(in crate::verify) fn see(&mut self, row: &Row, told: &mut Vec<Seen>) {
        let before = std::mem::replace(&mut self.station, row.station);
        if row.event == 0 && row.station == before {
            return; // the usual case
        }
        let is_told = |asked: &&Asked| asked.number == row.event && row.station.checked_sub(before) == Some(asked.way);
        if let Some(asked) = self.asked.get(self.told).filter(|asked| is_told(asked) && !row.knife) {
            self.told += 1;
            told.push(Seen { tick: row.tick, rank: asked.rank, place: row.sighting() });
        } else {
            self.wrong += 1.0;
            self.worst.see(self.wrong, || row.sighting());
        }
    }

    /// Finding; events that were not reached are missing.
    pub(in crate::verify) fn finding(mut self) -> Finding {
        for asked in &self.asked[self.told..] {
            self.wrong += 1.0;
            self.worst.see(self.wrong, || Sighting::missing(Point::origin(), asked.block));
        }
        self.worst.finding()
    }
}

/// Events of a marker in order: number in rows, advance of the cloth, mm, and block.
fn asked(marker: &Marker) -> impl Iterator<Item = (u8, u32, u32)> {
    let events = marker.pieces.iter().flat_map(|piece| &piece.events).chain(&marker.closing);
    events.map(|event| {
        let number = match event.kind {
            Event::Stop => 1,
            Event::Advance | Event::AdvanceBy(_) => 2,
        };
        (number, event.kind.advance_mm(), event.span.block)
    })
}
