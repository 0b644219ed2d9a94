//! Tajima DST: a header of 512 bytes, then records of three bytes.
//!
//! A coordinate is a signed sum of 81, 27, 9, 3 and 1, in tenths of a millimetre. Three or more consecutive jumps stand for a
//! trim.

use super::format::{Format, Input};
use super::moves::{Moves, Trims, span};
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::front::sewn;
use crate::source::{Source, Span};

pub(super) const FORMAT: Format = Format {
    name: "dst",
    about: "stitch files of Tajima machines",
    extensions: &["dst"],
    record_word: "record",
    is_it: |bytes, extension| (extension == "dst" && !sewn::is_dsb(bytes)) || sewn::is_dst(bytes),
    read,
};

const HEADER_BYTES: usize = 512;
const RECORD_BYTES: usize = 3;
/// Bits of the last byte that end a pattern, whatever the other bytes are: 81 up and 81 down at once, which no move has.
const END: u8 = 0xF3;
/// Content of erased memory, which no program writes.
const ERASED: [u8; RECORD_BYTES] = [0xFF; RECORD_BYTES];
/// Bits of the last byte with the kind of the record, and their value for a sequin.
const KIND: u8 = 0xC3;
const SEQUIN: u8 = 0x43;
/// Bytes that fill the last block of a file on many disks.
const FILLING: [u8; 5] = [0x00, 0x1A, b' ', b'\r', b'\n'];
/// Number of consecutive jumps that stand for a trim.
const TRIM_JUMPS: u32 = 3;

/// Weights of the bits of the three bytes: x, then y; 0 for bits with another meaning.
const BITS: [[(i64, i64); 8]; 3] = [
    [(1, 0), (-1, 0), (9, 0), (-9, 0), (0, -9), (0, 9), (0, -1), (0, 1)],
    [(3, 0), (-3, 0), (27, 0), (-27, 0), (0, -27), (0, 27), (0, -3), (0, 3)],
    [(0, 0), (0, 0), (81, 0), (-81, 0), (0, -81), (0, 81), (0, 0), (0, 0)],
];

/// Displacement by a record, tenths of a millimetre.
fn way(record: [u8; RECORD_BYTES]) -> [i64; 2] {
    let mut way = [0; 2];
    for (byte, weights) in record.into_iter().zip(BITS) {
        for (bit, (x, y)) in weights.into_iter().enumerate() {
            if byte >> bit & 1 == 1 {
                way = [way[0] + x, way[1] + y];
            }
        }
    }
    way
}

/// Totals of the records, for comparison with the header.
#[derive(Debug, Default)]
struct Count {
    stitches: u32,
    records: u32,
    colors: u32,
    at: [i64; 2],
    /// Maximum reach to +X, -X, +Y, -Y: of all records, and of stitches alone.
    reach: [i64; 4],
    sewn: [i64; 4],
}

fn read(source: &Source, out: &mut Diagnostics) -> Input {
    let bytes = source.bytes();
    let mut moves = Moves::new(Trims { jumps: Some(TRIM_JUMPS), way: None });
    let Some((header, body)) = bytes.split_at_checked(HEADER_BYTES) else {
        let message = format!("the file has {} bytes, fewer than the header of a DST file", bytes.len());
        out.push(Diagnostic::new(&code::SEW_TRUNCATED, message).hint("transfer it again"));
        return Input::Stitches(moves.finish(out), Vec::new());
    };
    let mut count = Count::default();
    let mut end = None;
    let filled = body.iter().rposition(|byte| !FILLING.contains(byte)).map_or(0, |last| last + 1);
    let (records, rest) = body[..filled].as_chunks::<RECORD_BYTES>();
    for (i, &record) in records.iter().enumerate() {
        let number = i as u32 + 1;
        let place = span(HEADER_BYTES + i * RECORD_BYTES, RECORD_BYTES, number);
        let last = record[2];
        if last & END == END && record != ERASED {
            end = Some((i + 1) * RECORD_BYTES);
            break;
        }
        let way = way(record);
        count.add(way);
        match last & KIND {
            _ if record == ERASED => refuse(record, place, out),
            0x03 => {
                count.stitch();
                moves.stitch(way, number, out);
            }
            0x83 => moves.jump(way, number),
            0xC3 => {
                count.colors += 1;
                moves.next_thread(number, out);
                if way != [0, 0] {
                    moves.jump(way, number);
                }
            }
            _ => refuse(record, place, out),
        }
    }
    match end {
        Some(end) => check_rest(body, end, out),
        None => check_no_end(header, &count, rest, out),
    }
    if !out.has_errors() {
        check_header(header, &count, out);
    }
    Input::Stitches(moves.finish(out), Vec::new())
}

/// Warns of bytes after the end of the records.
fn check_rest(body: &[u8], end: usize, out: &mut Diagnostics) {
    let rest = &body[end..];
    if rest.iter().any(|byte| !FILLING.contains(byte)) {
        let message = format!("{} bytes stand behind the end of the pattern; they are not sewn", rest.len());
        let hint = "two files may have run together, or the end came too soon: compare the stitches with the original";
        let place = span(HEADER_BYTES + end, rest.len(), (end / RECORD_BYTES) as u32 + 1);
        out.push(Diagnostic::new(&code::SEW_BEHIND_END, message).at(place).hint(hint));
    }
}

