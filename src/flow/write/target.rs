//! Row of a target of heads over a conveyor, and its writer.

use std::io::{self, Write};

use crate::flow::program::{Head, Program};
use crate::ir::{self, Marker};
use crate::verify::flow::Bytes;

/// Output format of heads over a conveyor: a row of [`TARGETS`](super::TARGETS).
pub type Target = ir::Target<Emit, Bytes>;

/// Writer of a plan.
#[derive(Debug, Clone, Copy)]
pub enum Emit {
    /// A file for each head.
    Heads(fn(&Program, &Head, &mut dyn Write) -> io::Result<()>),
    /// One file, a picture.
    Whole {
        /// Name without its extension.
        stem: &'static str,
        /// Writes it.
        write: fn(&Program, &Marker, &mut dyn Write) -> io::Result<()>,
    },
}

impl Target {
    /// The file of a head, by its place in the plan, or the only one.
    pub fn file(&self, head: usize) -> String {
        match self.emit {
            Emit::Heads(_) => format!("head-{:02}.{}", head + 1, self.extension),
            Emit::Whole { stem, .. } => format!("{stem}.{}", self.extension),
        }
    }
}
