//! What a target of heads over a conveyor is.

use std::io::{self, Write};

use crate::flow::program::{Head, Program};
use crate::ir::Marker;
use crate::verify::flow::Bytes;

/// What a program is written as: a row of [`TARGETS`](super::TARGETS).
#[derive(Debug)]
pub struct Target {
    /// Name, as `-t` takes it.
    pub name: &'static str,
    /// What it is, in a line.
    pub about: &'static str,
    /// What its files end in, without the first dot.
    pub extension: &'static str,
    /// What is written.
    pub kind: Kind,
}

/// What is written.
#[derive(Debug, Clone, Copy)]
pub enum Kind {
    /// A file a head, which is judged from its bytes.
    Heads {
        /// Writes it.
        write: fn(&Program, &Head, &mut dyn Write) -> io::Result<()>,
        /// How it is judged.
        bytes: Bytes,
    },
    /// One file, a picture.
    Whole {
        /// What it is called, without its extension.
        stem: &'static str,
        /// Writes it.
        write: fn(&Program, &Marker, &mut dyn Write) -> io::Result<()>,
    },
}

impl Target {
    /// The file of a head, by its place in the plan, or the only one.
    pub fn file(&self, head: usize) -> String {
        match self.kind {
            Kind::Heads { .. } => format!("head-{:02}.{}", head + 1, self.extension),
            Kind::Whole { stem, .. } => format!("{stem}.{}", self.extension),
        }
    }
}