/// Reports records without an end: those of a file that is cut off, or all of it, as some programs write it.
fn check_no_end(header: &[u8], count: &Count, rest: &[u8], out: &mut Diagnostics) {
    let Count { records, stitches, .. } = *count;
    let at = span(HEADER_BYTES + records as usize * RECORD_BYTES, rest.len(), records);
    // Some systems count all records, others stitches. One that counts the end writes it.
    let whole = [records, stitches].map(i64::from);
    if rest.is_empty() && field(header, b"ST:").is_some_and(|told| whole.contains(&told)) {
        let message =
            format!("the file has no end (00 00 F3) behind record {records}, the last that its header counts");
        let hint = "the pattern is whole and is sewn; other machines may not stop there: write it anew for them";
        out.push(Diagnostic::new(&code::SEW_NO_END, message).at(at).hint(hint));
        return;
    }
    let message = format!("the file ends behind record {records} without its end (00 00 F3)");
    let hint = "the end of the pattern is missing: transfer the file again, and compare sizes";
    out.push(Diagnostic::new(&code::SEW_TRUNCATED, message).at(at).hint(hint));
}

fn refuse(record: [u8; RECORD_BYTES], place: Span, out: &mut Diagnostics) {
    let [a, b, c] = record;
    let message = format!("record {} is none of a DST file: {a:02x} {b:02x} {c:02x}", place.block);
    let hint = if c & KIND == SEQUIN {
        "it places a sequin, which is not sewn here: leave sequins out when the file is written"
    } else {
        "the two lowest bits of a record are set, and others are not all; the file is damaged, or is another format"
    };
    out.push(Diagnostic::new(&code::SEW_RECORD, message).at(place).hint(hint));
}

impl Count {
    fn add(&mut self, [x, y]: [i64; 2]) {
        self.records += 1;
        self.at = [self.at[0] + x, self.at[1] + y];
        extend(&mut self.reach, self.at);
    }

    /// Counts the last added record as a stitch.
    fn stitch(&mut self) {
        self.stitches += 1;
        extend(&mut self.sewn, self.at);
    }
}

fn extend(reach: &mut [i64; 4], [x, y]: [i64; 2]) {
    for (most, now) in reach.iter_mut().zip([x, -x, y, -y]) {
        *most = (*most).max(now);
    }
}

/// The number in a field of the header.
fn field(header: &[u8], name: &[u8]) -> Option<i64> {
    let at = memchr::memmem::find(header, name)? + name.len();
    let rest = &header[at..];
    let text = std::str::from_utf8(&rest[..rest.iter().position(|&byte| byte == b'\r')?]).ok()?;
    text.replace(' ', "").parse().ok()
}

/// Warns if the header contradicts the records.
fn check_header(header: &[u8], count: &Count, out: &mut Diagnostics) {
    let mut wrong = Vec::new();
    // In some systems Y points down in the header, and some count the reach of stitches without jumps.
    let ([right, left, up, down], sewn) = (count.reach, count.sewn);
    let sides: [(&[u8], [i64; 4]); 4] = [
        (b"+X:", [right, right, sewn[0], sewn[0]]),
        (b"-X:", [left, left, sewn[1], sewn[1]]),
        (b"+Y:", [up, down, sewn[2], sewn[3]]),
        (b"-Y:", [down, up, sewn[3], sewn[2]]),
    ];
    for (name, reach) in sides {
        if let Some(told) = field(header, name).filter(|told| !reach.contains(told)) {
            wrong.push(format!("{} {told} instead of {}", String::from_utf8_lossy(name), reach[0]));
        }
    }
    // Some systems count stitches, others all records, with or without the end.
    if let Some(told) =
        field(header, b"ST:").filter(|told| !(i64::from(count.stitches)..=i64::from(count.records) + 1).contains(told))
    {
        wrong.push(format!("ST: {told} instead of {}", count.records));
    }
    // The field counts changes of thread, or threads.
    let colors = i64::from(count.colors);
    if let Some(told) = field(header, b"CO:").filter(|told| !(colors..=colors + 1).contains(told)) {
        wrong.push(format!("CO: {told} instead of {colors}"));
    }
    if !wrong.is_empty() {
        let message = format!("the header does not fit the stitches: {}", wrong.join(", "));
        let hint = "the stitches are sewn as they are; an edited or damaged file may lack some";
        out.push(Diagnostic::new(&code::SEW_HEADER, message).at(span(0, HEADER_BYTES, 0)).hint(hint));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn records_are_those_of_machines() {
        assert_eq!(way([0x01, 0x06, 0x03]), [25, 0]);
        assert_eq!(way([0x00, 0x05, 0x03]), [30, 0]);
        assert_eq!(way([0x02, 0xa9, 0x03]), [-25, 30]);
        assert_eq!(way([0x55, 0x55, 0x17]), [121, -121]);
    }
}
