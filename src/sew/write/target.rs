//! What a target of sewn patterns is.

use std::io::{self, Write};

use crate::diagnostic::Diagnostics;
use crate::machine::Job;
use crate::sew::program::Program;
use crate::sew::verify::Bytes;

/// What a program is written as: a row of [`TARGETS`](super::TARGETS).
#[derive(Debug)]
pub struct Target {
    /// Name, as `-t` takes it.
    pub name: &'static str,
    /// What it is, in a line.
    pub about: &'static str,
    /// What its files end in, without the first dot.
    pub extension: &'static str,
    /// Says what it cannot express, before the first byte.
    pub refusals: fn(&Program, &Job, &mut Diagnostics),
    /// Writes it.
    pub write: fn(&Program, &Job, &mut dyn Write) -> io::Result<()>,
    /// How its bytes are judged; `None` of pictures: the pulses of the same program are.
    pub proof: Option<Bytes>,
}

/// For targets that can express everything.
pub(super) fn nothing(_: &Program, _: &Job, _: &mut Diagnostics) {}
