//! The list of labels after M0: one field per line, from `N,0001` to `L0*`.
//!
//! A record belongs to the piece named by its L or, without an L, by its N. Fields before the first L belong to the first
//! record.

use std::collections::BTreeMap;

use super::block::Blocks;
use super::label;
use super::meaning::{Meaning, meaning};
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::ir::marker::{Field, Piece};
use crate::source::{Source, Span};

/// Adds the fields after `offset` to their pieces.
pub(super) fn read(source: &Source, offset: usize, block: u32, pieces: &mut [Piece], out: &mut Diagnostics) {
    let bytes = source.bytes();
    if bytes.get(offset..).is_none_or(|behind| behind.trim_ascii().is_empty()) {
        return; // the usual case
    }
    let mut record = Record::default();
    let mut places: BTreeMap<u32, usize> = BTreeMap::new();
    for (piece, place) in pieces.iter().zip(0..) {
        places.entry(piece.number).or_insert(place); // the first of two jobs in one file
    }
    let mut target = Target { pieces, places, lost: None };
    let mut at = offset.min(bytes.len());
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
                    record.close(&mut target);
                }
                let number = || std::str::from_utf8(source.slice(span)).ok()?.trim().parse().ok();
                match letter {
                    b'L' => record.by_l = number(),
                    b'N' => record.by_n = number(),
                    _ => {}
                }
                record.fields.push(Field { letter, span });
            }
            _ => {} // asterisks after M0, blank lines
        }
    }
    record.close(&mut target);
    if let Some(span) = target.lost {
        let message = "the list of labels behind M0 names a piece that the file does not hold";
        out.push(Diagnostic::new(&code::ISO_TRAILER_PIECE, message).at(span));
    }
}

/// Offset after the last block that lowers the knife or drills; 0 if there is none.
pub(super) fn last_cut(mut blocks: Blocks<'_>) -> usize {
    let mut last = 0;
    while let Some(block) = blocks.next() {
        let Ok(words) = block.words else { continue };
        for &code in &words.codes {
            match meaning(code) {
                Meaning::Down | Meaning::Drill(_) => last = blocks.offset(),
                Meaning::Message => _ = blocks.next_text(),
                Meaning::Label => _ = label::read(&mut blocks, words.point),
                _ => {}
            }
        }
    }
    last
}

/// Destination of the fields.
struct Target<'a> {
    pieces: &'a mut [Piece],
    /// Index of the piece with each number.
    places: BTreeMap<u32, usize>,
    /// The first field without a piece.
    lost: Option<Span>,
}

#[derive(Debug, Default)]
struct Record {
    by_l: Option<u32>,
    by_n: Option<u32>,
    fields: Vec<Field>,
}

impl Record {
    /// Adds the fields to their piece and clears the record.
    fn close(&mut self, target: &mut Target<'_>) {
        let Self { by_l, by_n, mut fields } = std::mem::take(self);
        let Some(first) = fields.first() else { return };
        match by_l.or(by_n).and_then(|number| target.places.get(&number)) {
            Some(&place) => target.pieces[place].fields.append(&mut fields),
            None => target.lost = target.lost.or(Some(first.span)),
        }
    }
}
