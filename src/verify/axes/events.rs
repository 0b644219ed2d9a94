//! Events: what the controller or the operator is asked for comes as often, of the kind and in the order that the marker
//! has it, with the knife up.
//!
//! A conveyor moves the cloth on as often as it likes: no drawing asks for that, and where the cloth then lies is judged by what
//! is cut. It runs forwards, only at a row that tells the event, and only where the profile has one.

use crate::geom::Point;
use crate::ir::toolpath::Event;
use crate::ir::verdict::{Sighting, Worst};
use crate::ir::{Finding, Marker};
use crate::machine::MachineProfile;
use crate::verify::program::row::Row;
use crate::verify::reference::lines::Reference;
use crate::verify::reference::order::Seen;
use crate::verify::rules;

/// An event of the marker.
#[derive(Debug, Clone, Copy)]
struct Asked {
    /// Its number in a row.
    number: u8,
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
    /// How far the cloth was moved on so far, mm.
    station: u32,
    has_conveyor: bool,
    wrong: f64,
    worst: Worst,
}

impl Events {
    pub(in crate::verify) fn new(reference: &Reference, profile: &MachineProfile) -> Self {
        let asked = asked(reference.marker).zip(&reference.events);
        let asked = asked.map(|((number, block), &rank)| Asked { number, block, rank });
        let asked = asked.filter(|asked| asked.number > 0).collect();
        let (station, has_conveyor) = (reference.marker.moved_on, profile.bite.length_mm.is_some());
        Self { asked, told: 0, station, has_conveyor, wrong: 0.0, worst: Worst::new(&rules::EVENTS, Some(0.0)) }
    }

    /// Sees a row; each that tells an event tells one, which joins what was `told`. What is told and not asked for is
    /// one too many.
    pub(in crate::verify) fn see(&mut self, row: &Row, told: &mut Vec<Seen>) {
        let before = std::mem::replace(&mut self.station, row.station);
        if row.event == 0 && row.station == before {
            return; // as nearly all
        }
        let is_up = !row.knife && row.drill == 0;
        let asked = self.asked.get(self.told).filter(|asked| asked.number == row.event && !row.knife);
        if self.has_conveyor && row.event == ADVANCE && row.station > before && is_up {
            return;
        }
        if let Some(asked) = asked.filter(|_| row.station == before) {
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

/// Number of an advance in rows.
const ADVANCE: u8 = 2;

/// The events of a marker in order, by their numbers in rows, and their blocks; 0 of those that no drawing asks for.
fn asked(marker: &Marker) -> impl Iterator<Item = (u8, u32)> {
    let events = marker.pieces.iter().flat_map(|piece| &piece.events).chain(&marker.closing);
    events.map(|event| {
        let number = match event.kind {
            Event::Stop => 1,
            Event::Advance => ADVANCE,
            Event::Bite(_) => 0,
        };
        (number, event.span.block)
    })
}
