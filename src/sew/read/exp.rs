//! Melco EXP: pairs of signed bytes, tenths of a millimetre; 0x80 begins a command: 01 colour, 02 stitch, 04 jump, 80 trim.

use super::format::{Format, Input};
use super::moves::Trims;
use super::records::{Form, Record, Records, signed};
use crate::diagnostic::Diagnostics;
use crate::source::Source;

pub(super) const FORMAT: Format = Format {
    name: "exp",
    about: "stitch files of Melco machines",
    extensions: &["exp"],
    record_word: "record",
    is_it: |_, extension| extension == "exp",
    read,
};

const ESCAPE: u8 = 0x80;

fn read(source: &Source, out: &mut Diagnostics) -> Input {
    let form = Form { name: "an EXP", parse, has_end: false, trims: Trims::default(), stops: Vec::new() };
    let mut records = Records::new(source, form);
    records.read(0..source.bytes().len(), out);
    records.finish(out)
}

fn parse(bytes: &[u8]) -> Option<(usize, Option<Record>)> {
    match *bytes {
        [ESCAPE, command, x, y, ..] => {
            let way = signed(x, y);
            let record = match command {
                0x01 => Some(Record::Thread(way)),
                // A stitch after an escape, as some systems write it.
                0x02 => Some(Record::Stitch(way)),
                0x04 => Some(Record::Jump(way)),
                // The bytes after a trim are filling.
                0x80 => Some(Record::Trim([0, 0])),
                _ => None,
            };
            Some((4, record))
        }
        [ESCAPE, ..] => None,
        [x, y, ..] => Some((2, Some(Record::Stitch(signed(x, y))))),
        _ => None,
    }
}
