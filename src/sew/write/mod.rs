//! Writing: a program to the bytes of a target, a row of [`TARGETS`] each.
//!
//! Receives what is planned, promises bytes that depend on nothing else, and decides nothing.

mod chart;
mod dst;
mod exp;
mod html;
mod markup;
mod pulses;
mod queue;
mod stitch_file;
mod svg;
mod target;

pub use target::Target;

/// Every target; the first is the default.
pub const TARGETS: &[Target] = &[
    queue::ROWS,
    queue::JSON,
    pulses::ROWS,
    pulses::RECORDS,
    dst::TARGET,
    exp::TARGET,
    svg::TARGET,
    chart::TARGET,
    html::TARGET,
];
