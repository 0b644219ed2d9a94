//! Reader of pulses from the records of a `NumPy` array.

use std::io::BufRead;

use super::pulses::{OPS, Row};
use crate::units::columns::{self, Unread, float};

/// Uncertainty of an interval, microseconds: times are unrounded.
pub(super) const TICK_US: f64 = 1e-6;

const RECORD_BYTES: usize = 19;
/// The fields of a record.
const FIELDS: &str =
    "('t_us','<f8'),('entry','<u4'),('rpm','<u2'),('thread','<u2'),('op','|u1'),('x','|i1'),('y','|i1')";

/// Reads record by record.
pub(super) fn read(input: &mut dyn BufRead, each: &mut dyn FnMut(Row)) -> Result<(), Unread> {
    let mut left = columns::records(input, FIELDS)?;
    let (mut record, mut number) = ([0; RECORD_BYTES], 0);
    while columns::record(input, &mut left, &mut record)? {
        number += 1;
        each(row(&record).ok_or_else(|| Unread::row(number, "it is none of a program"))?);
    }
    Ok(())
}

fn row(record: &[u8; RECORD_BYTES]) -> Option<Row> {
    let time_us = float(record, 0)?;
    let entry = u32::from_le_bytes(*record[8..].first_chunk()?);
    let [rpm, thread] = [12, 14].map(|at| u16::from_le_bytes([record[at], record[at + 1]]));
    let pulse = [record[17], record[18]].map(u8::cast_signed);
    let is_sound =
        time_us >= 0.0 && usize::from(record[16]) < OPS.len() && pulse.iter().all(|pulse| (-1..=1).contains(pulse));
    is_sound.then_some(Row { entry, op: record[16], rpm: rpm.into(), thread, time_us, pulse })
}
