//! The programs of heads, as they are read back: rows of text or records of an array.

use std::io::{BufRead, Read as _};

use super::ground::Unread;
use crate::verify::number;

/// What kind of bytes the programs of heads are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Bytes {
    /// Rows of text.
    Rows,
    /// Records of an array.
    Records,
}

/// A row of a head's program.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Row {
    /// s.
    pub(super) time: f64,
    /// Position of the conveyor, mm.
    pub(super) conveyor: f64,
    /// Along the feed from the station, and across, mm.
    pub(super) place: [f64; 2],
    /// degrees.
    pub(super) c: f64,
    /// Whether the knife is commanded down.
    pub(super) knife: bool,
    /// The source block; 0 = none.
    pub(super) block: u32,
}

/// Bytes of a record: five numbers, a flag, a block.
const RECORD: usize = 5 * 8 + 1 + 4;
/// Fields of a row.
const FIELDS: usize = 7;
/// The names of the fields, in their order.
const NAMES: [&str; FIELDS] = ["t_s", "conv_mm", "x_mm", "y_mm", "c_deg", "knife", "block"];

/// Reads a program, row by row.
pub(super) fn read(bytes: Bytes, input: &mut dyn BufRead, each: &mut dyn FnMut(Row)) -> Result<(), Unread> {
    match bytes {
        Bytes::Rows => text(input, each),
        Bytes::Records => records(input, each),
    }
}

fn text(input: &mut dyn BufRead, each: &mut dyn FnMut(Row)) -> Result<(), Unread> {
    let mut line = Vec::new();
    input.read_until(b'\n', &mut line)?;
    if line.trim_ascii_end() != NAMES.join(",").as_bytes() {
        return Err(Unread::Row(format!("the first line is not {}", NAMES.join(","))));
    }
    let mut last = Last::default();
    for number in 2.. {
        line.clear();
        if input.read_until(b'\n', &mut line)? == 0 {
            return Ok(());
        }
        if line.last() != Some(&b'\n') {
            return Err(Unread::Row(format!("line {number} is cut off")));
        }
        let row = last.row(line.trim_ascii_end());
        each(row.ok_or_else(|| Unread::Row(format!("line {number} is no row")))?);
    }
    Ok(())
}

/// The row before: a head that waits has the same fields behind time and conveyor for long, and these are read once.
#[derive(Default)]
struct Last {
    fields: Vec<u8>,
    row: Option<Row>,
}

impl Last {
    fn row(&mut self, line: &[u8]) -> Option<Row> {
        let mut fields = line.splitn(3, |&byte| byte == b',');
        let (time, conveyor) = (number::decimal(fields.next()?)?, number::decimal(fields.next()?)?);
        let rest = fields.next()?;
        if self.row.is_none() || self.fields != rest {
            self.row = Some(of_fields(rest)?);
            self.fields.clear();
            self.fields.extend_from_slice(rest);
        }
        self.row.map(|row| Row { time, conveyor, ..row })
    }
}

/// A row, of its fields behind time and conveyor.
fn of_fields(fields: &[u8]) -> Option<Row> {
    let mut fields = fields.split(|&byte| byte == b',');
    let mut number = || number::decimal(fields.next()?);
    let (x, y, c) = (number()?, number()?, number()?);
    let knife = match fields.next()? {
        b"0" => false,
        b"1" => true,
        _ => return None,
    };
    let block = number::whole(fields.next()?)?;
    fields.next().is_none().then_some(Row { time: 0.0, conveyor: 0.0, place: [x, y], c, knife, block })
}

fn records(input: &mut dyn BufRead, each: &mut dyn FnMut(Row)) -> Result<(), Unread> {
    let short = |_| Unread::Row("the array ends in its header".to_owned());
    let mut start = [0; 10];
    input.read_exact(&mut start).map_err(short)?;
    if !start.starts_with(b"\x93NUMPY\x01\x00") {
        return Err(Unread::Row("it is no array of NumPy, version 1.0".to_owned()));
    }
    let mut header = vec![0; usize::from(u16::from_le_bytes([start[8], start[9]]))];
    input.read_exact(&mut header).map_err(short)?;
    let header = String::from_utf8_lossy(&header).into_owned();
    let mut fields: Vec<String> = NAMES[..5].iter().map(|name| format!("('{name}', '<f8')")).collect();
    fields.extend(["('knife', '|u1')".to_owned(), "('block', '<u4')".to_owned()]);
    if !header.contains(&format!("[{}]", fields.join(", "))) {
        return Err(Unread::Row("its records have other fields".to_owned()));
    }
    let shape = header.split_once("'shape': (").and_then(|(_, rest)| rest.split_once(','));
    let Some(count) = shape.and_then(|(count, _)| count.parse::<u64>().ok()) else {
        return Err(Unread::Row("its header does not tell how many records it has".to_owned()));
    };
    let mut record = [0; RECORD];
    for number in 0..count {
        let cut_off = |_| Unread::Row(format!("it ends before record {number} of {count}"));
        input.read_exact(&mut record).map_err(cut_off)?;
        each(of_record(&record).ok_or_else(|| Unread::Row(format!("record {number} is no row")))?);
    }
    let mut rest = [0];
    if input.take(1).read(&mut rest)? > 0 {
        return Err(Unread::Row("there is something behind the last record".to_owned()));
    }
    Ok(())
}

fn of_record(record: &[u8; RECORD]) -> Option<Row> {
    let number = |i: usize| {
        let bytes: [u8; 8] = record[8 * i..8 * i + 8].try_into().ok()?;
        Some(f64::from_le_bytes(bytes)).filter(|value| value.is_finite())
    };
    let knife = match record[40] {
        0 => false,
        1 => true,
        _ => return None,
    };
    let block = u32::from_le_bytes(record[41..45].try_into().ok()?);
    Some(Row { time: number(0)?, conveyor: number(1)?, place: [number(2)?, number(3)?], c: number(4)?, knife, block })
}
