//! Targets: the form that each needs, its writer, and the proof of its bytes.

use std::fmt;
use std::io::{self, Seek, Write};

use crate::diagnostic::{Diagnostic, Diagnostics};
use crate::ir::arcs::{Interpolation, Unfit};
use crate::ir::declaration::{Declaration, Total};
use crate::ir::{self, Arcs, Finding, Marker, Motion, Toolpath};
use crate::machine::Job;
use crate::machine::gcode::Planner;
use crate::source::Source;

/// Output of a target: a file or a buffer; a target may go back to fill in a header.
pub trait Output: Write + Seek {}

impl<T: Write + Seek> Output for T {}

/// Inputs of a program.
#[derive(Debug, Clone, Copy)]
pub struct Context<'a> {
    /// Source file: it holds the texts of labels.
    pub source: &'a Source,
    /// The profile and the options of this compile.
    pub job: &'a Job,
    /// The marker after all passes.
    pub marker: &'a Marker,
}

impl Context<'_> {
    /// True if a conveyor advances the cloth: then setpoints tell the advance.
    pub fn has_bites(&self) -> bool {
        self.job.profile.bite.length_mm.is_some()
    }
}

/// Output format of the cutter: a row of [`TARGETS`](crate::back::TARGETS).
pub type Target = ir::Target<Emit, Proof>;

/// The form that a target needs; the pipeline goes no further.
#[derive(Debug)]
pub enum Emit {
    /// From the marker. Content that the target cannot express is a diagnostic, and then nothing is written.
    Marker(fn(&Context, &mut dyn Output, &mut Diagnostics) -> io::Result<()>),
    /// From toolpaths, one at a time.
    Toolpath(Parts<Toolpath>),
    /// From toolpaths, one at a time, and all findings about them: a picture, which may be of a refused program.
    Picture(Parts<Toolpath>),
    /// From toolpaths as arcs and lines, one toolpath at a time.
    Arcs(ArcTarget),
    /// From the timed motion, one toolpath at a time.
    Motion(Parts<Motion>),
    /// From the timed motion and all findings about it.
    Page(BeginPage),
}

impl Emit {
    /// Choices of moves, of which one is written; none if the target leaves no choice.
    pub(crate) fn choices(&self, job: &Job) -> Vec<Choice> {
        match self {
            Self::Arcs(target) => (target.choices)(job),
            Self::Marker(_) | Self::Toolpath(_) | Self::Picture(_) | Self::Motion(_) | Self::Page(_) => Vec::new(),
        }
    }

    /// True if it is made from toolpaths.
    pub fn needs_toolpaths(&self) -> bool {
        match self {
            Self::Marker(_) => false,
            Self::Toolpath(_) | Self::Picture(_) | Self::Arcs(_) | Self::Motion(_) | Self::Page(_) => true,
        }
    }
}

/// A target that is written in parts: a head, a body for each form, and a tail.
#[derive(Debug)]
pub struct Parts<T> {
    /// Content of the marker or the profile that the target cannot express; called before the first byte. Refusals with the
    /// same message are reported as one.
    pub refusals: fn(&Context) -> Vec<Diagnostic>,
    /// Written first.
    pub head: fn(&Context, &mut dyn Output) -> io::Result<()>,
    /// Written for each form, in order.
    pub body: fn(&T, &Context, &mut dyn Output) -> io::Result<()>,
    /// Written last; may go back to the head.
    pub tail: fn(&Context, Outcome, &mut dyn Output) -> io::Result<()>,
}

/// Result of a compile, for the tail of a program that shows it; empty for programs that do not.
#[derive(Debug, Clone, Copy, Default)]
pub struct Outcome<'a> {
    /// Findings of the verifier in the setpoints of the same compile.
    pub findings: &'a [Finding],
    /// Errors that prevent a program, except for those that the findings tell.
    pub refusals: &'a [&'a Diagnostic],
    /// Totals of its deviations from the drawing.
    pub declared: &'a [Total],
    /// Warnings about some of the pieces.
    pub doubts: &'a [&'a Diagnostic],
    /// All diagnostics, in the order in which they were found.
    pub messages: &'a [&'a Diagnostic],
    /// Single declarations behind the totals of `declared`.
    pub deviations: &'a [Declaration],
    /// True if the verifier judged the setpoints.
    pub is_judged: bool,
    /// Programs that the same compile writes to files; empty when they are refused.
    pub programs: &'a [Beside],
    /// Time of a program among them that its controller plans for itself.
    pub controller: Option<&'a Estimate>,
}

/// Program that is written beside a page about it.
#[derive(Debug)]
pub struct Beside {
    /// Name of its file.
    pub name: String,
    /// BLAKE3 of its bytes, as in its provenance.
    pub blake3: String,
}

