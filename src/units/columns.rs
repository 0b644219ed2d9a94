//! Reader of columnar programs: lines of comma-separated fields, or records of a `NumPy` array. The meaning of the fields is
//! defined by the machine.

use std::io::{self, BufRead};

/// Magic string of a `NumPy` array; no text starts with it.
pub const MAGIC: &[u8] = b"\x93NUMPY";

/// Reason why the rest of a program was not read.
#[derive(Debug)]
pub enum Unread {
    /// An error of the disk.
    Io(io::Error),
    /// A row, record or key that does not belong to a program.
    Row(String),
}

impl From<io::Error> for Unread {
    fn from(error: io::Error) -> Self {
        Self::Io(error)
    }
}

impl Unread {
    /// Error for a row that cannot be read, numbered from 1.
    pub fn row(number: u64, what: &str) -> Self {
        Self::Row(format!("row {number}: {what}"))
    }

    fn array(what: &str) -> Self {
        Self::Row(format!("the array: {what}"))
    }
}

/// Lines of a text, numbered from 1.
#[derive(Debug, Default)]
pub struct Lines {
    line: Vec<u8>,
    number: u64,
}

impl Lines {
    /// The next line without its line end; `None` after the last.
    ///
    /// # Errors
    ///
    /// Errors of the disk; a line that is not text, or that has no line end, as in a truncated program.
    pub fn next(&mut self, input: &mut dyn BufRead) -> Result<Option<&str>, Unread> {
        self.line.clear();
        self.number += 1;
        if input.read_until(b'\n', &mut self.line)? == 0 {
            return Ok(None);
        }
        let text = self.line.strip_suffix(b"\n").ok_or_else(|| self.is("it is cut off"))?;
        let text = text.strip_suffix(b"\r").unwrap_or(text);
        std::str::from_utf8(text).map(Some).map_err(|_| self.is("it is no text"))
    }

    /// Reads the first line, which names the fields.
    ///
    /// # Errors
    ///
    /// Errors of [`Self::next`]; a line with other names.
    pub fn header(&mut self, input: &mut dyn BufRead, names: &str) -> Result<(), Unread> {
        match self.next(input)? {
            Some(line) if line == names => Ok(()),
            Some(_) => Err(self.is(&format!("it is not the header `{names}`"))),
            None => Err(self.is("there is no row")),
        }
    }

    /// Number of the last line read.
    pub fn number(&self) -> u64 {
        self.number
    }

    /// Error for that line.
    pub fn is(&self, what: &str) -> Unread {
        Unread::row(self.number, what)
    }
}

/// Reads the header of an array of packed records with the given fields, as Python writes them, and returns the number of
/// records.
///
/// # Errors
///
/// Errors of the disk; a file that is not an array, or an array with other fields.
pub fn records(input: &mut dyn BufRead, fields: &str) -> Result<u64, Unread> {
    records_of(input, &[fields]).map(|(count, _)| count)
}

/// Number of records of an array, and the index into `lists` of its fields.
///
/// # Errors
///
/// As for [`records`].
pub fn records_of(input: &mut dyn BufRead, lists: &[&str]) -> Result<(u64, usize), Unread> {
    let mut start = [0; 8];
    fill(input, &mut start, "its header is cut off")?;
    if !start.starts_with(MAGIC) {
        return Err(Unread::array("it is none of NumPy"));
    }
    // Version 1 has a header size of two bytes, later versions of four; the minor version changes nothing.
    let mut size = [0; 4];
    fill(input, if start[6] == 1 { &mut size[..2] } else { &mut size[..] }, "its header is cut off")?;
    let size = u16::try_from(u32::from_le_bytes(size)).map_err(|_| Unread::array("its header is too long"))?;
    let mut text = vec![0; usize::from(size)];
    fill(input, &mut text, "its header is cut off")?;
    text.retain(|byte| !byte.is_ascii_whitespace());
    let behind =
        |fields: &&str| text.strip_prefix(format!("{{'descr':[{fields}],'fortran_order':False,'shape':(").as_bytes());
    let found = lists.iter().enumerate().find_map(|(list, fields)| Some((list, behind(fields)?)));
    let (list, rest) = found.ok_or_else(|| Unread::array("its records have other fields"))?;
    let digits = rest.iter().take_while(|byte| byte.is_ascii_digit()).count();
    let (count, end) = rest.split_at(digits);
    let count = std::str::from_utf8(count).ok().filter(|_| matches!(end, b",),}" | b",)}"));
    let count = count.and_then(|count| count.parse().ok());
    let count = count.ok_or_else(|| Unread::array("its header does not tell how many records it has"))?;
    Ok((count, list))
}

