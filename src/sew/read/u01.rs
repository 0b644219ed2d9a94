//! Barudan U01: a header of 256 bytes, then records of three bytes: command and signs, way of Y, way of X, in tenths of a
//! millimetre.

use super::format::{Format, Input};
use super::moves::Trims;
use super::records::{Form, Record, Records, short_header};
use crate::diagnostic::Diagnostics;
use crate::source::Source;

pub(super) const FORMAT: Format = Format {
    name: "u01",
    about: "stitch files of Barudan machines, with the number of the needle",
    extensions: &["u00", "u01", "u02"],
    record_word: "record",
    is_it: |_, extension| FORMAT.extensions.contains(&extension),
    read,
};

const HEADER_BYTES: usize = 0x100;
const RECORD_BYTES: usize = 3;
/// Bits of the first byte: X to the left, Y down, and the command.
const LEFT: u8 = 0x20;
const DOWN: u8 = 0x40;
const COMMAND: u8 = 0x1F;
/// Command before that of the first needle: a stop.
const STOP: u8 = 0x08;

fn read(source: &Source, out: &mut Diagnostics) -> Input {
    let bytes = source.bytes();
    if bytes.len() < HEADER_BYTES {
        return short_header(bytes, "a U01", out);
    }
    let form = Form { name: "a U01", parse, has_end: true, trims: Trims::default(), stops: Vec::new() };
    let mut records = Records::new(source, form);
    records.read(HEADER_BYTES..bytes.len(), out);
    records.finish(out)
}

fn parse(bytes: &[u8]) -> Option<(usize, Option<Record>)> {
    let [first, y, x, ..] = *bytes else { return None };
    let [x, y] = [x, y].map(i64::from);
    let way = [if first & LEFT == 0 { x } else { -x }, if first & DOWN == 0 { y } else { -y }];
    let command = first & COMMAND;
    let record = match command {
        // 2 and 4 are stitches at a higher and a lower speed, 3 and 5 such jumps.
        0x01 | 0x03 | 0x05 => Some(Record::Jump(way)),
        0x02 | 0x04 if way == [0, 0] => Some(Record::Jump(way)),
        0x00 | 0x02 | 0x04 => Some(Record::Stitch(way)),
        // Of the upper thread, and of both.
        0x06 | 0x07 => Some(Record::Trim(way)),
        STOP => Some(Record::Stop(way)),
        0x09..=0x17 => Some(Record::Needle((command - STOP).into(), way)),
        0x18 => Some(Record::End),
        _ => None,
    };
    Some((RECORD_BYTES, record))
}
