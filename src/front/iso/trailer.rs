//! The list of labels behind M0: a line a field, `N,0001` to `L0*`.
//!
//! A record goes to the piece that its L names, or, when it has none, to the one of its N. What stands before the first L
//! belongs to the first record.

use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::ir::marker::{Field, Piece};
use crate::source::{Source, Span};

/// Adds the fields behind `offset` to their pieces.
pub(super) fn read(source: &Source, offset: usize, block: u32, pieces: &mut [Piece], out: &mut Diagnostics) {
    let bytes = source.bytes();
    let mut record = Record::default();
    let mut at = offset.min(bytes.len());
    let mut lost = None;
    while at < bytes.len() {
        let rest = &bytes[at..];
        let length = memchr::memchr(b'\n', rest).unwrap_or(rest.len());
        let line = rest[..length].trim_ascii_end();
        let indent = line.len() - line.trim_ascii_start().len();
        let (start, line) = (at + indent, &line[indent..]);
        at += length + 1;
        match line {
            [b'L', b'0', b'*' | b' ', ..] | [b'L', b'0'] => break,
            &[letter @ b'A'..=b'Z', b',', ..] => {
                let span = Span { start: start as u32 + 2, end: (start + line.len()) as u32, block };
                let names = match letter {
                    b'L' => record.by_l,
                    b'N' => record.by_n,
                    _ => None,
                };
                if names.is_some() {
                    record.close(pieces, &mut lost);
                }
                let number = || std::str::from_utf8(source.slice(span)).ok()?.trim().parse().ok();
                match letter {
                    b'L' => record.by_l = number(),
                    b'N' => record.by_n = number(),
                    _ => {}
                }
                record.fields.push(Field { letter, span });
            }
            _ => {} // asterisks behind M0, blank lines
        }
    }
    record.close(pieces, &mut lost);
    if let Some(span) = lost {
        let message = "the list of labels behind M0 names a piece that the file does not hold";
        out.push(Diagnostic::new(&code::ISO_TRAILER_PIECE, message).at(span));
    }
}

#[derive(Debug, Default)]
struct Record {
    by_l: Option<u32>,
    by_n: Option<u32>,
    fields: Vec<Field>,
}

impl Record {
    /// Gives the fields to their piece and starts anew; `lost` is the first field that found none.
    fn close(&mut self, pieces: &mut [Piece], lost: &mut Option<Span>) {
        let Self { by_l, by_n, mut fields } = std::mem::take(self);
        let Some(first) = fields.first() else { return };
        let number = by_l.or(by_n);
        match pieces.iter_mut().find(|piece| Some(piece.number) == number) {
            Some(piece) => piece.fields.append(&mut fields),
            None => *lost = lost.or(Some(first.span)),
        }
    }
}
