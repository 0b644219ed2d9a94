//! Reader of pulses from rows of text: `entry,op,rpm,thread,t_us,x,y`.

use std::io::BufRead;

use super::pulses::{OPS, Row};
use crate::units::columns::{Lines, Unread};

/// Uncertainty of an interval, microseconds: both ends have three decimals.
pub(super) const TICK_US: f64 = 0.001_1;

const HEADER: &str = "entry,op,rpm,thread,t_us,x,y";
const FIELDS: usize = 7;

/// Reads row by row.
pub(super) fn read(input: &mut dyn BufRead, each: &mut dyn FnMut(Row)) -> Result<(), Unread> {
    let mut lines = Lines::default();
    lines.header(input, HEADER)?;
    while let Some(line) = lines.next(input)? {
        let row = row(line);
        each(row.ok_or_else(|| lines.is("it is none of a program"))?);
    }
    Ok(())
}

fn row(text: &str) -> Option<Row> {
    let mut fields = [""; FIELDS];
    let mut count = 0;
    for field in text.split(',') {
        *fields.get_mut(count)? = field;
        count += 1;
    }
    if count != FIELDS {
        return None;
    }
    let [entry, op, rpm, thread, time, x, y] = fields;
    let time_us = time.parse().ok().filter(|time: &f64| time.is_finite() && *time >= 0.0)?;
    let pulse = |field: &str| field.parse().ok().filter(|pulse| (-1..=1).contains(pulse));
    Some(Row {
        entry: entry.parse().ok()?,
        op: OPS.iter().position(|word| *word == op)? as u8,
        rpm: rpm.parse::<u32>().ok()?.into(),
        thread: thread.parse().ok()?,
        time_us,
        pulse: [pulse(x)?, pulse(y)?],
    })
}
