//! Events: what the controller or the operator is asked for comes as often, of the kind and in the order that the marker
//! has it, with the knife up.
//!
//! A conveyor moves the cloth on at rows that tell an advance alone, and there by the way that the marker has.

use crate::geom::Point;
use crate::ir::toolpath::Event;
use crate::ir::verdict::{Sighting, Worst};
use crate::ir::{Finding, Marker};
use crate::verify::program::row::Row;
use crate::verify::reference::lines::Reference;
use crate::verify::reference::order::Seen;
use crate::verify::rules;

/// An event of the marker.
#[derive(Debug, Clone, Copy)]
struct Asked {
    /// Its number in a row.
    number: u8,
    /// Way of the cloth, mm.
    way: u32,
    /// Where it stands in the file.
    block: u32,
    /// Its rank among events, holes, slits and contours.
    rank: usize,
}

/// Watches the column `event`.
pub(in crate::verify) struct Events {
    asked: Vec<Asked>,
    /// How many of them were told.
    told: usize,
    /// Way of the cloth so far, mm.
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

    /// Sees a row; each that tells an event tells one, which joins what was `told`. What is told and not asked for is
    /// one too many.
    pub(in crate::verify) fn see(&mut self, row: &Row, told: &mut Vec<Seen>) {
        let before = std::mem::replace(&mut self.station, row.station);
        if row.event == 0 && row.station == before {
            return; // as nearly all
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

    /// What was found; what was asked for and never told is missing.
    pub(in crate::verify) fn finding(mut self) -> Finding {
        for asked in &self.asked[self.told..] {
            self.wrong += 1.0;
            self.worst.see(self.wrong, || Sighting::missing(Point::origin(), asked.block));
        }
        self.worst.finding()
    }
}

/// The events of a marker in order, by their numbers in rows, their ways of the cloth and their blocks.
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
