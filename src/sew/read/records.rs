//! Stitch files as a sequence of records: each format says what a record means, this collects the moves and tells faults.

use std::ops::Range;

use super::format::Input;
use super::moves::{Moves, Trims, span};
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::source::Source;

/// Meaning of a record, with its displacement in tenths of a millimetre, Y upwards.
#[derive(Debug, Clone, Copy)]
pub(super) enum Record {
    Stitch([i64; 2]),
    /// A stitch in the long form of VP3, which also stands for a move and the stitch at its end.
    Long([i64; 2]),
    Jump([i64; 2]),
    /// A thread cut, then a move with the needle up; so are the next three.
    Trim([i64; 2]),
    /// A change to the next thread, or a stop where the file says so in its table of threads.
    Thread([i64; 2]),
    /// A change to the thread of a needle.
    Needle(u16, [i64; 2]),
    Stop([i64; 2]),
    End,
}

/// Parser of the first record of some bytes: its length in bytes and its meaning. `None` if the bytes end within the record; a
/// meaning of `None` if the format has no such record.
pub(super) type Parse = fn(&[u8]) -> Option<(usize, Option<Record>)>;

/// Form of a file.
pub(super) struct Form {
    /// Name of the format in messages, with its article.
    pub(super) name: &'static str,
    pub(super) parse: Parse,
    /// True if a record ends the file.
    pub(super) has_end: bool,
    /// Jumps that stand for a thread cut.
    pub(super) trims: Trims,
    /// True for each change of thread, in order, that is a stop.
    pub(super) stops: Vec<bool>,
}

/// Collector of the records of a file.
pub(super) struct Records<'a> {
    form: Form,
    bytes: &'a [u8],
    moves: Moves,
    /// Number of the last record, from 1.
    record: u32,
    changes: usize,
}

/// Hint on a file that is too short.
const TRUNCATED: &str = "the end of the pattern is missing: transfer the file again, and compare sizes";
/// Longest stitch of the long form, tenths of a millimetre; a longer way is moved with the needle up.
const LONGEST: i64 = 255;

impl<'a> Records<'a> {
    /// Creates the collector for a file.
    pub(super) fn new(source: &'a Source, form: Form) -> Self {
        let moves = Moves::new(form.trims);
        Self { form, bytes: source.bytes(), moves, record: 0, changes: 0 }
    }

    /// Reads the records in a range of the file, up to the end of the pattern; reports a range that ends too soon.
    pub(super) fn read(&mut self, range: Range<usize>, out: &mut Diagnostics) {
        let mut at = range.start;
        let all = self.bytes.get(..range.end).unwrap_or_default();
        loop {
            let rest = all.get(at..).unwrap_or_default();
            if rest.is_empty() && !self.form.has_end {
                return;
            }
            let Some((length, meaning)) = (self.form.parse)(rest) else {
                let message = if rest.is_empty() {
                    format!("the file ends behind record {} without its end", self.record)
                } else {
                    format!("the file ends amid record {}", self.record + 1)
                };
                let place = span(at.min(self.bytes.len()), rest.len(), self.record + 1);
                out.push(Diagnostic::new(&code::SEW_TRUNCATED, message).at(place).hint(TRUNCATED));
                return;
            };
            self.record += 1;
            match meaning {
                Some(Record::End) => return,
                Some(record) => self.add(record, out),
                None => self.refuse(at, &rest[..length], out),
            }
            at += length;
        }
    }

    fn refuse(&self, at: usize, bytes: &[u8], out: &mut Diagnostics) {
        let digits: Vec<String> = bytes.iter().map(|byte| format!("{byte:02x}")).collect();
        let (record, name) = (self.record, self.form.name);
        let message = format!("record {record} is none of {name} file: {}", digits.join(" "));
        let hint = "the file is damaged, or is another format: name that with `--from`";
        out.push(Diagnostic::new(&code::SEW_RECORD, message).at(span(at, bytes.len(), record)).hint(hint));
    }

    fn add(&mut self, record: Record, out: &mut Diagnostics) {
        let (moves, number) = (&mut self.moves, self.record);
        let after = match record {
            Record::Stitch(way) => return moves.stitch(way, number, out),
            Record::Long(way) => {
                if moves.has_thread() && way.iter().all(|way| way.abs() <= LONGEST) {
                    return moves.stitch(way, number, out);
                }
                moves.jump(way, number);
                return moves.stitch([0, 0], number, out);
            }
            Record::Jump(way) => return moves.jump(way, number),
            Record::End => return,
            Record::Trim(way) => {
                moves.trim(number, out);
                way
            }
            Record::Thread(way) => {
                let is_stop = self.form.stops.get(self.changes).copied().unwrap_or(false);
                self.changes += 1;
                if is_stop {
                    moves.stop(number, out);
                } else {
                    moves.next_thread(number, out);
                }
                way
            }
            Record::Needle(needle, way) => {
                moves.thread(needle, number, out);
                way
            }
            Record::Stop(way) => {
                moves.stop(number, out);
                way
            }
        };
        if after != [0, 0] {
            moves.jump(after, number);
        }
    }

    /// Begins a block of stitches of another thread at a place, tenths of a millimetre.
    pub(super) fn begin_block(&mut self, to: [i64; 2], is_first: bool, out: &mut Diagnostics) {
        if !is_first {
            self.moves.next_thread(self.record + 1, out);
        }
        let at = self.moves.at();
        let way = [to[0] - at[0], to[1] - at[1]];
        if way != [0, 0] {
            self.moves.jump(way, self.record + 1);
        }
    }

    /// The collected stitches.
    pub(super) fn finish(self, out: &mut Diagnostics) -> Input {
        Input::Stitches(self.moves.finish(out), Vec::new())
    }
}

/// Reports a file whose header is cut off.
pub(super) fn short_header(bytes: &[u8], name: &str, out: &mut Diagnostics) -> Input {
    let message = format!("the file has {} bytes, fewer than the header of {name} file", bytes.len());
    out.push(Diagnostic::new(&code::SEW_TRUNCATED, message).hint("transfer it again"));
    Input::Stitches(Moves::new(Trims::default()).finish(out), Vec::new())
}

/// A displacement of two signed bytes.
pub(super) fn signed(x: u8, y: u8) -> [i64; 2] {
    [x, y].map(|byte| i64::from(byte.cast_signed()))
}
