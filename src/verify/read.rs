//! Reads the rows of timed setpoints: `t_s,x_mm,y_mm,c_deg,knife,drill,event,block`, as text or as records.

use std::io::{BufRead, Read as _};

use super::counts::Counts;
use super::worst::Worst;
use super::{counts, hal, npy};
use crate::geom::{Point, Vector};
use crate::ir::Finding;
use crate::ir::finding::Sighting;
use crate::machine::MachineProfile;

/// Half of the last decimal of positions, mm and degrees: by so much a value may differ from what was meant.
const ROUNDING: f64 = 0.5e-6;
/// Half of the last decimal of the time, s.
pub(super) const TIME_ROUNDING: f64 = 0.5e-6;

/// One setpoint.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Row {
    /// Its place among the rows, from 0.
    pub(super) tick: u64,
    /// Time, s.
    pub(super) t: f64,
    /// The C axis over the table, mm.
    pub(super) centre: Point,
    /// Position of C, degrees.
    pub(super) c_deg: f64,
    /// Whether the knife is commanded down.
    pub(super) knife: bool,
    /// The drill that is commanded, 0 = none.
    pub(super) drill: u8,
    /// The event that is told, 0 = none.
    pub(super) event: u8,
    /// The source block, 0 = none.
    pub(super) block: u32,
}

impl Row {
    /// Unit vector from tail to tip.
    pub(super) fn along(&self) -> Vector {
        let (sin, cos) = self.c_deg.to_radians().sin_cos();
        Vector::new(cos, sin)
    }

    /// The row as a place.
    pub(super) fn sighting(&self) -> Sighting {
        super::worst::at(self.t, self.centre, self.block)
    }
}

/// How rows are written.
#[derive(Debug)]
enum Form<'a> {
    /// Lines of fields between commas.
    Table,
    /// Records, so many of which are still to come.
    Array(u64),
    /// Records of encoder counts, likewise.
    Counts(Counts, u64),
    /// Lines of fields between blanks, for this machine.
    Stream(&'a MachineProfile),
}

/// By how much the numbers of rows may differ from what was meant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Rounding {
    /// Of X, Y (mm) and C (degrees).
    pub(super) axes: [f64; 3],
}

impl Rounding {
    /// Of an axis, whichever is coarsest.
    pub(super) fn axis(self) -> f64 {
        self.axes.into_iter().fold(0.0, f64::max)
    }

    /// Of a place that is computed from a row, mm: the tip's, from the axes and the turn of the blade.
    pub(super) fn place(self) -> f64 {
        4.0 * self.axis()
    }
}

/// The rows of a program; stops at the first that cannot be read.
pub(super) struct Rows<'a> {
    input: &'a mut dyn BufRead,
    form: Form<'a>,
    /// The line or record that was read last.
    line: Vec<u8>,
    tick: u64,
    last: Option<Row>,
    worst: Worst,
    ended: bool,
}

/// The longest line that is read, bytes: what is longer is no row, and must not fill the memory.
const LINE_MAX: u64 = 1024;

const HEADER: &[u8] = b"t_s,x_mm,y_mm,c_deg,knife,drill,event,block";
/// How its first field ends.
const FIRST_FIELD: &[u8] = b"t_s,";

/// Whether a text is meant as rows, by its first field.
pub(super) fn begins(input: &mut dyn BufRead) -> bool {
    input.fill_buf().is_ok_and(|bytes| bytes.starts_with(FIRST_FIELD))
}

impl<'a> Rows<'a> {
    pub(super) fn new(input: &'a mut dyn BufRead, profile: &'a MachineProfile) -> Self {
        let worst = Worst::new("verify/format", "bad rows", Some(0.0));
        let mut rows = Self { input, form: Form::Table, line: Vec::new(), tick: 0, last: None, worst, ended: false };
        if npy::begins(rows.input) {
            let told = npy::header(rows.input);
            rows.form = Form::Array(told.unwrap_or(0));
            rows.check(told.is_some());
        } else if counts::begins(rows.input) {
            let told = Counts::read(rows.input, profile);
            let is_sound = told.is_some();
            if let Some((counts, left)) = told {
                rows.form = Form::Counts(counts, left);
            }
            rows.check(is_sound);
        } else {
            let is_stream = hal::begins(rows.input);
            if is_stream {
                rows.form = Form::Stream(profile);
            }
            let header = if is_stream { hal::HEADER } else { HEADER };
            let is_there = rows.fetch() == Some(true) && rows.line == header;
            rows.check(is_there);
        }
        rows
    }

    fn check(&mut self, is_sound: bool) {
        if !is_sound {
            self.fail();
        }
    }

    /// By how much its numbers may differ from what was meant.
    pub(super) fn rounding(&self) -> Rounding {
        let axes = match &self.form {
            Form::Counts(counts, _) => counts.rounding(),
            Form::Table | Form::Array(_) | Form::Stream(_) => [ROUNDING; 3],
        };
        Rounding { axes }
    }

