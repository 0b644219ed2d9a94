//! What a format of sewing machines is.

use crate::diagnostic::Diagnostics;
use crate::sew::pattern::Pattern;
use crate::sew::stitches::Stitches;
use crate::source::Source;

/// A format of sewing machines: a row of [`FORMATS`](super::FORMATS).
#[derive(Debug)]
pub struct Format {
    /// Name, as `--from` takes it.
    pub name: &'static str,
    /// What it is, in a line.
    pub about: &'static str,
    /// What names of such files end in, without the dot.
    pub extensions: &'static [&'static str],
    /// What its records are called, as in "record 3".
    pub record_word: &'static str,
    /// Whether a file is one, by its bytes and the extension of its name.
    pub is_it: fn(&[u8], &str) -> bool,
    /// Reads it.
    pub read: fn(&Source, &mut Diagnostics) -> Input,
}

/// What a file says.
#[derive(Debug)]
pub enum Input {
    /// Lines to be sewn.
    Pattern(Pattern),
    /// Needle points, with the speeds that the file asks for.
    Stitches(Stitches, Vec<Speed>),
}

/// A speed that a file asks for, from a record on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Speed {
    /// The record, from 1.
    pub record: u32,
    /// Stitches a minute.
    pub rpm: f64,
}

/// The largest coordinate or increment of a text, mm: no machine is as large.
pub(super) const FARTHEST: f64 = 1e4;
