//! Singer XXX: a header of 256 bytes, then pairs of signed bytes, tenths of a millimetre; 7F begins a command: 01 jump, 03
//! trim, 08 and 0A to 17 colour, 18 and 7F end. 7D and 7E begin a jump of two bytes a number.

use super::format::{Format, Input};
use super::moves::Trims;
use super::records::{Form, Record, Records, short_header, signed};
use crate::diagnostic::Diagnostics;
use crate::source::Source;

pub(super) const FORMAT: Format = Format {
    name: "xxx",
    about: "stitch files of Singer machines",
    extensions: &["xxx"],
    record_word: "record",
    is_it: |_, extension| extension == "xxx",
    read,
};

const HEADER_BYTES: usize = 0x100;
const ESCAPE: u8 = 0x7F;

fn read(source: &Source, out: &mut Diagnostics) -> Input {
    let bytes = source.bytes();
    if bytes.len() < HEADER_BYTES {
        return short_header(bytes, "an XXX", out);
    }
    let form = Form { name: "an XXX", parse, has_end: true, trims: Trims::default(), stops: Vec::new() };
    let mut records = Records::new(source, form);
    records.read(HEADER_BYTES..bytes.len(), out);
    records.finish(out)
}

fn parse(bytes: &[u8]) -> Option<(usize, Option<Record>)> {
    match *bytes {
        [0x7D | 0x7E, a, b, c, d, ..] => {
            let way = [[a, b], [c, d]].map(|bytes| i64::from(i16::from_le_bytes(bytes)));
            Some((5, Some(Record::Jump(way))))
        }
        [0x7D | 0x7E, ..] => None,
        [ESCAPE, 0x18 | 0x7F, ..] => Some((2, Some(Record::End))),
        [ESCAPE, command, x, y, ..] => {
            let way = signed(x, y);
            let record = match command {
                0x01 => Some(Record::Jump(way)),
                0x03 => Some(Record::Trim(way)),
                0x08 | 0x0A..=0x17 => Some(Record::Thread(way)),
                _ => None,
            };
            Some((4, record))
        }
        [ESCAPE, ..] => None,
        [x, y, ..] => Some((2, Some(Record::Stitch(signed(x, y))))),
        _ => None,
    }
}
