//! Row of a target of a head, its writer and its reader.

use std::io::{self, BufRead, Write};

use crate::ir;
use crate::ir::verdict::Verdict;
use crate::machine::Job;
use crate::spray::program::Program;
use crate::verify::spray::Ground;

/// Output format of a head: a row of [`TARGETS`](super::TARGETS), with the name of a target of the cutter.
pub type Target = ir::Target<Writer, Reader>;

/// Writer of programs.
#[derive(Debug)]
pub struct Writer {
    /// True if it shows the program of another planner in addition.
    pub compares: bool,
    /// Writes a program.
    pub write: fn(&Program, &mut dyn Write) -> io::Result<()>,
}

/// Judge of a program by its bytes.
pub type Reader = fn(&mut dyn BufRead, &Ground, &Job) -> io::Result<Verdict>;