/// Reads the next record and decrements `left`, the number of records to come; `false` at the end of the program, which must be
/// the end of the file.
///
/// # Errors
///
/// Errors of the disk; an array that ends before its last record, or bytes after it.
pub fn record(input: &mut dyn BufRead, left: &mut u64, record: &mut [u8]) -> Result<bool, Unread> {
    if *left == 0 {
        let is_over = retried(input)?.is_empty();
        return if is_over { Ok(false) } else { Err(Unread::array("bytes stand behind its last record")) };
    }
    *left -= 1;
    fill(input, record, "it is cut off").map(|()| true)
}

/// Buffered bytes; empty at the end of the file.
fn retried(input: &mut dyn BufRead) -> io::Result<&[u8]> {
    while let Err(error) = input.fill_buf() {
        if error.kind() != io::ErrorKind::Interrupted {
            return Err(error);
        }
    }
    input.fill_buf()
}

fn fill(input: &mut dyn BufRead, bytes: &mut [u8], cut: &str) -> Result<(), Unread> {
    input.read_exact(bytes).map_err(|error| match error.kind() {
        io::ErrorKind::UnexpectedEof => Unread::array(cut),
        _ => Unread::Io(error),
    })
}

/// A little-endian number at an offset in a record; `None` when it is not finite.
pub fn float(record: &[u8], at: usize) -> Option<f64> {
    let bytes = record.get(at..)?.first_chunk()?;
    Some(f64::from_le_bytes(*bytes)).filter(|value| value.is_finite())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::units::array;

    const FIELDS: &str = "('t_s','<f8')";

    fn of_array(bytes: &[u8]) -> Result<Vec<f64>, String> {
        let mut input = bytes;
        let said = |unread: Unread| match unread {
            Unread::Row(what) => what,
            Unread::Io(error) => error.to_string(),
        };
        let mut left = records(&mut input, FIELDS).map_err(said)?;
        let (mut bytes, mut found) = ([0; 8], Vec::new());
        while record(&mut input, &mut left, &mut bytes).map_err(said)? {
            found.extend(float(&bytes, 0));
        }
        Ok(found)
    }

    #[test]
    fn records_end_with_the_array_and_the_array_with_them() {
        let mut array = array::header("('t_s', '<f8')", 2);
        array.extend([1.5_f64, -2.0].iter().flat_map(|value| value.to_le_bytes()));
        assert_eq!(of_array(&array), Ok(vec![1.5, -2.0]));
        assert_eq!(of_array(&array[..array.len() - 1]), Err("the array: it is cut off".to_owned()));
        assert_eq!(of_array(&array[..100]), Err("the array: its header is cut off".to_owned()));
        array.push(0);
        assert_eq!(of_array(&array), Err("the array: bytes stand behind its last record".to_owned()));
        let others = array::header("('t_s', '<f4')", 0);
        assert_eq!(of_array(&others), Err("the array: its records have other fields".to_owned()));
    }

    #[test]
    fn a_line_without_its_end_is_cut_off() {
        let (mut input, mut lines) = (&b"a,b\r\n1,2\n3"[..], Lines::default());
        lines.header(&mut input, "a,b").expect("the header");
        assert!(matches!(lines.next(&mut input), Ok(Some("1,2"))));
        assert!(matches!(lines.next(&mut input), Err(Unread::Row(what)) if what == "row 3: it is cut off"));
    }
}
