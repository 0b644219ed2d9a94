//! CSV files of numbers that accompany a source: their rows after a header, with positions.

use super::{Span, line_end};

/// Non-blank lines of a text, each with its span. The block of a line is its number. A byte order mark is skipped.
#[derive(Debug)]
pub struct CsvLines<'a> {
    bytes: &'a [u8],
    end: u8,
    at: usize,
    block: u32,
}

impl<'a> CsvLines<'a> {
    /// The lines of the bytes of a source.
    pub fn of(bytes: &'a [u8]) -> Self {
        Self { bytes, end: line_end(bytes), at: 0, block: 0 }
    }
}

impl<'a> Iterator for CsvLines<'a> {
    type Item = (&'a [u8], Span);

    fn next(&mut self) -> Option<Self::Item> {
        while self.at < self.bytes.len() {
            let rest = &self.bytes[self.at..];
            let length = memchr::memchr(self.end, rest).unwrap_or(rest.len());
            let (start, line) = (self.at, &rest[..length]);
            self.at += length + 1;
            self.block += 1;
            let line = if start == 0 { line.strip_prefix(b"\xef\xbb\xbf").unwrap_or(line) } else { line };
            if !line.trim_ascii().is_empty() {
                // A `Source` is below 4 GiB.
                let span = Span { start: start as u32, end: (start + length) as u32, block: self.block };
                return Some((line, span));
            }
        }
        None
    }
}

/// A fault in a CSV file.
#[derive(Debug, Clone, PartialEq)]
pub enum CsvFault {
    /// The first row is not the header.
    Header(Span),
    /// A row that cannot be read, with the reason.
    Row(Span, String),
}

/// The rows after a header, each with its span.
///
/// # Errors
///
/// All faulty rows, or the header alone.
pub fn csv_rows<T>(
    bytes: &[u8],
    header: &str,
    mut parse: impl FnMut(&str) -> Result<T, String>,
) -> Result<Vec<(T, Span)>, Vec<CsvFault>> {
    let mut lines = CsvLines::of(bytes);
    // Some programs write blanks, quotes and capitals.
    let is_header = |line: &[u8]| {
        let letters = line.iter().filter(|byte| !b" \t\r\"".contains(byte));
        letters.map(u8::to_ascii_lowercase).eq(header.bytes())
    };
    if let Some((_, span)) = lines.next().filter(|(line, _)| !is_header(line)) {
        return Err(vec![CsvFault::Header(span)]);
    }
    let (mut rows, mut faults) = (Vec::new(), Vec::new());
    for (line, span) in lines {
        let text = std::str::from_utf8(line).map_err(|_| "the row is no text".to_owned());
        match text.and_then(&mut parse) {
            Ok(row) => rows.push((row, span)),
            Err(message) => faults.push(CsvFault::Row(span, message)),
        }
    }
    if faults.is_empty() { Ok(rows) } else { Err(faults) }
}

/// The fields of a row with exactly `N` fields.
///
/// # Errors
///
/// A message with both counts.
pub fn csv_fields<const N: usize>(row: &str) -> Result<[&str; N], String> {
    let fields: Vec<&str> = row.split(',').map(str::trim).collect();
    let count = fields.len();
    fields
        .try_into()
        .map_err(|_| format!("the row has {count} {} instead of {N}", if count == 1 { "field" } else { "fields" }))
}

/// The number in a field, at most `most` in magnitude; `what` names the field in the message.
///
/// # Errors
///
/// A message that quotes the field.
pub fn csv_number(field: &str, what: &str, most: f64) -> Result<f64, String> {
    match field.parse::<f64>() {
        Ok(value) if value.abs() <= most => Ok(value + 0.0), // zero has no sign
        Ok(_) | Err(_) => Err(format!("`{}` is no {what}", field.escape_debug())),
    }
}
