//! What a target of sewn patterns is.

use std::io::{self, Write};

use crate::diagnostic::Diagnostics;
use crate::machine::Job;
use crate::sew::program::Program;

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
    /// How its bytes are judged.
    pub proof: Proof,
}

/// How the bytes of a target are judged.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Proof {
    /// As pulses, rows of text.
    PulseRows,
    /// As pulses, records.
    PulseRecords,
    /// As entries of a queue, rows of text.
    QueueRows,
    /// As entries of a queue, JSON.
    QueueJson,
    /// As a DST file.
    Dst,
    /// As an EXP file.
    Exp,
    /// Pictures: the pulses of the same program are judged.
    None,
}

/// For targets that can express everything.
pub(super) fn nothing(_: &Program, _: &Job, _: &mut Diagnostics) {}
