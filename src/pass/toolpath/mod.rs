//! Passes over the toolpath of one contour, notch or drill.
//!
//! [`trace()`] makes a toolpath of one run as it is in the file. The passes split it at corners, give it overlaps, and place
//! it. They take the cloth around it, the [`Scene`], into account: an overlap goes into the waste.

mod bend;
mod bow;
mod continuation;
mod corner;
mod down;
mod ends;
mod entry;
mod frame;
mod junctions;
mod lap;
mod meet;
mod near;
mod nibble;
mod overlap;
mod pass;
mod place;
mod plunge;
mod ring;
mod root;
mod runs;
mod scene;
mod slow;
mod spare;
mod start;
mod stretch;
mod tight;
mod tight_report;
mod trace;
mod turn;
mod wind;
mod worst;

pub use frame::frame;
pub use pass::ToolpathPass;
pub use scene::Scene;
pub use trace::trace;

/// Every pass over a toolpath, in order.
pub const TOOLPATH_PASSES: &[ToolpathPass] = &[
    corner::PASS,
    ring::PASS,
    bend::PASS,
    down::PASS,
    wind::PASS,
    entry::PASS,
    tight::PASS,
    turn::PASS,
    slow::PASS,
    overlap::PASS,
    plunge::PASS,
    place::PASS,
    meet::PASS,
];
