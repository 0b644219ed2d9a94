//! What a dialect is.

use crate::diagnostic::Diagnostics;
use crate::ir::{Drawing, Marker};
use crate::machine::Job;
use crate::source::Source;

/// An input format: a row of [`DIALECTS`](super::DIALECTS).
#[derive(Debug)]
pub struct Dialect {
    /// Name, as `--from` takes it and as the folder of its fixtures is called.
    pub name: &'static str,
    /// What it is, in a line.
    pub about: &'static str,
    /// Usual extensions of its files, without the dot.
    pub extensions: &'static [&'static str],
    /// How much a file's first bytes look like it.
    pub sniff: fn(&[u8]) -> Likeness,
    /// Whether the bytes follow the grammar, without regard to meaning.
    pub syntax: fn(&Source, &mut Diagnostics),
    /// Reads the file.
    pub read: Read,
    /// What each of its codes does; none where it has no codes.
    pub words: &'static [Word],
}

/// Codes of a dialect that do the same.
#[derive(Debug)]
pub struct Word {
    /// The codes, as markdown: "`A`, `M15`", or a range, "`M60` to `M67`".
    pub words: &'static str,
    /// What is done about them.
    pub about: &'static str,
}

/// What a dialect says.
#[derive(Debug, Clone, Copy)]
pub enum Read {
    /// What is cut.
    Marker(fn(&Source, &Job, &mut Diagnostics) -> Marker),
    /// What a pen draws: what of it is cut must be recognised.
    Drawing(fn(&Source, &Job, &mut Diagnostics) -> Drawing),
    /// Both: its layers say what is cut.
    Patterns {
        /// What is cut.
        cut: fn(&Source, &Job, &mut Diagnostics) -> Marker,
        /// All that is drawn, with the layers as pens.
        drawn: fn(&Source, &Job, &mut Diagnostics) -> Drawing,
        /// Name of the layer that has the seam lines.
        seams: &'static str,
    },
}

/// How much some bytes look like a dialect.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Likeness {
    /// It cannot be.
    No,
    /// Nothing speaks against it.
    Maybe,
    /// It is.
    Sure,
}
