//! Reads timed setpoints from a `NumPy` file: a header in Python's words, then packed little-endian records with the fields
//! of the rows that [`rows`](super::rows) knows.

use std::io::{self, BufRead};

use super::row::Row;
use crate::geom::Point;

/// How every such file begins; no text does.
const MAGIC: &[u8] = b"\x93NUMPY";
/// What the header must say, blanks left out, before the number of records.
const EXPECTED: &[u8] = b"{'descr':[('t_s','<f8'),('x_mm','<f8'),('y_mm','<f8'),('c_deg','<f8'),\
    ('knife','|u1'),('drill','|u1'),('event','|u1'),('block','<u4')],'fortran_order':False,'shape':(";
/// Bytes of a record.
const RECORD: usize = 39;

/// Whether a program is one of these, by its first byte: a text never begins with that one.
pub(in crate::verify) fn begins(input: &mut dyn BufRead) -> bool {
    input.fill_buf().is_ok_and(|bytes| bytes.first() == MAGIC.first())
}

/// Reads the header; gives the number of records, `None` when it is no header of setpoints.
pub(in crate::verify) fn header(input: &mut dyn BufRead) -> Option<u64> {
    let mut start = [0; 8];
    input.read_exact(&mut start).ok()?;
    if !start.starts_with(MAGIC) {
        return None;
    }
    // Version 1 counts the header in two bytes, later ones in four; the second number of a version changes nothing.
    let mut size = [0; 4];
    input.read_exact(if start[6] == 1 { &mut size[..2] } else { &mut size[..] }).ok()?;
    let mut text = vec![0; usize::from(u16::try_from(u32::from_le_bytes(size)).ok()?)];
    input.read_exact(&mut text).ok()?;
    text.retain(|b| !b.is_ascii_whitespace());
    let rest = text.strip_prefix(EXPECTED)?;
    let digits = rest.iter().take_while(|b| b.is_ascii_digit()).count();
    let (count, end) = rest.split_at(digits);
    if !matches!(end, b",),}" | b",)}") {
        return None;
    }
    std::str::from_utf8(count).ok()?.parse().ok()
}

/// Reads the next record, of which `left` are to come; `Some(false)` at the end of the program, `None` when it ends too
/// early, cannot be read, or has bytes left over.
pub(super) fn record(input: &mut dyn BufRead, left: &mut u64, bytes: &mut Vec<u8>) -> Option<bool> {
    if *left == 0 {
        return retried(input)?.is_empty().then_some(false);
    }
    *left -= 1;
    bytes.resize(RECORD, 0);
    input.read_exact(bytes).ok()?;
    Some(true)
}

/// What is buffered, empty at the end of the file.
fn retried(input: &mut dyn BufRead) -> Option<&[u8]> {
    while let Err(error) = input.fill_buf() {
        if error.kind() != io::ErrorKind::Interrupted {
            return None;
        }
    }
    input.fill_buf().ok()
}

/// The row that a record holds, `None` when a number is not finite or an output not legal.
pub(in crate::verify) fn row(record: &[u8], tick: u64) -> Option<Row> {
    let float = |at: usize| {
        let bytes = record.get(at..at + 8)?.try_into().ok()?;
        Some(f64::from_le_bytes(bytes)).filter(|value| value.is_finite())
    };
    let (t, x, y, c_deg) = (float(0)?, float(8)?, float(16)?, float(24)?);
    let &[knife, drill, event, b0, b1, b2, b3] = record.get(32..)? else { return None };
    let block = u32::from_le_bytes([b0, b1, b2, b3]);
    let legal = knife <= 1 && drill <= 4 && event <= 2;
    legal.then(|| Row { tick, t, centre: Point::new(x, y), c_deg, knife: knife == 1, drill, event, block, line: tick })
}
