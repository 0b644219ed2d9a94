//! Row of a target of sewn patterns, and its writer.

use std::io::{self, Write};

use crate::diagnostic::Diagnostics;
use crate::ir;
use crate::machine::Job;
use crate::sew::program::Program;
use crate::sew::verify::Bytes;

/// Output format of patterns: a row of [`TARGETS`](super::TARGETS). A picture shows the verdict on the pulses.
pub type Target = ir::Target<Writer, Bytes>;

/// Writer of programs.
#[derive(Debug)]
pub struct Writer {
    /// Refusals of content that the format cannot express, before the first byte.
    pub refusals: fn(&Program, &Job, &mut Diagnostics),
    /// Writes a program.
    pub write: fn(&Program, &Job, &mut dyn Write) -> io::Result<()>,
}

impl Writer {
    /// Writer of a format that expresses every program.
    pub(super) const fn of_all(write: fn(&Program, &Job, &mut dyn Write) -> io::Result<()>) -> Self {
        Self { refusals: |_, _, _| {}, write }
    }
}
