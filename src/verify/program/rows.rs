//! Reader of rows of timed setpoints: `t_s,x_mm,y_mm,c_deg,knife,drill,event,block`, as text or as records. With a conveyor,
//! `advance_mm` follows: the advance of the cloth so far.

use std::io::{BufRead, Read as _};

use super::counts::{self, Counts};
use super::number::{decimal, leading, quoted, whole};
use super::row::{FIRST_LINE, ROUNDING, Rounding, Row};
use super::{hal, npy};
use crate::geom::Point;
use crate::ir::Finding;
use crate::ir::verdict::Sighting;
use crate::machine::MachineProfile;
use crate::verify::rules;

/// Longest line that is read, bytes: a longer one is not a row and must not fill the memory.
const LINE_MAX: u64 = 1024;
/// First line of a text: the names of its fields.
pub(super) const HEADER: &str = "t_s,x_mm,y_mm,c_deg,knife,drill,event,block";
/// Field added with a conveyor.
const ADVANCE: &str = ",advance_mm";
/// Names of all fields, one by one.
const FIELDS: [&str; 9] = ["t_s", "x_mm", "y_mm", "c_deg", "knife", "drill", "event", "block", "advance_mm"];
/// Number of fields without a conveyor.
const PLAIN_FIELDS: usize = FIELDS.len() - 1;
/// Greatest values of knife, drill, event and block.
const GREATEST: [u32; 4] = [1, 4, 2, u32::MAX];

/// Format of the rows.
#[derive(Debug)]
enum Form<'a> {
    /// Lines of comma-separated fields, and the number of fields.
    Table(usize),
    /// Records: number of records still expected, and bytes of each.
    Array(u64, usize),
    /// Records of encoder counts, and the number still expected.
    Counts(Counts, u64),
    /// Lines of blank-separated fields for this machine, and true if a conveyor adds a field.
    Stream(&'a MachineProfile, bool),
}

/// Iterator over the rows of a program. Rows that cannot be read are skipped and counted.
pub(in crate::verify) struct Rows<'a> {
    input: &'a mut dyn BufRead,
    form: Form<'a>,
    /// Line or record that was read last.
    line: Vec<u8>,
    tick: u64,
    last: Option<Row>,
    bad: Bad,
    ended: bool,
}

/// Rows that cannot be read.
#[derive(Debug, Default)]
struct Bad {
    count: u64,
    /// Place of the first such row, and its error.
    first: Option<(Sighting, String)>,
}

/// Result of fetching a line or record.
enum Fetched {
    Row,
    End,
    Bad(&'static str),
}

impl<'a> Rows<'a> {
    pub(in crate::verify) fn new(input: &'a mut dyn BufRead, profile: &'a MachineProfile) -> Self {
        let (form, bad) = (Form::Table(PLAIN_FIELDS), Bad::default());
        let mut rows = Self { input, form, line: Vec::new(), tick: 0, last: None, bad, ended: false };
        if npy::begins(rows.input) {
            let told = npy::header(rows.input);
            let (count, bytes) = told.unwrap_or_default();
            rows.form = Form::Array(count, bytes);
            if told.is_none() {
                rows.end("the header is none of setpoints");
            }
        } else if counts::begins(rows.input) {
            match Counts::read(rows.input, profile) {
                Some((counts, left)) => rows.form = Form::Counts(counts, left),
                None => rows.end("the header is none of encoder counts of this machine"),
            }
        } else {
            let is_stream = hal::begins(rows.input);
            let [header, advance] =
                if is_stream { [hal::HEADER, hal::ADVANCE] } else { [HEADER.as_bytes(), ADVANCE.as_bytes()] };
            let is_row = matches!(rows.fetch(), Fetched::Row);
            let behind = rows.line.strip_prefix(header);
            let has_advance = behind == Some(advance);
            let is_header = is_row && (has_advance || behind == Some(&[]));
            rows.form = match (is_stream, has_advance) {
                (true, _) => Form::Stream(profile, has_advance),
                (false, true) => Form::Table(FIELDS.len()),
                (false, false) => Form::Table(PLAIN_FIELDS),
            };
            if !is_header {
                rows.end(&format!("line 1 is not the header `{}`", String::from_utf8_lossy(header)));
            }
        }
        rows
    }

    /// Greatest difference between the numbers of rows and the intended values.
    pub(in crate::verify) fn rounding(&self) -> Rounding {
        let axes = match &self.form {
            Form::Counts(counts, _) => counts.rounding(),
            Form::Table(_) | Form::Array(..) | Form::Stream(..) => [ROUNDING; 3],
        };
        Rounding { axes }
    }

