//! Reads timed setpoints from a `NumPy` file: a header in Python's words, then packed little-endian records with the fields
//! of the rows that [`rows`](super::rows) knows.

use std::io::BufRead;

use super::row::Row;
use crate::geom::Point;
use crate::units::columns::{self, MAGIC, float};

/// The fields of a record, blanks left out.
const FIELDS: &str = "('t_s','<f8'),('x_mm','<f8'),('y_mm','<f8'),('c_deg','<f8'),\
    ('knife','|u1'),('drill','|u1'),('event','|u1'),('block','<u4')";
/// Bytes of a record.
const RECORD: usize = 39;

/// Whether a program is one of these, by its first byte: a text never begins with that one.
pub(in crate::verify) fn begins(input: &mut dyn BufRead) -> bool {
    input.fill_buf().is_ok_and(|bytes| bytes.first() == MAGIC.first())
}

/// Reads the header; gives the number of records, `None` when it is no header of setpoints.
pub(in crate::verify) fn header(input: &mut dyn BufRead) -> Option<u64> {
    columns::records(input, FIELDS).ok()
}

/// Reads the next record, of which `left` are to come; `Some(false)` at the end of the program, `None` when it ends too
/// early, cannot be read, or has bytes left over.
pub(super) fn record(input: &mut dyn BufRead, left: &mut u64, bytes: &mut Vec<u8>) -> Option<bool> {
    bytes.resize(RECORD, 0);
    columns::record(input, left, bytes).ok()
}

/// The row that a record holds, `None` when a number is not finite or an output not legal.
pub(in crate::verify) fn row(record: &[u8], tick: u64) -> Option<Row> {
    let number = |place: usize| float(record, 8 * place);
    let (t, x, y, c_deg) = (number(0)?, number(1)?, number(2)?, number(3)?);
    let &[knife, drill, event, b0, b1, b2, b3] = record.get(32..)? else { return None };
    let block = u32::from_le_bytes([b0, b1, b2, b3]);
    let legal = knife <= 1 && drill <= 4 && event <= 2;
    legal.then(|| Row { tick, t, centre: Point::new(x, y), c_deg, knife: knife == 1, drill, event, block, line: tick })
}
