//! Definition of a format of sewing machines.

use crate::diagnostic::Diagnostics;
use crate::sew::pattern::Pattern;
use crate::sew::stitches::Stitches;
use crate::source::Source;

/// A format of sewing machines: an entry of [`FORMATS`](super::FORMATS).
#[derive(Debug)]
pub struct Format {
    /// Name, used by `--from`.
    pub name: &'static str,
    /// One-line description.
    pub about: &'static str,
    /// Extensions of its file names, without the dot.
    pub extensions: &'static [&'static str],
    /// Word for its records, as in "record 3".
    pub record_word: &'static str,
    /// Recognises a file by its bytes and the extension of its name.
    pub is_it: fn(&[u8], &str) -> bool,
    /// Reads a file.
    pub read: fn(&Source, &mut Diagnostics) -> Input,
}

/// Content of a file.
#[derive(Debug)]
pub enum Input {
    /// Lines to be sewn.
    Pattern(Pattern),
    /// Needle points, with the speeds stated in the file.
    Stitches(Stitches, Vec<Speed>),
}

/// A speed stated in a file, valid from a record on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Speed {
    /// Number of the record, from 1.
    pub record: u32,
    /// Stitches per minute.
    pub rpm: f64,
}

/// Maximum coordinate or increment in a text, mm: no machine is larger.
pub(super) const FARTHEST: f64 = 1e4;