/// The refusals of a target that expresses everything.
pub(super) fn nothing(_: &Context) -> Vec<Diagnostic> {
    Vec::new()
}

/// A target whose controller plans for itself.
#[derive(Debug)]
pub struct ArcTarget {
    /// Choices of moves, of which the controller is given the fastest; the first one of equally fast ones. At least one.
    pub choices: fn(&Job) -> Vec<Choice>,
    /// Paths that its controller accepts.
    pub interpolation: fn(&Job) -> Interpolation,
    /// Content that it cannot express; see [`Parts`].
    pub refusals: fn(&Context) -> Vec<Diagnostic>,
    /// Refusal of a run that cannot be expressed as arcs and lines; refusals with the same message are reported as one.
    pub unfit: fn(&Unfit) -> Diagnostic,
    /// Starts a program.
    pub begin: for<'a> fn(&Context<'a>) -> Box<dyn ArcWriter + 'a>,
}

/// A choice of moves for a controller that plans for itself.
#[derive(Debug, Clone)]
pub struct Choice {
    /// Its name in a sentence.
    pub name: String,
    /// The job with such moves.
    pub job: Job,
}

/// A program that takes toolpaths, each with its arcs, in order.
pub trait ArcWriter {
    /// Writes the head.
    fn head(&mut self, out: &mut dyn Output) -> io::Result<()>;
    /// Writes a toolpath.
    fn body(&mut self, toolpath: &Toolpath, arcs: &Arcs, out: &mut dyn Output) -> io::Result<()>;
    /// Writes the tail, and returns an estimate for the controller.
    fn tail(&mut self, out: &mut dyn Output) -> io::Result<Estimate>;
}

/// Start of a page about a program.
pub type BeginPage = for<'a> fn(&Context<'a>) -> Box<dyn PageWriter + 'a>;

/// A page about a program: it takes the motion in order, and is written at the end.
pub trait PageWriter {
    /// Takes the motion of a toolpath.
    fn take(&mut self, motion: &Motion);
    /// Writes the page. If the program was refused before planning, no motion has come.
    fn write(&mut self, outcome: Outcome, out: &mut dyn Output) -> io::Result<()>;
}

/// Estimate for a controller that plans for itself.
#[derive(Debug, Clone, PartialEq)]
pub struct Estimate {
    /// Its duration.
    pub spent: Spent,
    /// Number of arcs and lines with the knife down.
    pub moves: usize,
    /// Planner whose time it is.
    pub planner: Planner,
    /// Number of arcs whose chords deviate more than permitted, because positions have too few decimals for finer ones.
    pub coarse: usize,
    /// Chosen moves and the alternatives; `None` if the profile fixes the moves.
    pub chosen: Option<Chosen>,
}

/// Moves that a program was given because its controller makes them fastest.
#[derive(Debug, Clone, PartialEq)]
pub struct Chosen {
    /// Name of the choice.
    pub name: String,
    /// Other choices with their durations, s, the fastest first; `None` if the file cannot be cut with them within the permitted
    /// deviations.
    pub others: Vec<(String, Option<f64>)>,
}

/// Duration of a program on a controller.
#[derive(Debug, Clone, PartialEq)]
pub struct Spent {
    /// Duration, s.
    pub time: f64,
    /// Limits, each with the time that it costs, s; they add up to the duration. Empty where they are not known.
    pub limits: Vec<(Limit, f64)>,
}

/// Limit of a controller that plans for itself.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Limit {
    /// F, as the speed of the blade.
    Feed,
    /// F, as the number of moves a second that the profile allows.
    Blocks,
    /// Least number of cycles that a controller gives each move.
    Cycles,
    /// Greatest speed of an axis, by its letter.
    Speed(char),
    /// Greatest acceleration of an axis, by its letter: ramps and kinks.
    Acceleration(char),
    /// Number of moves that the planner sees at once.
    LookAhead,
    /// Moves that arrive later than the planner could use them.
    Late,
    /// Rests of the axes.
    Rest,
}

impl fmt::Display for Limit {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Feed => out.write_str("feed"),
            Self::Blocks => out.write_str("moves a second"),
            Self::Cycles => out.write_str("controller cycles"),
            Self::Speed(axis) => write!(out, "speed of {axis}"),
            Self::Acceleration(axis) => write!(out, "acceleration of {axis}"),
            Self::LookAhead => out.write_str("look-ahead"),
            Self::Late => out.write_str("late moves"),
            Self::Rest => out.write_str("rests"),
        }
    }
}

/// How the verifier judges the bytes of a target.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Proof {
    /// As timed setpoints.
    Setpoints,
    /// As positions without time.
    Positions,
    /// As a cutter file with the same content.
    Marker,
}
