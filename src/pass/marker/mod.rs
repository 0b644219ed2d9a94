//! Passes over the marker: they make the cuts, and put them in order.
//!
//! Receives a marker as it was read, promises one with cuts, in cut order, and reports doubts. Knows nothing of the motion of
//! the blade.

mod bite;
mod centre;
mod cut;
mod far;
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
mod stray;
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

/// Number of the first passes, which work on the drawing in the coordinates of the file: the next one lays it on the table.
pub const DRAWN_PASSES: usize = 9;

/// Number of the last passes, which make the cuts: only programs need these.
pub const CUTTING_PASSES: usize = 2;
