//! The text of an SVG file in UTF-8, as XML is parsed, and the mapping of its offsets to bytes of the file.
//!
//! The encoding is given by a byte order mark or by the XML declaration; the default is UTF-8. UTF-16 and single-byte encodings
//! are converted.

use std::borrow::Cow;

use encoding_rs::{Encoding, UTF_16BE, UTF_16LE};

use crate::diagnostic::{Diagnostic, code};
use crate::source::{Source, Span};

/// Number of bytes at the start of a file that may hold its declaration.
const DECLARED: usize = 200;
/// Number of letters between recorded offsets.
const STRIDE: usize = 256;

/// The text of a file.
pub(super) struct Letters<'a> {
    /// The complete text.
    pub(super) text: Cow<'a, str>,
    /// Width of letters in the file.
    width: Width,
    /// Pairs of offsets in the text and in the file, in order; empty if both are equal.
    marks: Vec<[usize; 2]>,
}

/// Width of letters in the file, bytes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Width {
    /// As in the text.
    Same,
    /// One byte each.
    One,
    /// Two bytes or four.
    Two,
}

/// Encoding of a file.
enum Found {
    Utf8,
    Other(&'static Encoding),
    Unknown(String),
}

impl<'a> Letters<'a> {
    /// Decodes a file; the error says why it cannot be decoded.
    pub(super) fn of(source: &'a Source) -> Result<Self, Diagnostic> {
        let bytes = source.bytes();
        match encoding(bytes) {
            Found::Unknown(name) => {
                let message = format!("the file declares the encoding `{name}`, which is not read");
                Err(Diagnostic::new(&code::SVG_ENCODING, message).hint("save it in UTF-8"))
            }
            Found::Utf8 => match std::str::from_utf8(bytes) {
                Ok(text) => Ok(Self { text: Cow::Borrowed(text), width: Width::Same, marks: Vec::new() }),
                Err(fault) => {
                    let at = fault.valid_up_to() as u32;
                    let span = Span { start: at, end: at + 1, block: 0 };
                    let finding = Diagnostic::new(&code::SVG_ENCODING, "a byte here is no letter of UTF-8").at(span);
                    Err(finding.hint("save the drawing in UTF-8, or let its first line name the encoding"))
                }
            },
            Found::Other(encoding) => {
                let is_wide = encoding == UTF_16BE || encoding == UTF_16LE;
                let mark = if is_wide && matches!(bytes, [0xff, 0xfe, ..] | [0xfe, 0xff, ..]) { 2 } else { 0 };
                let (text, _) = encoding.decode_without_bom_handling(&bytes[mark..]);
                let width = if is_wide { Width::Two } else { Width::One };
                let marks = marks(&text, width, mark);
                Ok(Self { text, width, marks })
            }
        }
    }

    /// Offset in the file of an offset in the text.
    pub(super) fn byte(&self, at: usize) -> u32 {
        if self.width == Width::Same {
            return at as u32;
        }
        let next = self.marks.partition_point(|mark| mark[0] <= at);
        let [from, byte] = self.marks[next.max(1) - 1];
        let letters = self.text.get(from..at).unwrap_or_default().chars();
        (byte + letters.map(|letter| self.width.of(letter)).sum::<usize>()) as u32
    }

    /// Span in the file of a range of the text.
    pub(super) fn span(&self, range: std::ops::Range<usize>, block: u32) -> Span {
        Span { start: self.byte(range.start), end: self.byte(range.end), block }
    }

