//! Brother PEC, alone or within PES: a header with a table of threads, then pairs of numbers, tenths of a millimetre, Y
//! downwards.
//!
//! A number has one byte of seven bits, or two of twelve bits that begin with 1 and flags: 10 jump, 20 trim and jump. FE B0 is
//! another thread, FF the end. Two threads of the same number in a row stand for a stop. Only the PEC part of a PES file is
//! sewn; the rest is for editing.

use super::cursor::Cursor;
use super::format::{Format, Input};
use super::moves::{Trims, span};
use super::records::{Form, Record, Records, short_header};
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::front::sewn;
use crate::source::Source;

pub(super) const PES: Format = Format {
    name: "pes",
    about: "stitch files of Brother machines; their part PEC is read",
    extensions: &["pes"],
    record_word: "record",
    is_it: |bytes, _| sewn::is_pes(bytes),
    read,
};

pub(super) const PEC: Format = Format {
    name: "pec",
    about: "stitch files of older Brother machines",
    extensions: &["pec"],
    record_word: "record",
    is_it: |bytes, _| sewn::is_pec(bytes),
    read,
};

/// Offset of the part PEC in a PEC file; a PES file has it as a number behind its mark.
const MARK_BYTES: usize = 8;
/// Start of the part PEC.
const LABEL: &[u8] = b"LA:";
/// Offsets from that start: of the number of changes of thread, and of the stitches. The table of threads is between.
const CHANGES_AT: usize = 48;
const STITCHES_AT: usize = 528;
/// Number of changes that stands for no thread.
const NO_THREADS: u8 = 0xFF;

fn read(source: &Source, out: &mut Diagnostics) -> Input {
    let bytes = source.bytes();
    let told = if sewn::is_pec(bytes) {
        Some(MARK_BYTES)
    } else {
        Cursor::new(bytes, MARK_BYTES).low_32().map(|at| at as usize)
    };
    let header = told.and_then(|start| Some((start, bytes.get(start..start.checked_add(STITCHES_AT)?)?)));
    let Some((start, header)) = header else { return short_header(bytes, "a PES or PEC", out) };
    if !header.starts_with(LABEL) {
        let message = format!("the part PEC, which machines sew, is not at byte {start}, where the header has it");
        let hint = "the file is damaged: let the embroidery program save it again";
        out.push(Diagnostic::new(&code::SEW_RECORD, message).at(span(start, LABEL.len(), 0)).hint(hint));
    }
    let changes = header[CHANGES_AT];
    let count = if changes == NO_THREADS { 0 } else { usize::from(changes) + 1 };
    let stops = header[CHANGES_AT + 1..][..count].windows(2).map(|pair| pair[0] == pair[1]).collect();
    let form = Form { name: "a PEC", parse, has_end: true, trims: Trims::default(), stops };
    let mut records = Records::new(source, form);
    let first = start + STITCHES_AT;
    records.read(first + start_bytes(&bytes[first..])..bytes.len(), out);
    records.finish(out)
}

/// Length of the place of the start before the stitches: the way from the left upper corner of all records, in the form of a
/// jump. Some programs leave it out.
fn start_bytes(bytes: &[u8]) -> usize {
    let Some((length, Some(Record::Jump(told)))) = parse(bytes) else { return 0 };
    let (mut at, mut place, mut corner) = (length, [0, 0], [i64::MAX, i64::MIN]);
    while let Some((length, Some(record))) = parse(&bytes[at..]) {
        let way = match record {
            Record::Stitch(way) | Record::Jump(way) | Record::Trim(way) => way,
            _ => [0, 0],
        };
        if let Record::End = record {
            break;
        }
        place = [place[0] + way[0], place[1] + way[1]];
        corner = [corner[0].min(place[0]), corner[1].max(place[1])];
        at += length;
    }
    let is_start = [0, 1].iter().all(|&axis| told[axis].checked_add(corner[axis]) == Some(0));
    if is_start { length } else { 0 }
}

fn parse(bytes: &[u8]) -> Option<(usize, Option<Record>)> {
    match *bytes {
        [0xFF, ..] => return Some((1, Some(Record::End))),
        [0xFE, 0xB0, ..] => return (bytes.len() > 2).then_some((3, Some(Record::Thread([0, 0])))),
        _ => {}
    }
    let mut cursor = Cursor::new(bytes, 0);
    let (x, y) = (number(&mut cursor)?, number(&mut cursor)?);
    let (way, flags) = ([x.0, -y.0], x.1 | y.1);
    let record = match flags & 0x30 {
        0x00 => Record::Stitch(way),
        0x20 => Record::Trim(way),
        _ => Record::Jump(way),
    };
    Some((cursor.at, Some(record)))
}

/// A number and the flags of its long form.
fn number(cursor: &mut Cursor) -> Option<(i64, u8)> {
    let first = cursor.byte()?;
    if first & 0x80 == 0 {
        // Seven bits with a sign.
        return Some((i64::from((first << 1).cast_signed() >> 1), 0));
    }
    let both = u16::from_be_bytes([first, cursor.byte()?]);
    Some((i64::from((both << 4).cast_signed() >> 4), first))
}
