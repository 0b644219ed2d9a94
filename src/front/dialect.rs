//! Definition of an input dialect.

use crate::diagnostic::Diagnostics;
use crate::ir::{Drawing, Marker};
use crate::machine::Job;
use crate::source::Source;

/// An input format: an entry of [`DIALECTS`](super::DIALECTS).
#[derive(Debug)]
pub struct Dialect {
    /// Name, used by `--from` and for the folder of its fixtures.
    pub name: &'static str,
    /// One-line description.
    pub about: &'static str,
    /// Usual extensions of its files, without the dot.
    pub extensions: &'static [&'static str],
    /// Rates how well the first bytes of a file match the dialect.
    pub sniff: fn(&[u8]) -> Likeness,
    /// Checks the bytes against the grammar, ignoring meaning.
    pub syntax: fn(&Source, &mut Diagnostics),
    /// Reader of the dialect, by its kind of result.
    pub read: Read,
    /// Effects of its codes; empty for a dialect without codes.
    pub words: &'static [Word],
}

/// A group of codes with the same effect.
#[derive(Debug)]
pub struct Word {
    /// The codes as markdown: "`A`, `M15`", or a range, "`M60` to `M67`".
    pub words: &'static str,
    /// Effect of the codes.
    pub about: &'static str,
}

/// Reader of a dialect, by the content of its files.
#[derive(Debug, Clone, Copy)]
pub enum Read {
    /// Files that state the cut lines.
    Marker(fn(&Source, &Job, &mut Diagnostics) -> Marker),
    /// Files of pen strokes, from which the cut lines must be recognised.
    Drawing(fn(&Source, &Job, &mut Diagnostics) -> Drawing),
    /// Files of both kinds: their layers state the cut lines.
    Patterns {
        /// Reads the cut lines.
        cut: fn(&Source, &Job, &mut Diagnostics) -> Marker,
        /// Reads the complete drawing, with layers as pens.
        drawn: fn(&Source, &Job, &mut Diagnostics) -> Drawing,
        /// Name of the layer with the seam lines.
        seams: &'static str,
    },
}

/// Degree to which bytes match a dialect.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Likeness {
    /// The bytes cannot be of the dialect.
    No,
    /// The bytes may be of the dialect.
    Maybe,
    /// The bytes are of the dialect.
    Sure,
}
