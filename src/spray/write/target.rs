//! What a target of a head is.

use std::io::{self, Write};

use crate::spray::program::Program;

/// What a program is written as; it has the name of a target of the cutter.
#[derive(Debug)]
pub struct Target {
    /// The name, as `-t` takes it.
    pub name: &'static str,
    /// What it is here, in a line.
    pub about: &'static str,
    /// Whether it shows what another planner makes of the same.
    pub compares: bool,
    /// Writes it.
    pub write: fn(&Program, &mut dyn Write) -> io::Result<()>,
}
