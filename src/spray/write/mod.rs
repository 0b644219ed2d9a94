//! Writing: a program to the bytes of a target, a row of [`TARGETS`] each.
//!
//! Receives a program, promises bytes that depend on nothing else, and decides nothing.

mod csv;
mod svg;
mod target;

pub use target::{Reader, Target};

/// Every target; the first is the default.
pub const TARGETS: &[Target] = &[csv::TARGET, svg::TARGET];
