//! Groups: bytes are split into pairs of lines, a code and its value.

use super::syntax::code;
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::source::{Source, Span, line_end};

/// A code and its value.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::front) struct Group {
    pub(in crate::front) code: i32,
    /// The bytes of the value, trimmed; the block number of the span is the number of the group in the file, from 1.
    pub(in crate::front) value: Span,
}

/// The value of the group that ends a file.
const END_OF_FILE: &[u8] = b"EOF";
/// Mark that many programs write before UTF-8 text.
const BYTE_ORDER_MARK: &[u8] = b"\xef\xbb\xbf";
/// Maximum number of reported faults of one kind; a file with more is of another format.
const MOST_FAULTS: usize = 20;

/// The lines of a file without line breaks, each with the offset of its first byte.
struct Lines<'a> {
    bytes: &'a [u8],
    end: u8,
    at: usize,
}

impl<'a> Lines<'a> {
    fn next(&mut self) -> Option<(usize, &'a [u8])> {
        let rest = self.bytes.get(self.at..).filter(|rest| !rest.is_empty())?;
        let length = memchr::memchr(self.end, rest).unwrap_or(rest.len());
        let start = self.at;
        self.at += length + 1;
        Some((start, &rest[..length]))
    }
}

/// The span of a line, trimmed.
fn trimmed(start: usize, line: &[u8], block: u32) -> Span {
    let blanks = line.len() - line.trim_ascii_start().len();
    let start = start + blanks;
    Span { start: start as u32, end: (start + line.trim_ascii().len()) as u32, block }
}

/// Reads the groups of a file up to its end mark; nothing may follow it. A line that should be a code and is none is reported,
/// and lines are skipped up to the next group that begins an entity.
pub(in crate::front) fn groups(source: &Source, out: &mut Diagnostics) -> Vec<Group> {
    let bytes = source.bytes();
    let at = if bytes.starts_with(BYTE_ORDER_MARK) { BYTE_ORDER_MARK.len() } else { 0 };
    let mut lines = Lines { bytes, end: line_end(bytes), at };
    let mut groups: Vec<Group> = Vec::with_capacity(bytes.len() / 10);
    let (mut faults, mut is_lost) = (0, false);
    while let Some((start, line)) = lines.next() {
        let number = groups.len() as u32 + 1;
        let code = code(line);
        if is_lost && code != Some(0) {
            continue;
        }
        let Some(code) = code else {
            if line.trim_ascii().is_empty() && bytes[start..].trim_ascii().is_empty() {
                break; // blank lines at the end
            }
            is_lost = true;
            faults += 1;
            if faults <= MOST_FAULTS {
                let message = "a code should stand in this line: a whole number";
                let finding = Diagnostic::new(&code::DXF_GROUP, message).at(trimmed(start, line, number));
                out.push(finding.hint("a line is missing or too many before it; export the file again"));
            }
            continue;
        };
        let Some((start, line)) = lines.next() else { break };
        let value = trimmed(start, line, number);
        if is_lost && !source.slice(value).first().is_some_and(u8::is_ascii_alphabetic) {
            continue;
        }
        is_lost = false;
        groups.push(Group { code, value });
        if code == 0 && source.slice(value).eq_ignore_ascii_case(END_OF_FILE) {
            // Some programs leave a control character after the end mark.
            let is_more = bytes.get(lines.at..).unwrap_or_default().iter().any(u8::is_ascii_graphic);
            if is_more {
                let finding = Diagnostic::new(&code::DXF_CUT_SHORT, "the file goes on behind its EOF").at(value);
                out.push(finding.hint("an end that stands amid a file hides the rest of it: export it again"));
            }
            return groups;
        }
    }
    let span = groups.last().map_or(Span::default(), |group| group.value);
    let finding = Diagnostic::new(&code::DXF_CUT_SHORT, "the file does not end with EOF: it was cut short").at(span);
    out.push(finding.hint("transfer it again and compare the sizes of both files"));
    groups
}
