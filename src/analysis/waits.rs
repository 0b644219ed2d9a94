//! What each piece of a marker waits for, whatever else decides on the order of the cuts.

use super::nesting::Nesting;
use crate::ir::Marker;
use crate::ir::marker::Event;
use crate::machine::MachineProfile;

/// What a piece waits for.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Waits {
    /// The pieces that lie in it, by their places in the marker: once it is free they would shift with it.
    pub inner: Vec<usize>,
    /// What is asked of the operator or the conveyor before it: no piece is brought past that.
    pub events: Vec<Event>,
}

/// What each piece waits for, in the order of the pieces.
pub fn waits(marker: &Marker, profile: &MachineProfile) -> Vec<Waits> {
    let nesting = Nesting::of(marker, profile.band(marker.unit));
    let events = marker.pieces.iter().map(|piece| piece.events.clone());
    let mut all: Vec<Waits> = events.map(|events| Waits { inner: Vec::new(), events }).collect();
    for inner in 0..marker.pieces.len() {
        for holder in nesting.holders(inner).into_iter().filter(|&holder| holder > inner) {
            all[holder].inner.push(inner);
        }
    }
    all
}