    /// The next row.
    pub(super) fn next(&mut self) -> Option<Row> {
        if self.ended {
            return None;
        }
        match self.fetch() {
            Some(true) => {}
            Some(false) => {
                self.ended = true;
                if self.last.is_none() {
                    self.fail();
                }
                return None;
            }
            None => {
                self.fail();
                return None;
            }
        }
        let row = match &mut self.form {
            Form::Table => parse(&self.line, self.tick),
            Form::Array(_) => npy::row(&self.line, self.tick),
            Form::Counts(counts, _) => counts.row(&self.line, self.tick),
            Form::Stream(profile) => hal::row(&self.line, self.tick, profile),
        };
        let Some(row) = row else {
            self.fail();
            return None;
        };
        self.tick += 1;
        self.last = Some(row);
        Some(row)
    }

    /// What was found about the format.
    pub(super) fn finding(self) -> Finding {
        self.worst.finding()
    }

    /// Reads a record, or a line without its end; `Some(false)` at the end of the program, `None` when it cannot be read or its last
    /// line has no end, which is how a program cut short looks.
    fn fetch(&mut self) -> Option<bool> {
        self.line.clear();
        match &mut self.form {
            Form::Array(left) => return npy::record(self.input, left, &mut self.line),
            Form::Counts(_, left) => return Counts::record(self.input, left, &mut self.line),
            Form::Table | Form::Stream(_) => {}
        }
        let read = self.input.take(LINE_MAX).read_until(b'\n', &mut self.line).ok()?;
        if read == 0 {
            return Some(false);
        }
        if self.line.pop() != Some(b'\n') {
            return None;
        }
        if self.line.last() == Some(&b'\r') {
            self.line.pop();
        }
        Some(true)
    }

    fn fail(&mut self) {
        self.ended = true;
        let place = self.last.map(|row| row.sighting());
        let nowhere = Sighting { time: Some(0.0), point: Point::origin(), block: 0 };
        self.worst.see(1.0, || place.unwrap_or(nowhere));
    }
}

fn parse(line: &[u8], tick: u64) -> Option<Row> {
    let mut fields = line.split(|&b| b == b',');
    let mut field = || fields.next();
    let (t, x, y, c_deg) = (decimal(field()?)?, decimal(field()?)?, decimal(field()?)?, decimal(field()?)?);
    let (knife, drill, event, block) = (whole(field()?)?, whole(field()?)?, whole(field()?)?, whole(field()?)?);
    let legal = knife <= 1 && drill <= 4 && event <= 2 && field().is_none();
    legal.then(|| Row {
        tick,
        t,
        centre: Point::new(x, y),
        c_deg,
        knife: knife == 1,
        drill: drill as u8,
        event: event as u8,
        block,
    })
}

/// A whole number below 2^32.
pub(super) fn whole(field: &[u8]) -> Option<u32> {
    if field.is_empty() || field.len() > 10 {
        return None;
    }
    let value = field.iter().try_fold(0_u64, |sum, b| b.is_ascii_digit().then(|| sum * 10 + u64::from(b - b'0')))?;
    u32::try_from(value).ok()
}

/// Largest number of digits that a whole number may have to be exact in `f64`.
const EXACT_DIGITS: usize = 15;
const POWERS: [f64; 16] = [1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15];

/// A decimal number, correctly rounded: digits and a power of ten that are both exact give one rounding.
pub(super) fn decimal(field: &[u8]) -> Option<f64> {
    let (sign, digits) = match field {
        [b'-', rest @ ..] => (-1.0, rest),
        rest => (1.0, rest),
    };
    let (mut value, mut count, mut decimals, mut point) = (0_u64, 0, 0, false);
    for &b in digits {
        match b {
            b'0'..=b'9' if count < EXACT_DIGITS => {
                value = value * 10 + u64::from(b - b'0');
                count += 1;
                decimals += usize::from(point);
            }
            b'.' if !point => point = true,
            // Exponents and long numbers: the standard library; it also knows words, which are no numbers here.
            b'0'..=b'9' | b'e' | b'E' | b'+' | b'-' => {
                let number: f64 = std::str::from_utf8(field).ok()?.parse().ok()?;
                return number.is_finite().then_some(number);
            }
            _ => return None,
        }
    }
    (count > 0).then(|| sign * (value as f64 / POWERS[decimals]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn decimals_are_read_as_the_standard_library_reads_them() {
        for text in ["0", "-0.000001", "12.345678", "-98765.432100", "1e-3", "123456789012345678.5"] {
            assert_eq!(decimal(text.as_bytes()), text.parse().ok(), "{text}");
        }
        for text in ["", "-", ".", "nan", "inf", "1,5", "0x10", "1.2.3", " 1"] {
            assert_eq!(decimal(text.as_bytes()), None, "{text}");
        }
    }

    #[test]
    fn a_last_line_without_its_end_is_a_fault() {
        let text =
            "t_s,x_mm,y_mm,c_deg,knife,drill,event,block\n0.000000,0.0,0.0,0.0,0,0,0,0\n0.001000,0.0,0.0,0.0,0,0,0,0";
        let (mut bytes, profile) = (text.as_bytes(), MachineProfile::default());
        let mut rows = Rows::new(&mut bytes, &profile);
        assert!(rows.next().is_some());
        assert!(rows.next().is_none());
        assert!(!rows.finding().holds());
    }
}