    /// Next row that can be read.
    pub(in crate::verify) fn next(&mut self) -> Option<Row> {
        while !self.ended {
            match self.fetch() {
                Fetched::Row => {}
                Fetched::End if self.tick == 0 => self.end("there are no rows"),
                Fetched::End => self.ended = true,
                Fetched::Bad(why) => self.end(&format!("{} {why}", self.place())),
            }
            if self.ended {
                break;
            }
            let row = self.parsed();
            if let Err(why) = &row {
                self.fail(&format!("{} {why}", self.place()));
            }
            self.tick += 1;
            if let Ok(row) = row {
                self.last = Some(row);
                return Some(row);
            }
        }
        None
    }

    /// Row of the line or record that was read last; the error is the end of a message about it.
    fn parsed(&mut self) -> Result<Row, String> {
        let row = match &mut self.form {
            Form::Table(count) => return parse(&self.line, self.tick, *count),
            Form::Array(..) => npy::row(&self.line, self.tick),
            Form::Counts(counts, _) => counts.row(&self.line, self.tick),
            Form::Stream(profile, has_advance) => hal::row(&self.line, self.tick, *has_advance, profile),
        };
        row.ok_or_else(|| "holds no finite numbers and legal outputs".to_owned())
    }

    /// True if a row could not be read so far, so that nothing can be said about the program's effect.
    pub(in crate::verify) fn is_broken(&self) -> bool {
        self.bad.count > 0
    }

    /// Finding on the format, and a message when the format is broken.
    pub(in crate::verify) fn findings(self) -> (Finding, Option<String>) {
        let Bad { count, first } = self.bad;
        let (place, why) = first.unzip();
        let rule = &rules::FORMAT;
        let finding = Finding { rule, worst: count as f64, limit: Some(0.0), unit: rule.unit, place };
        let why = why.map(|why| if count > 1 { format!("{count} rows cannot be read, the first: {why}") } else { why });
        (finding, why)
    }

    /// Line or record that was read last, for messages: lines count from 1, and line 1 is the header.
    fn place(&self) -> String {
        let what = if matches!(self.form, Form::Table(_) | Form::Stream(..)) { "line" } else { "record" };
        format!("{what} {}", self.number())
    }

    /// Reads a record, or a line without its line feed. A last line without a line feed indicates a truncated program.
    fn fetch(&mut self) -> Fetched {
        self.line.clear();
        let record = match &mut self.form {
            Form::Array(left, bytes) => Some(npy::record(self.input, left, *bytes, &mut self.line)),
            Form::Counts(counts, left) => Some(counts.record(self.input, left, &mut self.line)),
            Form::Table(_) | Form::Stream(..) => None,
        };
        if let Some(record) = record {
            return match record {
                Some(true) => Fetched::Row,
                Some(false) => Fetched::End,
                None => Fetched::Bad("is not what the header counts: bytes are missing or left over"),
            };
        }
        let Ok(read) = self.input.take(LINE_MAX).read_until(b'\n', &mut self.line) else {
            return Fetched::Bad("cannot be read");
        };
        if read == 0 {
            return Fetched::End;
        }
        if self.line.pop() != Some(b'\n') {
            return Fetched::Bad(if read as u64 == LINE_MAX {
                "is too long for a row"
            } else {
                "has no end: the file is cut short"
            });
        }
        if self.line.last() == Some(&b'\r') {
            self.line.pop();
        }
        Fetched::Row
    }

    /// Number of the line or record that was read last.
    fn number(&self) -> u64 {
        match self.form {
            Form::Table(_) | Form::Stream(..) => self.tick + FIRST_LINE,
            Form::Array(..) | Form::Counts(..) => self.tick,
        }
    }

    fn fail(&mut self, why: &str) {
        self.bad.count += 1;
        if self.bad.first.is_none() {
            let nowhere = Sighting::at(0.0, Point::origin(), 0);
            // Use the axis position of the last good row with the line number of the bad one.
            let place = self.last.map_or(nowhere, |row| row.sighting());
            self.bad.first = Some((Sighting { line: Some(self.number()), ..place }, why.to_owned()));
        }
    }

