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

/// What some programs write before text in UTF-8.
const BYTE_ORDER_MARK: &[u8] = b"\xef\xbb\xbf";

/// Whether the first line of a text is this one, in capital letters or small ones and whatever blanks are between, or begins
/// with it.
pub(super) fn begins_with(bytes: &[u8], header: &[u8]) -> bool {
    let bytes = bytes.strip_prefix(BYTE_ORDER_MARK).unwrap_or(bytes);
    let mut known = header.iter();
    for byte in bytes.iter().filter(|byte| !matches!(byte, b' ' | b'\t')) {
        match known.next() {
            None => return true,
            Some(known) if known.eq_ignore_ascii_case(byte) => {}
            Some(_) => return false,
        }
    }
    known.next().is_none()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_header_is_known_behind_the_mark_that_spreadsheets_write() {
        for (text, is_known) in
            [("op,x\n", true), ("\u{feff}OP,X", true), ("op, x\r\n", true), ("op", false), ("\u{feff}xop,x", false)]
        {
            assert_eq!(begins_with(text.as_bytes(), b"op,x"), is_known, "{text:?}");
        }
    }
}
