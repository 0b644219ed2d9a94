//! The bytes of one input file, and places in them.
//!
//! Input is read once into memory and never changed. A [`Span`] accompanies everything made from the bytes, down to the emitted
//! program; a [`Place`] is the same position in the form that people use.

mod csv;

use thiserror::Error;

pub use csv::{CsvFault, CsvLines, csv_fields, csv_number, csv_rows};

/// A complete input: its name as given by the user, and its bytes.
#[derive(Debug)]
pub struct Source {
    name: String,
    bytes: Vec<u8>,
}

/// The input is larger than spans can address.
#[derive(Debug, Error, PartialEq, Eq)]
#[error("the input has {0} bytes; the most is 4 GiB less one")]
pub struct TooLarge(pub usize);

impl Source {
    /// Takes ownership of the bytes of a file called `name`.
    pub fn new(name: impl Into<String>, bytes: Vec<u8>) -> Result<Self, TooLarge> {
        if u32::try_from(bytes.len()).is_err() {
            return Err(TooLarge(bytes.len()));
        }
        Ok(Self { name: name.into(), bytes })
    }

    /// Name for display.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// All bytes.
    pub fn bytes(&self) -> &[u8] {
        &self.bytes
    }

    /// The bytes of a span, clipped at the end of the source.
    pub fn slice(&self, span: Span) -> &[u8] {
        let end = (span.end as usize).min(self.bytes.len());
        &self.bytes[(span.start as usize).min(end)..end]
    }

    /// Start of a span in the form that people use: block and line from 1, byte from 0.
    pub fn place(&self, span: Span) -> Place {
        self.lines().place(span)
    }

    /// A line counter for the places of many spans, fastest when they are in order.
    pub fn lines(&self) -> Lines<'_> {
        Lines { bytes: &self.bytes, end: line_end(&self.bytes), at: 0, breaks: 0 }
    }
}

/// The byte that ends the lines of a text: a line feed, or a carriage return where there is none, as in files of old programs.
pub fn line_end(bytes: &[u8]) -> u8 {
    if memchr::memchr(b'\n', bytes).is_some() { b'\n' } else { b'\r' }
}

/// Counts the lines of a [`Source`], forwards or back from the last requested place.
#[derive(Debug)]
pub struct Lines<'a> {
    bytes: &'a [u8],
    end: u8,
    /// Bytes counted so far, and the line breaks among them.
    at: usize,
    breaks: usize,
}

impl Lines<'_> {
    /// The place at the start of a span.
    pub fn place(&mut self, span: Span) -> Place {
        let start = (span.start as usize).min(self.bytes.len());
        let count = |bytes: &[u8]| memchr::memchr_iter(self.end, bytes).count();
        if start >= self.at {
            self.breaks += count(&self.bytes[self.at..start]);
        } else {
            self.breaks -= count(&self.bytes[start..self.at]);
        }
        self.at = start;
        Place { block: span.block, line: 1 + self.breaks as u32, byte: span.start }
    }
}

/// A half-open range of bytes of a [`Source`], and the number of its block.
///
/// A block is the unit of the dialect: a statement up to its `*` in a cut file, a row in a CSV file. Blocks count from 1; 0
/// means no block.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Hash, PartialOrd, Ord)]
pub struct Span {
    /// First byte.
    pub start: u32,
    /// One past the last byte.
    pub end: u32,
    /// Number of the block, from 1; 0 = none.
    pub block: u32,
}

impl Span {
    /// The span from the start of `self` to the end of `other`, in the block of `self`.
    #[must_use]
    pub fn to(self, other: Self) -> Self {
        Self { end: other.end.max(self.end), ..self }
    }
}

/// A position in a source, as named in messages.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Place {
    /// Number of the block, from 1; 0 = none.
    pub block: u32,
    /// Number of the line, from 1.
    pub line: u32,
    /// Offset of the byte, from 0.
    pub byte: u32,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_end_at_carriage_returns_where_no_line_feed_is() {
        let source = Source::new("a", b"0\rSECTION\r2\r".to_vec()).expect("small");
        assert_eq!(source.place(Span { start: 10, end: 11, block: 2 }).line, 3);
        assert_eq!((line_end(b"0\r\nSECTION\r\n"), line_end(b"0")), (b'\n', b'\r'));
    }

    #[test]
    fn a_place_counts_lines_from_one() {
        let source = Source::new("a", b"H1*\nX0Y0*\nM0*".to_vec()).expect("small");
        let place = source.place(Span { start: 4, end: 8, block: 2 });
        assert_eq!(place, Place { block: 2, line: 2, byte: 4 });
        assert_eq!(source.slice(Span { start: 10, end: 99, block: 3 }), b"M0*");
    }
}