    fn end(&mut self, why: &str) {
        self.fail(why);
        self.ended = true;
    }
}

/// True if the text looks like rows: it begins with their header.
pub(in crate::verify) fn begins(input: &mut dyn BufRead) -> bool {
    input.fill_buf().is_ok_and(|bytes| bytes.starts_with(HEADER.as_bytes()))
}

/// Reason why bytes do not begin like the text of a program, and advice; `None` when they do.
pub(in crate::verify) fn foreign(bytes: &[u8]) -> Option<[String; 2]> {
    let first = bytes.split(|&b| b == b'\n').next().unwrap_or_default();
    let first = first.strip_suffix(b"\r").unwrap_or(first);
    if first.strip_prefix(HEADER.as_bytes()).is_some_and(|behind| behind.is_empty() || behind == ADVANCE.as_bytes()) {
        return None;
    }
    let says = |what: &str, hint: &str| Some([what.to_owned(), hint.to_owned()]);
    let as_compiled = format!("the first line of a program is `{HEADER}`");
    if bytes.is_empty() {
        return says("it is empty", "compile it anew");
    }
    if first.starts_with(b"\xef\xbb\xbf") {
        return says("it begins with a byte order mark (BOM)", "save it as UTF-8 without BOM");
    }
    if bytes.contains(&0) {
        return says("it is not plain text", "save it as UTF-8 or ASCII text, or name another file");
    }
    let text = String::from_utf8_lossy(first);
    for separator in [';', '\t', ' '] {
        if text.replace(separator, ",") == HEADER {
            let message = format!("its fields are separated by `{}`, not by commas", separator.escape_default());
            return says(&message, "save it with commas between the fields and points in the numbers");
        }
    }
    if [PLAIN_FIELDS, FIELDS.len()].iter().any(|&count| parse(first, 0, count).is_ok()) {
        return says("its header is missing: it begins with a row", &as_compiled);
    }
    let names: Vec<&str> = text.split(',').collect();
    let fields = if names.len() == FIELDS.len() { &FIELDS[..] } else { &FIELDS[..PLAIN_FIELDS] };
    let known = names.iter().filter(|name| FIELDS.contains(name)).count();
    if 2 * known < PLAIN_FIELDS {
        return says("it does not begin as timed setpoints do", &as_compiled);
    }
    let wrong = names.iter().zip(fields).find(|(name, expected)| name != expected);
    let message = match wrong {
        Some((name, expected)) => format!("its header says {} where `{expected}` belongs", quoted(name.as_bytes())),
        None => format!("its header has {} fields, not {PLAIN_FIELDS}", names.len()),
    };
    says(&message, &as_compiled)
}

/// Row of a line with that number of fields. The error continues a message after the line number.
fn parse(line: &[u8], tick: u64, fields: usize) -> Result<Row, String> {
    let count = || line.split(|&b| b == b',').count();
    row(line, tick, fields > PLAIN_FIELDS).map_err(|why| match count() {
        _ if line.is_empty() => "is blank".to_owned(),
        count if count == fields => why,
        1 => format!("has 1 field, not {fields}"),
        count => format!("has {count} fields, not {fields}"),
    })
}

/// Fields of a row: numbers, then outputs.
type Fields = ([f64; 4], [u32; 4]);

fn row(mut line: &[u8], tick: u64, has_advance: bool) -> Result<Row, String> {
    let mut station = 0;
    if has_advance {
        let comma = line.iter().rposition(|&byte| byte == b',').ok_or_else(String::new)?;
        let told = &line[comma + 1..];
        station =
            whole(told).ok_or_else(|| format!("has {} as advance_mm, which is no way in whole mm", quoted(told)))?;
        line = &line[..comma];
    }
    let ([t, x, y, c_deg], [knife, drill, event, block]) = plain(line).map_or_else(|| fields(line), Ok)?;
    Ok(Row {
        tick,
        t,
        centre: Point::new(x, y),
        c_deg,
        knife: knife == 1,
        drill: drill as u8,
        event: event as u8,
        block,
        station,
        line: tick + FIRST_LINE,
    })
}

/// Fields of a row of numbers with few digits, the usual case; `None` for any other line.
fn plain(line: &[u8]) -> Option<Fields> {
    let (mut numbers, mut outputs, mut rest) = ([0.0; 4], [0; 4], line);
    for number in &mut numbers {
        let (value, length) = leading(rest)?;
        (*number, rest) = (value, rest[length..].strip_prefix(b",")?);
    }
    for (output, most) in outputs[..3].iter_mut().zip(GREATEST) {
        let [digit, b',', behind @ ..] = rest else { return None };
        let value = u32::from(digit.wrapping_sub(b'0'));
        (*output, rest) = (Some(value).filter(|value| *value <= most)?, behind);
    }
    outputs[3] = whole(rest)?;
    Some((numbers, outputs))
}

/// Fields of any row; the error says which field is wrong.
fn fields(line: &[u8]) -> Result<Fields, String> {
    let mut fields = line.split(|&b| b == b',');
    let mut field = || fields.next().unwrap_or_default();
    let mut numbers = [0.0; 4];
    for (number, name) in numbers.iter_mut().zip(&FIELDS[..4]) {
        let field = field();
        *number = decimal(field).ok_or_else(|| format!("has {} as {name}, which is no number", quoted(field)))?;
    }
    let mut outputs = [0; 4];
    for (i, output) in outputs.iter_mut().enumerate() {
        let (field, most) = (field(), GREATEST[i]);
        let value = whole(field).filter(|value| *value <= most);
        let name = FIELDS[4 + i];
        *output = value.ok_or_else(|| format!("has {} as {name}, which must be 0 to {most}", quoted(field)))?;
    }
    if fields.next().is_some() {
        return Err(String::new());
    }
    Ok((numbers, outputs))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_header_names_the_fields() {
        assert_eq!(FIELDS.join(","), format!("{HEADER}{ADVANCE}"));
    }

    #[test]
    fn a_last_line_without_its_end_is_a_fault() {
        let text =
            "t_s,x_mm,y_mm,c_deg,knife,drill,event,block\n0.000000,0.0,0.0,0.0,0,0,0,0\n0.001000,0.0,0.0,0.0,0,0,0,0";
        let (mut bytes, profile) = (text.as_bytes(), MachineProfile::default());
        let mut rows = Rows::new(&mut bytes, &profile);
        assert!(rows.next().is_some());
        assert!(rows.next().is_none());
        let (finding, why) = rows.findings();
        assert!(!finding.holds());
        assert_eq!(why.as_deref(), Some("line 3 has no end: the file is cut short"));
    }

    #[test]
    fn the_first_line_that_is_no_row_is_named_with_the_reason_and_all_are_counted() {
        let check = |line: &str, expected: &str| {
            let text = format!("{HEADER}\n0.000,0,0,0,0,0,0,0\n{line}\n0.002,0,0,0,0,0,0,0\n");
            let mut bytes = text.as_bytes();
            let profile = MachineProfile::default();
            let mut rows = Rows::new(&mut bytes, &profile);
            assert_eq!([rows.next(), rows.next()].map(|row| row.map(|row| row.tick)), [Some(0), Some(2)], "{line}");
            assert!(rows.next().is_none() && rows.is_broken());
            let (finding, why) = rows.findings();
            assert_eq!((finding.worst, why.as_deref()), (1.0, Some(expected)));
        };
        check("0.001,abc,0,0,0,0,0,0", "line 3 has `abc` as x_mm, which is no number");
        check("0.001,0,,0,0,0,0,0", "line 3 has nothing as y_mm, which is no number");
        check("0.001,0,0,0,2,0,0,0", "line 3 has `2` as knife, which must be 0 to 1");
        check("0.001,0,0,0,0,5,0,0", "line 3 has `5` as drill, which must be 0 to 4");
        check("0.001,0,0,0,0,0,0,-1", "line 3 has `-1` as block, which must be 0 to 4294967295");
        check("0.001,0,0,0,0,0,0", "line 3 has 7 fields, not 8");
        check("", "line 3 is blank");
        let text = format!("{HEADER}\nx\ny\n");
        let mut bytes = text.as_bytes();
        let profile = MachineProfile::default();
        let mut rows = Rows::new(&mut bytes, &profile);
        assert!(rows.next().is_none());
        assert_eq!(rows.findings().1.as_deref(), Some("2 rows cannot be read, the first: line 2 has 1 field, not 8"));
    }

    #[test]
    fn what_is_no_program_is_told_apart() {
        let check = |text: &str, expected: Option<&str>| {
            let found = foreign(text.as_bytes()).map(|[what, _]| what);
            assert!(found.is_some() == expected.is_some(), "{text}: {found:?}");
            assert!(found.unwrap_or_default().contains(expected.unwrap_or_default()), "{text}");
        };
        check(&format!("{HEADER}\r\n"), None);
        check("", Some("empty"));
        check(&format!("\u{feff}{HEADER}\n"), Some("byte order mark"));
        check(&HEADER.replace(',', ";"), Some("separated by `;`"));
        check(&HEADER.replace(',', "\t"), Some("separated by `\\t`"));
        check("0.000,0,0,0,0,0,0,0\n", Some("header is missing"));
        check(&HEADER.replace("c_deg", "c_rad"), Some("says `c_rad` where `c_deg` belongs"));
        check(&format!("{HEADER}{ADVANCE}\n"), None);
        check(&format!("{HEADER},more"), Some("says `more` where `advance_mm` belongs"));
        check(&format!("{HEADER}{ADVANCE},more"), Some("has 10 fields"));
        check("0.000,0,0,0,0,0,0,0,0\n", Some("header is missing"));
        check("M14*X0Y0*", Some("does not begin"));
        check("t\0_\0s\0", Some("not plain text"));
    }
}
