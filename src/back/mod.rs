//! Writing: one of the forms to the bytes of a target.
//!
//! Receives sound forms, promises bytes that depend on nothing else, and refuses what a target cannot express before
//! the first byte. Never decides anything about the cut.

mod counts;
mod csv;
mod gcode;
mod hal;
mod halrun;
mod html;
mod iso;
mod json;
mod npy;
mod svg;
mod target;

pub use target::{
    ArcTarget, ArcWriter, BeginPage, Context, Emit, Estimate, Outcome, Output, PageWriter, Parts, Proof, Target,
};

use crate::ir::Motion;

/// Every target; the first is the default.
pub const TARGETS: &[Target] = &[
    csv::TARGET,
    npy::TARGET,
    json::TARGET,
    svg::TARGET,
    html::TARGET,
    iso::TARGET,
    counts::TARGET,
    hal::TARGET,
    halrun::TARGET,
    gcode::TARGET,
];

/// The timed setpoints that are made to be judged when a target's own bytes are none.
pub const SETPOINTS: Parts<Motion> = csv::PARTS;
