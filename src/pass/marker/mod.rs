//! Passes over the marker: what is cut, and in which order.
//!
//! Receives a marker as it was read, promises one whose cuts are made, in cut order; what is doubtful is reported. Never knows
//! how the blade moves.

mod bite;
mod centre;
mod cut;
mod inspect;
mod long;
mod near;
mod notch;
mod order;
mod pass;
mod retrace;
mod route;
mod sanity;
mod saved;
mod search;
mod select;
mod severed;
mod sheet;
mod sides;
mod slit;
mod spike;
mod split;
mod stroke;
mod table;
mod visit;
mod weld;

pub use pass::MarkerPass;
pub use saved::saved_by;

/// Every pass over the marker, in order.
pub const MARKER_PASSES: &[MarkerPass] = &[
    weld::PASS,
    retrace::PASS,
    stroke::PASS,
    spike::PASS,
    slit::PASS,
    inspect::PASS,
    order::PASS,
    notch::PASS,
    sanity::PASS,
    sheet::PASS,
    centre::PASS,
    bite::PASS,
    route::PASS,
    select::PASS,
    table::PASS,
    cut::PASS,
    near::PASS,
];

/// How many of the first passes find what is drawn, where the file draws it: the next one lays it on the table.
pub const DRAWN_PASSES: usize = 9;

/// How many of the last passes say how the knife cuts what is drawn: only programs need these.
pub const CUTTING_PASSES: usize = 2;
