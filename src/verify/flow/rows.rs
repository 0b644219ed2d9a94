//! Reader of programs of heads: rows of text or records of an array.

use std::io::BufRead;

use crate::units::columns::{self, Lines, Unread, float};
use crate::verify::program::number;

/// Format of the programs of heads.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Bytes {
    /// Rows of text.
    Rows,
    /// Records of an array.
    Records,
}

/// Row of a head's program.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Row {
    /// Time, s.
    pub(super) time: f64,
    /// Position of the conveyor, mm.
    pub(super) conveyor: f64,
    /// Position of the head along the feed, from its station, and across the feed, mm.
    pub(super) place: [f64; 2],
    /// Position of C, degrees.
    pub(super) c: f64,
    /// True if the knife is commanded down.
    pub(super) knife: bool,
    /// Source block; 0 = none.
    pub(super) block: u32,
}

/// Bytes of a record: five numbers, a flag and a block.
const RECORD: usize = 5 * 8 + 1 + 4;
/// Names of the fields, in order.
const NAMES: &str = "t_s,conv_mm,x_mm,y_mm,c_deg,knife,block";
/// Fields of a record.
const FIELDS: &str = "('t_s','<f8'),('conv_mm','<f8'),('x_mm','<f8'),('y_mm','<f8'),('c_deg','<f8'),\
    ('knife','|u1'),('block','<u4')";

/// Reads a program and calls `each` for every row.
pub(super) fn read(bytes: Bytes, input: &mut dyn BufRead, each: &mut dyn FnMut(Row)) -> Result<(), Unread> {
    match bytes {
        Bytes::Rows => text(input, each),
        Bytes::Records => records(input, each),
    }
}

fn text(input: &mut dyn BufRead, each: &mut dyn FnMut(Row)) -> Result<(), Unread> {
    let mut lines = Lines::default();
    lines.header(input, NAMES)?;
    let mut last = Last::default();
    while let Some(line) = lines.next(input)? {
        let row = last.row(line.as_bytes());
        each(row.ok_or_else(|| lines.is("it is none of a program"))?);
    }
    Ok(())
}

/// Cache of the previous row: a waiting head repeats the fields behind time and conveyor, which are then parsed only once.
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

/// Row from its fields behind time and conveyor.
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
    let mut left = columns::records(input, FIELDS)?;
    let (mut record, mut number) = ([0; RECORD], 0);
    while columns::record(input, &mut left, &mut record)? {
        number += 1;
        each(of_record(&record).ok_or_else(|| Unread::row(number, "it is none of a program"))?);
    }
    Ok(())
}

fn of_record(record: &[u8; RECORD]) -> Option<Row> {
    let number = |place: usize| float(record, 8 * place);
    let knife = match record[40] {
        0 => false,
        1 => true,
        _ => return None,
    };
    let block = u32::from_le_bytes(*record[41..].first_chunk()?);
    Some(Row { time: number(0)?, conveyor: number(1)?, place: [number(2)?, number(3)?], c: number(4)?, knife, block })
}
