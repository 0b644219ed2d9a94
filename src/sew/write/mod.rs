//! Writing: a program to the bytes of a target, a row of [`TARGETS`] each.
//!
//! Receives what is planned, promises bytes that depend on nothing else, and decides nothing.

mod chart;
mod dst;
mod exp;
mod html;
mod markup;
mod pulses;
mod queue;
mod stitch_file;
mod svg;

use std::io::{self, Write};

use super::program::Program;
use crate::diagnostic::Diagnostics;
use crate::machine::Job;

/// What a program is written as: a row of [`TARGETS`].
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

/// Every target; the first is the default.
pub const TARGETS: &[Target] = &[
    queue::ROWS,
    queue::JSON,
    pulses::ROWS,
    pulses::RECORDS,
    dst::TARGET,
    exp::TARGET,
    svg::TARGET,
    chart::TARGET,
    html::TARGET,
];

/// For targets that can express everything.
fn nothing(_: &Program, _: &Job, _: &mut Diagnostics) {}
