//! Writing: a program to the bytes of a target, a row of [`TARGETS`] each.
//!
//! Receives what is planned, promises bytes that depend on nothing else, and decides nothing.

mod csv;
mod svg;
mod target;

pub use target::Target;

/// Every target; the first is the one that is judged.
pub const TARGETS: &[Target] = &[csv::TARGET, svg::TARGET];