    /// True if offsets in the file and in the text are equal.
    pub(super) fn are_plain(&self) -> bool {
        self.width == Width::Same
    }
}

impl Width {
    /// Width of a letter, bytes.
    fn of(self, letter: char) -> usize {
        match self {
            Self::Same => letter.len_utf8(),
            Self::One => 1,
            Self::Two => 2 * letter.len_utf16(),
        }
    }
}

/// Pairs of offsets in the text and in the file, one every [`STRIDE`] letters.
fn marks(text: &str, width: Width, start: usize) -> Vec<[usize; 2]> {
    let (mut marks, mut byte) = (Vec::new(), start);
    for (count, (at, letter)) in text.char_indices().enumerate() {
        if count % STRIDE == 0 {
            marks.push([at, byte]);
        }
        byte += width.of(letter);
    }
    if marks.is_empty() { vec![[0, start]] } else { marks }
}

/// The encoding of a file.
fn encoding(bytes: &[u8]) -> Found {
    match bytes {
        [0xef, 0xbb, 0xbf, ..] => return Found::Utf8,
        [0xff, 0xfe, ..] | [b'<', 0, ..] => return Found::Other(UTF_16LE),
        [0xfe, 0xff, ..] | [0, b'<', ..] => return Found::Other(UTF_16BE),
        _ => {}
    }
    let Some(name) = declared(&bytes[..bytes.len().min(DECLARED)]) else { return Found::Utf8 };
    match Encoding::for_label(name) {
        // ASCII is the same in all supported encodings.
        _ if bytes.is_ascii() => Found::Utf8,
        Some(encoding) if encoding == encoding_rs::UTF_8 => Found::Utf8,
        Some(encoding) if encoding.is_single_byte() => Found::Other(encoding),
        _ => Found::Unknown(String::from_utf8_lossy(name).into_owned()),
    }
}

/// The name after `encoding=` in the XML declaration.
fn declared(head: &[u8]) -> Option<&[u8]> {
    let head = head.trim_ascii_start();
    let end = memchr::memmem::find(head, b"?>").filter(|_| head.starts_with(b"<?xml"))?;
    let at = memchr::memmem::find(&head[..end], b"encoding")?;
    let rest = head[at + b"encoding".len()..end].trim_ascii_start().strip_prefix(b"=")?.trim_ascii_start();
    let (quote, rest) = rest.split_first().filter(|(quote, _)| b"\"'".contains(quote))?;
    memchr::memchr(*quote, rest).map(|length| &rest[..length])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(bytes: &[u8], text: &str) {
        let source = Source::new("a.svg", bytes.to_vec()).expect("small");
        let letters = Letters::of(&source).unwrap_or_else(|fault| panic!("{fault:?}"));
        assert_eq!(letters.text.trim_start_matches('\u{feff}'), text);
        // The last letter of the text is the last of the file.
        let last = letters.text.char_indices().last().expect("letters").0;
        let width = match letters.width {
            Width::Same | Width::One => 1,
            Width::Two => 2,
        };
        assert_eq!(letters.byte(last) as usize, bytes.len() - width);
    }

    #[test]
    fn letters_are_read_in_the_encoding_that_the_file_names() {
        check("<svg>ü</svg>".as_bytes(), "<svg>ü</svg>");
        check(b"\xef\xbb\xbf<svg/>", "<svg/>");
        let latin = b"<?xml version='1.0' encoding='ISO-8859-1'?><g id='\xfc'/>";
        check(latin, "<?xml version='1.0' encoding='ISO-8859-1'?><g id='ü'/>");
        let wide = |text: &str| text.encode_utf16().flat_map(u16::to_le_bytes).collect::<Vec<u8>>();
        let long = format!("<g id='{}'/>", "ü".repeat(1000));
        check(&wide(&long), &long);
        check(&[b"\xff\xfe".to_vec(), wide(&long)].concat(), &long);
    }

    #[test]
    fn an_encoding_that_is_not_read_is_refused() {
        for bytes in [b"<?xml encoding=\"GBK\"?>\xc4\xe3".as_slice(), b"<svg>\xfc</svg>"] {
            let source = Source::new("a.svg", bytes.to_vec()).expect("small");
            assert!(Letters::of(&source).is_err_and(|fault| fault.code == &code::SVG_ENCODING));
        }
    }
}
