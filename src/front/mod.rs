//! Reading: bytes of a dialect to a [`Marker`].
//!
//! Receives a [`Source`] and promises a marker in mm in which nobody need think any more about the dialect: its units,
//! line breaks, codes and layouts. Everything keeps the span that it came from. Faults are reported all in one run;
//! a marker with an error among the diagnostics is never compiled. Never guesses silently, never does I/O.

use crate::diagnostic::Diagnostics;
use crate::ir::Marker;
use crate::machine::Job;
use crate::source::Source;

/// An input format: a row of [`DIALECTS`].
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
    pub read: fn(&Source, &Job, &mut Diagnostics) -> Marker,
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

/// Every dialect, the likelier ones first.
pub const DIALECTS: &[Dialect] = &[];
