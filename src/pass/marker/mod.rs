//! Passes over the marker.

mod cut;
mod inspect;
mod notch;
mod order;
mod pass;
mod sanity;
mod search;
mod select;
mod slit;
mod spike;
mod table;
mod weld;

pub use pass::MarkerPass;

/// Every pass over the marker, in order.
pub const MARKER_PASSES: &[MarkerPass] = &[
    weld::PASS,
    spike::PASS,
    slit::PASS,
    inspect::PASS,
    order::PASS,
    notch::PASS,
    sanity::PASS,
    select::PASS,
    table::PASS,
    cut::PASS,
];
