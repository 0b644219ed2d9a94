//! Row of a machine: its tables, and the functions by which commands use it.

use std::io::{self, BufRead};

use crate::diagnostic::Diagnostics;
use crate::front::Dialect;
use crate::ir::Target;
use crate::ir::verdict::Rule;
use crate::machine::{Job, ToolKind};
use crate::pipeline::{Choices, Compiled, Declared, Estimated, Explained, Input, Medium, Product};
use crate::sew::Asked;
use crate::source::Source;
use crate::units::MM_PER_M;

/// A machine of the sewing floor: a row of [`MACHINES`](super::MACHINES).
#[derive(Debug)]
pub struct Machine {
    /// Name, as options take it.
    pub name: &'static str,
    /// Description in a line.
    pub about: &'static str,
    /// Verb for the work of its programs.
    pub works: &'static str,
    /// Planner of `cutc compile`; `None` for a machine with a command of its own.
    pub tool: Option<Tool>,
    /// Formats of its programs; the first is the default.
    pub targets: fn() -> Vec<Listed>,
    /// Promises that its programs keep.
    pub rules: &'static [&'static Rule],
    /// True if `--line` and `--inset` choose what is made of a file, and the knife's options have no effect.
    pub is_sewn: bool,
    /// True if a program is one of its own, by name or provenance.
    pub claims: fn(Claim) -> bool,
    /// Reason why it cannot do a job, and what to do about it.
    pub refusal: fn(&Job) -> Option<[&'static str; 2]>,
    /// Files that the bytes of a program name, with their digests; `None` if each program is one file.
    pub parts: Option<Parts>,
    /// Reads a source and finds its faults for this machine; `None` when nothing can be read.
    pub check: fn(&Source, &Asked, &Job, &mut Diagnostics) -> Option<Checked>,
    /// Judges a program by a source; returns `None` when the source has errors, which the diagnostics tell. `None` for a
    /// machine whose programs are judged only while they are written.
    pub judge: Option<Judge>,
}

/// Names, in the bytes of a program, of the files that belong to it.
pub type Parts = fn(&[u8]) -> Vec<Part>;

/// Compiler of a source to programs; `None` when there are errors, which the diagnostics tell.
pub type Compile = fn(&Source, &Job, Choices, &mut [Product], &mut Diagnostics) -> io::Result<Option<Compiled>>;

/// Judge of programs that were written before.
pub type Judge = fn(&mut Written, &Source, &Asked, &Job, &mut Diagnostics) -> io::Result<Option<Explained>>;

/// Planner of a machine that `cutc compile` makes programs for.
#[derive(Debug)]
pub struct Tool {
    /// Tools of a profile that make it this machine.
    pub kinds: &'static [ToolKind],
    /// Compiles a source to programs, as [`compile_all`](crate::pipeline::compile_all) does.
    pub compile: Compile,
    /// Makes the cuts of an input before planning.
    pub cuts: fn(&mut Input, &Source, &Job, &mut Diagnostics),
    /// Figures of the program of an input with its cuts.
    pub estimate: fn(&mut Input, &Source, &Job, &mut Diagnostics) -> io::Result<Estimated>,
}

/// Row of a table of targets, without its functions.
#[derive(Debug, Clone, Copy)]
pub struct Listed {
    /// Name, as `-t` takes it.
    pub name: &'static str,
    /// Description in a line.
    pub about: &'static str,
    /// Ending of its files, without the first dot.
    pub extension: &'static str,
    /// True if its bytes are read back and judged.
    pub is_judged: bool,
}

/// The rows of a table of targets, without their functions.
pub(super) fn listed<E, P>(targets: &[Target<E, P>]) -> Vec<Listed> {
    let listed = |&Target { name, about, extension, ref proof, .. }: &Target<E, P>| {
        let is_judged = proof.is_some();
        Listed { name, about, extension, is_judged }
    };
    targets.iter().map(listed).collect()
}

/// Name and provenance of a program.
#[derive(Debug, Clone, Copy)]
pub struct Claim<'a> {
    /// Name of its file, in lower case.
    pub name: &'a str,
    /// Target in its provenance; `None` of a program without one.
    pub target: Option<&'a str>,
}

/// A program that was written before.
pub struct Written<'a> {
    /// Name and provenance.
    pub claim: Claim<'a>,
    /// Its bytes.
    pub bytes: &'a mut dyn Medium,
    /// Opens a file in its folder, by name.
    pub open: &'a (dyn Fn(&str) -> io::Result<Box<dyn BufRead>> + Sync),
    /// Deviations that its provenance declares; `None` of a program without any such list.
    pub declared: Option<&'a Declared>,
}

/// A file that a program names beside itself.
#[derive(Debug)]
pub struct Part {
    /// Name in the folder of the program.
    pub name: String,
    /// Digest of its bytes by BLAKE3, if it is named with one.
    pub blake3: Option<String>,
}

/// Contents of a source for a machine.
#[derive(Debug)]
pub struct Checked {
    /// Dialect, or format of the machine.
    pub format: &'static str,
    /// Number of pieces; `None` if the source is no marker.
    pub pieces: Option<usize>,
    /// Length of its cuts, m; `None` if the source is no marker.
    pub cut_m: Option<f64>,
}

/// The dialect that was asked for.
pub(super) fn dialect(asked: &Asked) -> Option<&'static Dialect> {
    asked.from.as_deref().and_then(crate::front::by_name)
}

impl Checked {
    /// Contents of an input that becomes a marker.
    pub(super) fn of(input: &Input) -> Self {
        let (pieces, cut_m) = (input.marker.piece_count(), input.marker.cut_length() / MM_PER_M);
        Self { format: input.dialect.name, pieces: Some(pieces), cut_m: Some(cut_m) }
    }
}
