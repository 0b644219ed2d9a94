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

/// What some programs write before text in UTF-8.
const BYTE_ORDER_MARK: &[u8] = b"\xef\xbb\xbf";

/// Whether the first line of a text is this one, in capital letters or small ones, or begins with it.
pub(super) fn begins_with(bytes: &[u8], header: &[u8]) -> bool {
    let bytes = bytes.strip_prefix(BYTE_ORDER_MARK).unwrap_or(bytes);
    bytes.get(..header.len()).is_some_and(|first| first.eq_ignore_ascii_case(header))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_header_is_known_behind_the_mark_that_spreadsheets_write() {
        for (text, is_known) in [("op,x\n", true), ("\u{feff}OP,X", true), ("op", false), ("\u{feff}xop,x", false)] {
            assert_eq!(begins_with(text.as_bytes(), b"op,x"), is_known, "{text:?}");
        }
    }
}
