//! Janome JEF: a header with a table of threads, then pairs of signed bytes, tenths of a millimetre; 0x80 begins a command: 01
//! colour, 02 jump, 10 end.
//!
//! A jump that moves nothing is a trim, and machines also cut the thread at long jumps. A thread of number 0 in the table
//! stands for a stop.

use super::cursor::Cursor;
use super::format::{Format, Input};
use super::moves::Trims;
use super::records::{Form, Record, Records, short_header, signed};
use crate::diagnostic::Diagnostics;
use crate::front::sewn;
use crate::source::Source;

pub(super) const FORMAT: Format = Format {
    name: "jef",
    about: "stitch files of Janome machines",
    extensions: &["jef"],
    record_word: "record",
    is_it: |bytes, extension| extension == "jef" || sewn::is_jef(bytes),
    read,
};

/// Offsets of the number of threads and of their table.
const COUNT_AT: usize = 24;
const TABLE_AT: usize = 116;
/// Jumps that cut the thread: over more than 3 mm.
const TRIMS: Trims = Trims { jumps: None, way: Some(30) };
const ESCAPE: u8 = 0x80;

fn read(source: &Source, out: &mut Diagnostics) -> Input {
    let bytes = source.bytes();
    let Some((start, stops)) = header(bytes) else { return short_header(bytes, "a JEF", out) };
    let mut records = Records::new(source, Form { name: "a JEF", parse, has_end: true, trims: TRIMS, stops });
    records.read(start..bytes.len(), out);
    records.finish(out)
}

/// Offset of the stitches, and the changes of thread that are stops.
fn header(bytes: &[u8]) -> Option<(usize, Vec<bool>)> {
    let start = Cursor::new(bytes, 0).low_32()? as usize;
    let count = Cursor::new(bytes, COUNT_AT).low_32()? as usize;
    let mut table = Cursor::new(bytes, TABLE_AT);
    // A file is no longer than its table says; the first thread is that of the start.
    let threads = (0..count.min(bytes.len() / 4)).map(|_| table.low_32()).collect::<Option<Vec<u32>>>()?;
    Some((start, threads.iter().skip(1).map(|&thread| thread == 0).collect()))
}

fn parse(bytes: &[u8]) -> Option<(usize, Option<Record>)> {
    match *bytes {
        [ESCAPE, 0x10, ..] => Some((2, Some(Record::End))),
        [ESCAPE, command, x, y, ..] => {
            let way = signed(x, y);
            let record = match command {
                0x01 => Some(Record::Thread(way)),
                0x02 if way == [0, 0] => Some(Record::Trim(way)),
                0x02 => Some(Record::Jump(way)),
                _ => None,
            };
            Some((4, record))
        }
        [ESCAPE, ..] => None,
        [x, y, ..] => Some((2, Some(Record::Stitch(signed(x, y))))),
        _ => None,
    }
}
