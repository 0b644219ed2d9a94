//! Constraints on the order of the pieces of a marker that hold under every policy.

use super::nesting::Nesting;
use crate::ir::Marker;
use crate::ir::marker::Event;
use crate::machine::MachineProfile;

/// Prerequisites of a piece.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Waits {
    /// Pieces that lie in it, by their indices in the marker: once it is free they would shift with it.
    pub inner: Vec<usize>,
    /// Events that ask something of the operator or the conveyor before it; the order never moves a piece past them.
    pub events: Vec<Event>,
}

/// Prerequisites of each piece, in the order of the pieces.
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
