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
    /// Needle points.
    Stitches(Stitches),
}
