//! Melco EXP: pairs of signed bytes, tenths of a millimetre; 0x80 begins a command: 01 colour, 02 stitch, 04 jump, 80 trim.

use super::format::{Format, Input};
use super::moves::{Moves, span};
use crate::diagnostic::{Diagnostic, Diagnostics, code};
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
const COLOR: u8 = 0x01;
/// A stitch after an escape, as some systems write it.
const STITCH: u8 = 0x02;
const JUMP: u8 = 0x04;
const TRIM: u8 = 0x80;

fn read(source: &Source, out: &mut Diagnostics) -> Input {
    let mut moves = Moves::new(None);
    let bytes = source.bytes();
    let (mut at, mut record) = (0, 0);
    while at < bytes.len() {
        record += 1;
        let is_command = bytes[at] == ESCAPE;
        let length = if is_command { 4 } else { 2 };
        let Some(words) = bytes.get(at..at + length) else {
            let message = format!("the file ends amid record {record}");
            let hint = "the end of the pattern is missing: transfer the file again, and compare sizes";
            let place = span(at, bytes.len() - at, record);
            out.push(Diagnostic::new(&code::SEW_TRUNCATED, message).at(place).hint(hint));
            break;
        };
        let way = [words[length - 2], words[length - 1]].map(|byte| i64::from(byte.cast_signed()));
        match (is_command, words[1]) {
            (false, _) | (true, STITCH) => moves.stitch(way, record, out),
            (true, JUMP) => moves.jump(way, record),
            // The bytes after a trim are filling.
            (true, TRIM) => moves.trim(record, out),
            (true, COLOR) => {
                moves.color(record, out);
                if way != [0, 0] {
                    moves.jump(way, record);
                }
            }
            (true, command) => {
                let message = format!("record {record} is no command of an EXP file: 80 {command:02x}");
                let hint = "the file is damaged, or is another format";
                out.push(Diagnostic::new(&code::SEW_RECORD, message).at(span(at, length, record)).hint(hint));
            }
        }
        at += length;
    }
    Input::Stitches(moves.finish(out), Vec::new())
}
