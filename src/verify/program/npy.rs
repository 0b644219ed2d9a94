//! Reader of timed setpoints from a `NumPy` file: a header as a Python literal, then packed little-endian records with the
//! fields of the rows of [`rows`](super::rows).

use std::io::BufRead;

use super::row::Row;
use crate::geom::Point;
use crate::units::columns::{self, MAGIC, float};

/// Fields of a record, without blanks.
const FIELDS: &str = "('t_s','<f8'),('x_mm','<f8'),('y_mm','<f8'),('c_deg','<f8'),\
    ('knife','|u1'),('drill','|u1'),('event','|u1'),('block','<u4')";
/// Fields with a conveyor; the last one is the advance of the cloth.
const FIELDS_OF_BITES: &str = "('t_s','<f8'),('x_mm','<f8'),('y_mm','<f8'),('c_deg','<f8'),\
    ('knife','|u1'),('drill','|u1'),('event','|u1'),('block','<u4'),('advance_mm','<u4')";
/// Bytes of a record, without and with a conveyor.
const RECORDS: [usize; 2] = [39, 43];

/// True if the program has this format, judged by its first byte, which never begins a text.
pub(in crate::verify) fn begins(input: &mut dyn BufRead) -> bool {
    input.fill_buf().is_ok_and(|bytes| bytes.first() == MAGIC.first())
}

/// Reads the header and returns the number of records and the bytes of each; `None` when it is not a header of setpoints.
pub(in crate::verify) fn header(input: &mut dyn BufRead) -> Option<(u64, usize)> {
    let (count, list) = columns::records_of(input, &[FIELDS, FIELDS_OF_BITES]).ok()?;
    Some((count, RECORDS[list]))
}

/// Reads the next record, of `size` bytes; `left` is the number of records still expected. `Some(false)` at the end of the
/// program, `None` when it ends too early, cannot be read, or bytes are left over.
pub(super) fn record(input: &mut dyn BufRead, left: &mut u64, size: usize, bytes: &mut Vec<u8>) -> Option<bool> {
    bytes.resize(size, 0);
    columns::record(input, left, bytes).ok()
}

/// Row of a record; `None` when a number is not finite or an output is not legal.
pub(in crate::verify) fn row(record: &[u8], tick: u64) -> Option<Row> {
    let number = |place: usize| float(record, 8 * place);
    let (t, x, y, c_deg) = (number(0)?, number(1)?, number(2)?, number(3)?);
    let (outputs, whole) = record.get(32..)?.split_at_checked(3)?;
    let &[knife, drill, event] = outputs else { return None };
    let (numbers, []) = whole.as_chunks() else { return None };
    let mut numbers = numbers.iter().map(|bytes| u32::from_le_bytes(*bytes));
    let (block, station) = (numbers.next()?, numbers.next().unwrap_or(0));
    let legal = knife <= 1 && drill <= 4 && event <= 2;
    let (centre, knife) = (Point::new(x, y), knife == 1);
    legal.then_some(Row { tick, t, centre, c_deg, knife, drill, event, block, station, line: tick })
}
