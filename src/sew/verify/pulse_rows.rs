//! Reads pulses from rows of text: `entry,op,rpm,thread,t_us,x,y`.

use std::io::BufRead;

use super::ground::Unread;
use super::pulses::{OPS, Row};

/// How well an interval is known, microseconds: both ends have three decimals.
pub(super) const TICK_US: f64 = 0.001_1;

const HEADER: &str = "entry,op,rpm,thread,t_us,x,y";
const FIELDS: usize = 7;

/// Reads row by row.
pub(super) fn read(input: &mut dyn BufRead, each: &mut dyn FnMut(Row)) -> Result<(), Unread> {
    let mut line = String::new();
    let mut number = 0;
    loop {
        line.clear();
        number += 1;
        match input.read_line(&mut line) {
            Ok(0) if number == 1 => return Err(Unread::row(1, "there is no row")),
            Ok(0) => return Ok(()),
            Ok(_) => {}
            Err(error) if error.kind() == std::io::ErrorKind::InvalidData => {
                return Err(Unread::row(number, "it is no text"));
            }
            Err(error) => return Err(error.into()),
        }
        let Some(text) = line.strip_suffix('\n') else { return Err(Unread::row(number, "it is cut off")) };
        if number == 1 {
            if text != HEADER {
                return Err(Unread::row(1, "it is not the header"));
            }
            continue;
        }
        each(row(text).ok_or_else(|| Unread::row(number, "it is none of a program"))?);
    }
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
