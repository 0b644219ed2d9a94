//! What a target is: the form that it needs, how it writes it, and how its bytes are judged.

use std::io::{self, Seek, Write};

use crate::diagnostic::{Diagnostic, Diagnostics};
use crate::ir::arcs::{Interpolation, Unfit};
use crate::ir::declaration::{Declaration, Total};
use crate::ir::{self, Arcs, Finding, Marker, Motion, Toolpath};
use crate::machine::Job;
use crate::source::Source;

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

impl Context<'_> {
    /// Whether a conveyor moves the cloth on: then setpoints tell how far.
    pub fn has_bites(&self) -> bool {
        self.job.profile.bite.length_mm.is_some()
    }
}

/// Output format of the cutter: a row of [`TARGETS`](crate::back::TARGETS).
pub type Target = ir::Target<Emit, Proof>;

/// The form that a target needs; the pipeline goes no further.
#[derive(Debug)]
pub enum Emit {
    /// From what the file says. What the target cannot express is a diagnostic, and then nothing is written.
    Marker(fn(&Context, &mut dyn Output, &mut Diagnostics) -> io::Result<()>),
    /// From what the knife does, one toolpath at a time.
    Toolpath(Parts<Toolpath>),
    /// From what the knife does as arcs and lines, one toolpath at a time.
    Arcs(ArcTarget),
    /// From the timed motion, one at a time.
    Motion(Parts<Motion>),
    /// From the timed motion and all that is found out about it.
    Page(BeginPage),
}

impl Emit {
    /// Whether it is made from what the knife does.
    pub fn needs_toolpaths(&self) -> bool {
        match self {
            Self::Marker(_) => false,
            Self::Toolpath(_) | Self::Arcs(_) | Self::Motion(_) | Self::Page(_) => true,
        }
    }
}

/// A target that is written in parts: a head, a body for each form that comes, a tail.
#[derive(Debug)]
pub struct Parts<T> {
    /// What of the marker or the profile it cannot express: asked before the first byte. Refusals with the same message are of
    /// a kind, and told as one.
    pub refusals: fn(&Context) -> Vec<Diagnostic>,
    /// Written first.
    pub head: fn(&Context, &mut dyn Output) -> io::Result<()>,
    /// Written for each form, in order.
    pub body: fn(&T, &Context, &mut dyn Output) -> io::Result<()>,
    /// Written last; may go back to the head.
    pub tail: fn(&Context, Outcome, &mut dyn Output) -> io::Result<()>,
}

/// What is known of a compile when a program that shows it is ended; nothing of one that does not.
#[derive(Debug, Clone, Copy, Default)]
pub struct Outcome<'a> {
    /// Findings of the verifier in the setpoints of the same compile.
    pub findings: &'a [Finding],
    /// Errors for which there is no program, but for those that the findings tell.
    pub refusals: &'a [&'a Diagnostic],
    /// What it does beside the drawing, summed up.
    pub declared: &'a [Total],
    /// Warnings that are about some of the pieces.
    pub doubts: &'a [&'a Diagnostic],
    /// Everything that was said, in the order in which it was found.
    pub messages: &'a [&'a Diagnostic],
    /// Single declarations behind the sums of `declared`.
    pub deviations: &'a [Declaration],
    /// Whether the verifier judged the setpoints.
    pub is_judged: bool,
}

/// The refusals of a target that expresses everything.
pub(super) fn nothing(_: &Context) -> Vec<Diagnostic> {
    Vec::new()
}

/// A target whose controller plans for itself.
#[derive(Debug)]
pub struct ArcTarget {
    /// How its controller can be told a path.
    pub interpolation: fn(&Job) -> Interpolation,
    /// As those of [`Parts`].
    pub refusals: fn(&Context) -> Vec<Diagnostic>,
    /// Says of a run that it cannot be told as arcs and lines; likewise of a kind with others of that message.
    pub unfit: fn(&Unfit) -> Diagnostic,
    /// Begins a program.
    pub begin: for<'a> fn(&Context<'a>) -> Box<dyn ArcWriter + 'a>,
}

/// A program that takes toolpaths, each with its arcs, in order.
pub trait ArcWriter {
    /// Writes what comes first.
    fn head(&mut self, out: &mut dyn Output) -> io::Result<()>;
    /// Writes a toolpath.
    fn body(&mut self, toolpath: &Toolpath, arcs: &Arcs, out: &mut dyn Output) -> io::Result<()>;
    /// Writes what comes last, and says what the controller makes of all.
    fn tail(&mut self, out: &mut dyn Output) -> io::Result<Estimate>;
}

/// Start of a page about a program.
pub type BeginPage = for<'a> fn(&Context<'a>) -> Box<dyn PageWriter + 'a>;

/// A page about a program: it takes the motion in order, and is written when all is known.
pub trait PageWriter {
    /// Takes the motion of a toolpath.
    fn take(&mut self, motion: &Motion);
    /// Writes the page. Of a program that was refused before it was planned no motion has come.
    fn write(&mut self, outcome: Outcome, out: &mut dyn Output) -> io::Result<()>;
}

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
}
