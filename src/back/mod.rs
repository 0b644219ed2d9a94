//! Writers: from one of the forms to the bytes of a target.
//!
//! The input is a sound form. The output depends on nothing else, and anything that a target cannot express is refused before
//! the first byte. Writers take no decisions about the cut.

mod counts;
mod csv;
mod gcode;
mod hal;
mod halrun;
mod html;
mod iso;
mod json;
mod npy;
mod states;
mod svg;
mod target;

pub use target::{
    ArcTarget, ArcWriter, BeginPage, Beside, Choice, Chosen, Context, Emit, Estimate, Limit, Outcome, Output,
    PageWriter, Parts, Proof, Spent, Target,
};

use crate::ir::Motion;

/// All targets; the first is the default.
pub const TARGETS: &[Target] = &[
    csv::TARGET,
    npy::TARGET,
    json::TARGET,
    states::TARGET,
    svg::TARGET,
    html::TARGET,
    iso::TARGET,
    counts::TARGET,
    hal::TARGET,
    halrun::TARGET,
    gcode::TARGET,
];

/// The timed setpoints to verify when the bytes of a target are not setpoints.
pub const SETPOINTS: Parts<Motion> = csv::PARTS;
