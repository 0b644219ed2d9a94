//! Writing: one of the three forms to the bytes of a target.
//!
//! Receives sound forms, promises bytes that depend on nothing else, and refuses what a target cannot express before
//! the first byte. Never decides anything about the cut.

use std::io::{self, Seek, Write};

use crate::diagnostic::{Diagnostic, Diagnostics};
use crate::ir::{Finding, Marker, Motion, Toolpath};
use crate::machine::Job;
use crate::source::Source;

mod counts;
mod csv;
mod gcode;
mod hal;
mod halrun;
mod iso;
mod json;
mod npy;
mod svg;

/// Where a target writes: a file or a buffer; it may go back to fill in a header.
pub trait Output: Write + Seek {}

impl<T: Write + Seek> Output for T {}

/// What a program is made from.
#[derive(Debug, Clone, Copy)]
pub struct Context<'a> {
    /// What it was read from: the texts of labels stand there.
    pub source: &'a Source,
    /// The machine and the options of this compile.
    pub job: &'a Job,
    /// What is cut, after all passes.
    pub marker: &'a Marker,
}

/// An output format: a row of [`TARGETS`].
#[derive(Debug)]
pub struct Target {
    /// Name, as `-t` takes it.
    pub name: &'static str,
    /// What it is, in a line.
    pub about: &'static str,
    /// Extension of its files, without the dot.
    pub extension: &'static str,
    /// The form that it needs, and how it writes it.
    pub emit: Emit,
    /// How its bytes are judged.
    pub proof: Proof,
}

/// The form that a target needs; the pipeline goes no further.
#[derive(Debug)]
pub enum Emit {
    /// From what the file says. What the target cannot express is a diagnostic, and then nothing is written.
    Marker(fn(&Context, &mut dyn Output, &mut Diagnostics) -> io::Result<()>),
    /// From what the knife does, one toolpath at a time.
    Toolpath(Parts<Toolpath>),
    /// From what the knife does, in two steps: each toolpath by itself, then all of them in order.
    Fit(Fit),
    /// From the timed motion, one at a time.
    Motion(Parts<Motion>),
}

impl Emit {
    /// Whether it is made from what the knife does.
    pub fn needs_toolpaths(&self) -> bool {
        match self {
            Self::Marker(_) => false,
            Self::Toolpath(_) | Self::Fit(_) | Self::Motion(_) => true,
        }
    }
}

/// A target that is written in parts: a head, a body for each form that comes, a tail.
#[derive(Debug)]
pub struct Parts<T> {
    /// Written first.
    pub head: fn(&Context, &mut dyn Output) -> io::Result<()>,
    /// Written for each form, in order.
    pub body: fn(&T, &Context, &mut dyn Output) -> io::Result<()>,
    /// Written last, with what the verifier found in the setpoints of the same compile, or why there is no program; may
    /// go back to the head.
    pub tail: fn(&Context, &[Finding], &mut dyn Output) -> io::Result<()>,
}

/// A target whose controller plans for itself.
#[derive(Debug)]
pub struct Fit {
    /// What the axes do along a toolpath; what the target cannot express is refused, cut by cut: refusals with the same
    /// message are of a kind, and told as one. One may be made beside another.
    pub ways: fn(&Toolpath, &Job) -> Result<Ways, Vec<Diagnostic>>,
    /// Begins a program.
    pub begin: for<'a> fn(&Context<'a>) -> Box<dyn Fitting + 'a>,
}

/// A program that takes toolpaths, each with its ways, in order.
pub trait Fitting {
    /// Writes what comes first.
    fn head(&mut self, out: &mut dyn Output) -> io::Result<()>;
    /// Writes a toolpath.
    fn body(&mut self, toolpath: &Toolpath, ways: &Ways, out: &mut dyn Output) -> io::Result<()>;
    /// Writes what comes last, and says what the controller makes of all.
    fn tail(&mut self, out: &mut dyn Output) -> io::Result<Estimate>;
}

/// What the axes do along a toolpath, for a controller that plans for itself.
#[derive(Debug)]
pub struct Ways(Vec<gcode::Way>);

/// What a controller that plans for itself makes of a program.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Estimate {
    /// Its duration, s.
    pub time: f64,
    /// Arcs and lines with the knife down.
    pub moves: usize,
}

/// How the verifier judges a target's bytes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Proof {
    /// As timed setpoints.
    Setpoints,
    /// As positions without time.
    Positions,
    /// As a cutter file that must say the same.
    Marker,
    /// Not at all: a picture or a summary; the verdict is that on the setpoints.
    None,
}

/// Every target; the first is the default.
pub const TARGETS: &[Target] = &[
    csv::TARGET,
    npy::TARGET,
    json::TARGET,
    svg::TARGET,
    iso::TARGET,
    counts::TARGET,
    hal::TARGET,
    halrun::TARGET,
    gcode::TARGET,
];

/// The timed setpoints that are made to be judged when a target's own bytes are none.
pub const SETPOINTS: Parts<Motion> = csv::PARTS;
