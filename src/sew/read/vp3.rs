//! Husqvarna and Pfaff VP3: a tree of blocks with lengths; each thread has a block with its start and its stitches.
//!
//! Stitches are pairs of signed bytes, tenths of a millimetre, Y downwards; 80 begins a command: 01 a stitch of two bytes a
//! number, also a move with a stitch at its end, 03 trim.

use super::cursor::Cursor;
use super::format::{Format, Input};
use super::moves::{Trims, span};
use super::records::{Form, Record, Records, short_header, signed};
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::front::sewn;
use crate::source::Source;

pub(super) const FORMAT: Format = Format {
    name: "vp3",
    about: "stitch files of Husqvarna Viking and Pfaff machines",
    extensions: &["vp3"],
    record_word: "record",
    is_it: |bytes, _| sewn::is_vp3(bytes),
    read,
};

/// Thousandths of a millimetre, the unit of places, in a tenth.
const PER_TENTH: f64 = 100.0;
const ESCAPE: u8 = 0x80;

fn read(source: &Source, out: &mut Diagnostics) -> Input {
    let bytes = source.bytes();
    let form = Form { name: "a VP3", parse, has_end: false, trims: Trims::default(), stops: Vec::new() };
    let mut records = Records::new(source, form);
    let Some((mut cursor, middle, count)) = header(bytes) else { return short_header(bytes, "a VP3", out) };
    for i in 0..count {
        let block = block(&mut cursor);
        let Some((start, stitches)) = block.filter(|(_, stitches)| stitches.end <= bytes.len()) else {
            let message = format!("the file ends amid the block of thread {} of {count}", i + 1);
            let hint = "the end of the pattern is missing: transfer the file again, and compare sizes";
            let place = span(bytes.len(), 0, 0);
            out.push(Diagnostic::new(&code::SEW_TRUNCATED, message).at(place).hint(hint));
            break;
        };
        let tenths = |axis: usize| ((f64::from(middle[axis]) + f64::from(start[axis])) / PER_TENTH).round() as i64;
        records.begin_block([tenths(0), tenths(1)], i == 0, out);
        cursor.at = stitches.end;
        // A byte of filling ends the block.
        let whole = stitches.start..stitches.end - stitches.len() % 2;
        records.read(whole, out);
    }
    records.finish(out)
}

/// The cursor behind the header, the middle of the pattern in thousandths of a millimetre, and the number of blocks.
fn header(bytes: &[u8]) -> Option<(Cursor<'_>, [i32; 2], u16)> {
    let mut cursor = Cursor::new(bytes, 6);
    text(&mut cursor)?;
    cursor.skip(7)?;
    text(&mut cursor)?;
    cursor.skip(32)?;
    let middle = [cursor.high_32()?, cursor.high_32()?].map(u32::cast_signed);
    cursor.skip(27)?;
    text(&mut cursor)?;
    cursor.skip(24)?;
    text(&mut cursor)?;
    let count = cursor.high_16()?;
    Some((cursor, middle, count))
}

/// Passes over a text with its length.
fn text(cursor: &mut Cursor) -> Option<()> {
    let length = cursor.high_16()?;
    cursor.skip(length.into())
}

/// Start of a block from the middle of the pattern, thousandths of a millimetre, and the range of its stitches.
fn block(cursor: &mut Cursor) -> Option<([i32; 2], std::ops::Range<usize>)> {
    cursor.skip(3)?;
    let length = cursor.high_32()? as usize;
    let end = cursor.at.checked_add(length)?;
    let start = [cursor.high_32()?, cursor.high_32()?].map(u32::cast_signed);
    // The thread: colours of six bytes, two bytes on its kind, its number, name and brand.
    let colors = cursor.byte()?;
    cursor.skip(1 + 6 * usize::from(colors) + 2)?;
    for _ in 0..3 {
        text(cursor)?;
    }
    // The way to the end of the block, and the head of the stitches.
    cursor.skip(18)?;
    (cursor.at <= end).then_some((start, cursor.at..end))
}

fn parse(bytes: &[u8]) -> Option<(usize, Option<Record>)> {
    match *bytes {
        // The last two bytes end the long form.
        [ESCAPE, 0x01, a, b, c, d, _, _, ..] => {
            let [x, y] = [[a, b], [c, d]].map(|bytes| i64::from(i16::from_be_bytes(bytes)));
            Some((8, Some(Record::Long([x, -y]))))
        }
        [ESCAPE, 0x01, ..] => None,
        [ESCAPE, 0x02, ..] => Some((2, Some(Record::Jump([0, 0])))),
        [ESCAPE, 0x03, ..] => Some((2, Some(Record::Trim([0, 0])))),
        [ESCAPE, _, ..] => Some((2, None)),
        [x, y, ..] => {
            let [x, y] = signed(x, y);
            Some((2, Some(Record::Stitch([x, -y]))))
        }
        _ => None,
    }
}
