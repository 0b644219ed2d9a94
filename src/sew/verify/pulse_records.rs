//! Reads pulses from records of a `NumPy` array.

use std::io::BufRead;

use super::ground::Unread;
use super::pulses::{OPS, Row};

/// How well an interval is known, microseconds: times are unrounded.
pub(super) const TICK_US: f64 = 1e-6;

const MAGIC: &[u8; 8] = b"\x93NUMPY\x01\x00";
const RECORD_BYTES: usize = 19;
/// What the header must say of a record.
const FIELDS: &str =
    "[('t_us','<f8'),('entry','<u4'),('rpm','<u2'),('thread','<u2'),('op','|u1'),('x','|i1'),('y','|i1')]";

/// Reads record by record.
pub(super) fn read(input: &mut dyn BufRead, each: &mut dyn FnMut(Row)) -> Result<(), Unread> {
    let mut head = [0; MAGIC.len() + 2];
    fill(input, &mut head, "the header is cut off")?;
    if head[..MAGIC.len()] != MAGIC[..] {
        return Err(Unread::Row("the file is no array of NumPy".to_owned()));
    }
    let mut text = vec![0; usize::from(u16::from_le_bytes([head[8], head[9]]))];
    fill(input, &mut text, "the header is cut off")?;
    let text: String = String::from_utf8_lossy(&text).split_whitespace().collect();
    let count = text.split_once("'shape':(").and_then(|(_, rest)| rest.split_once(",)")?.0.parse::<u64>().ok());
    let Some(count) = count.filter(|_| text.contains(FIELDS)) else {
        return Err(Unread::Row("the header is none of a program".to_owned()));
    };
    let mut record = [0; RECORD_BYTES];
    for number in 1..=count {
        fill(input, &mut record, "the array is cut off")?;
        each(row(&record).ok_or_else(|| Unread::row(number, "it is none of a program"))?);
    }
    if input.fill_buf()?.is_empty() { Ok(()) } else { Err(Unread::Row("bytes stand behind the array".to_owned())) }
}

fn fill(input: &mut dyn BufRead, bytes: &mut [u8], cut: &str) -> Result<(), Unread> {
    input.read_exact(bytes).map_err(|error| match error.kind() {
        std::io::ErrorKind::UnexpectedEof => Unread::Row(cut.to_owned()),
        _ => Unread::Io(error),
    })
}

fn row(record: &[u8; RECORD_BYTES]) -> Option<Row> {
    let time_us = f64::from_le_bytes(*record.first_chunk()?);
    let entry = u32::from_le_bytes(*record[8..].first_chunk()?);
    let [rpm, thread] = [12, 14].map(|at| u16::from_le_bytes([record[at], record[at + 1]]));
    let pulse = [record[17], record[18]].map(u8::cast_signed);
    let is_sound = time_us.is_finite()
        && time_us >= 0.0
        && usize::from(record[16]) < OPS.len()
        && pulse.iter().all(|pulse| (-1..=1).contains(pulse));
    is_sound.then_some(Row { entry, op: record[16], rpm: rpm.into(), thread, time_us, pulse })
}
