//! Writing: a program becomes the bytes of a target; each target is an entry of [`TARGETS`].
//!
//! Receives a planned program. Promises bytes that depend on nothing else. Makes no decisions.

mod chart;
mod dst;
mod exp;
mod html;
mod jef;
mod markup;
mod pes;
mod pulses;
mod queue;
mod stitch_file;
mod svg;
mod target;

pub use target::Target;

/// All targets; the first is the default.
pub const TARGETS: &[Target] = &[
    queue::ROWS,
    queue::JSON,
    pulses::ROWS,
    pulses::RECORDS,
    dst::TARGET,
    exp::TARGET,
    pes::TARGET,
    jef::TARGET,
    svg::TARGET,
    chart::TARGET,
    html::TARGET,
];
