//! Writing: a program to the bytes of a target, a row of [`TARGETS`] each, and the plan that tells which head has which.
//!
//! Receives a program, promises bytes that depend on nothing else, and decides nothing.

mod csv;
mod html;
mod markup;
mod npy;
mod plan;
mod svg;
mod target;
mod timing;

pub use plan::{File, Plan, describe};
pub use target::{Emit, Target};

/// Every target; the first is the default.
pub const TARGETS: &[Target] = &[csv::TARGET, npy::TARGET, svg::TARGET, timing::TARGET, html::TARGET];
