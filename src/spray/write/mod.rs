//! Writing: a program to the bytes of a target, a row of [`TARGETS`] each.
//!
//! Receives what is planned, promises bytes that depend on nothing else, and decides nothing.

mod csv;
mod svg;

use std::io::{self, Write};

use super::program::Program;

/// What a program is written as; it has the name of a target of the cutter.
#[derive(Debug)]
pub struct Target {
    /// The name, as `-t` takes it.
    pub name: &'static str,
    /// What it is here, in a line.
    pub about: &'static str,
    /// Writes it.
    pub write: fn(&Program, &mut dyn Write) -> io::Result<()>,
}

/// Every target; the first is the one that is judged.
pub const TARGETS: &[Target] = &[csv::TARGET, svg::TARGET];
