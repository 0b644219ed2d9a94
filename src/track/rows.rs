//! Rows of CSV: lines with their places, and the numbers in them.

use crate::source::Span;

/// Farthest places, mm: no conveyor is as long.
pub(super) const FARTHEST: f64 = 1e9;

/// The lines of a text that are not blank, with their spans.
pub(super) struct Lines<'a> {
    bytes: &'a [u8],
    at: usize,
    block: u32,
}

impl<'a> Lines<'a> {
    pub(super) fn of(bytes: &'a [u8]) -> Self {
        Self { bytes, at: 0, block: 0 }
    }
}

impl<'a> Iterator for Lines<'a> {
    type Item = (&'a [u8], Span);

    fn next(&mut self) -> Option<Self::Item> {
        while self.at < self.bytes.len() {
            let rest = &self.bytes[self.at..];
            let length = memchr::memchr(b'\n', rest).unwrap_or(rest.len());
            let (start, line) = (self.at, &rest[..length]);
            self.at += length + 1;
            self.block += 1;
            // A byte order mark says nothing.
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

/// The number of a field that is no greater than `most`; or what is wrong with it, as `what` is called.
pub(super) fn number(field: &str, what: &str, most: f64) -> Result<f64, String> {
    match field.parse::<f64>() {
        Ok(value) if value.abs() <= most => Ok(value + 0.0), // zero has no sign
        Ok(_) | Err(_) => Err(format!("`{}` is no {what}", field.escape_debug())),
    }
}
