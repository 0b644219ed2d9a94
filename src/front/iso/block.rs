//! Splitting of the bytes into blocks, which end with `*`, without line breaks, blanks and deleted passages.

use nom::Err;

use super::passed::Passed;
use super::run::Run;
use super::syntax::{self, Code, Fault, FaultKind, Point, Words};
use crate::diagnostic::{Diagnostic, code};
use crate::source::Span;

const BYTE_ORDER_MARK: &[u8] = b"\xef\xbb\xbf";

/// Iterator over the blocks of a file. A clone looks ahead.
#[derive(Debug)]
pub(super) struct Blocks<'a> {
    bytes: &'a [u8],
    at: usize,
    number: u32,
    ended: bool,
    /// A line of the file that contains only `%`: the first line, otherwise the last.
    frame: Option<Span>,
    passed: Passed,
    /// Buffers for the current block without its blanks, and for the offsets of its bytes.
    text: Vec<u8>,
    origins: Vec<usize>,
}

impl Clone for Blocks<'_> {
    /// A copy with empty buffers: one damaged block may have filled them with megabytes.
    fn clone(&self) -> Self {
        Self { text: Vec::new(), origins: Vec::new(), ..*self }
    }
}

/// A block of codes and coordinates, not of text.
#[derive(Debug)]
pub(super) struct Block {
    /// Its bytes, without the asterisk.
    pub(super) span: Span,
    /// Its content or its fault.
    pub(super) words: Result<Words, Diagnostic>,
}

/// Line breaks, blanks, NUL and the end mark of old systems have no meaning outside text.
fn is_blank(byte: u8) -> bool {
    matches!(byte, b' ' | b'\t' | b'\r' | b'\n' | 0 | 0x1a)
}

/// Bytes that a serial line adds between blocks: STX, ETX, XON and XOFF. They are rare, so that only the slow path knows them.
fn is_of_line(byte: u8) -> bool {
    matches!(byte, 0x02 | 0x03 | 0x11 | 0x13)
}

/// Blanks that may replace a lost digit. Only line breaks are permitted inside numbers, and NULs and end marks only between
/// blocks.
#[derive(Debug, Default)]
struct Gaps {
    blank: Option<usize>,
    mark: Option<usize>,
    /// The first one that is not a gap between words.
    wrong: Option<usize>,
}

impl Gaps {
    /// Records a blank inside the block.
    fn see(&mut self, byte: u8, at: usize) {
        match byte {
            b'\r' | b'\n' => {}
            b' ' | b'\t' => self.blank = self.blank.or(Some(at)),
            _ => self.mark = self.mark.or(Some(at)),
        }
    }

    /// Judges the recorded blanks at the next byte or the end of the block.
    fn close(&mut self, before: u8, behind: u8) {
        let is_number = |byte: u8| byte.is_ascii_digit() || byte == b'.';
        let is_amid = is_number(behind) && (is_number(before) || matches!(before, b'+' | b'-'));
        self.wrong = self.wrong.or(self.mark).or(self.blank.filter(|_| is_amid));
        (self.blank, self.mark) = (None, None);
    }
}

impl<'a> Blocks<'a> {
    /// Starts before the first block.
    pub(super) fn new(bytes: &'a [u8]) -> Self {
        // The leader of a paper tape is NULs.
        let leader = bytes.iter().position(|&byte| byte != 0).unwrap_or(0);
        let mut at = if bytes[leader..].starts_with(BYTE_ORDER_MARK) { leader + BYTE_ORDER_MARK.len() } else { 0 };
        let mut frame = None;
        let line = |start: usize, end: usize| Some(Span { start: start as u32, end: end as u32, block: 0 });
        let is_break = |byte: &u8| matches!(byte, b'\r' | b'\n');
        if let Some(first) = bytes[at..].iter().position(|&byte| !is_blank(byte)).map(|blanks| at + blanks)
            && bytes[first] == b'%'
            && bytes.get(first + 1).is_some_and(is_break)
        {
            frame = line(first, first + 1);
            at = first + 1;
        }
        let end = bytes.iter().rposition(|&byte| !is_blank(byte)).unwrap_or(0);
        let bytes = if end > at && bytes[end] == b'%' && is_break(&bytes[end - 1]) {
            frame = frame.or(line(end, end + 1));
            &bytes[..end]
        } else {
            bytes
        };
        let (passed, text, origins) = (Passed::default(), Vec::new(), Vec::new());
        Self { bytes, at, number: 0, ended: true, frame, passed, text, origins }
    }

    /// A line at the start or the end of the file that contains only `%`, written for other machines.
    pub(super) fn frame(&self) -> Option<Span> {
        self.frame
    }

    /// The bytes of a serial line and the deleted passages so far.
    pub(super) fn passed(&self) -> &Passed {
        &self.passed
    }

    /// Offset of the next byte to read.
    pub(super) fn offset(&self) -> usize {
        self.at
    }

    /// True if every block so far had its asterisk.
    pub(super) fn all_ended(&self) -> bool {
        self.ended
    }

    /// The last block if it lacks its asterisk.
    pub(super) fn torn(&self, last: Span) -> Option<Span> {
        (!self.ended).then_some(last)
    }

    /// The next block; `None` at the end of the file.
    pub(super) fn next(&mut self) -> Option<Block> {
        if let Some((code, span)) = self.next_code() {
            let words = Words { codes: std::iter::once(code).collect(), ahead: 1, point: None };
            return Some(Block { span, words: Ok(words) });
        }
        let rest = self.bytes.get(self.at..).filter(|rest| !rest.is_empty())?;
        // Nearly every block has no blanks inside and is parsed in place.
        let plain = syntax::plain_point_and_code(rest);
        if let Some((after, words)) = plain.or_else(|| syntax::block(rest).ok()) {
            return Some(Block { span: self.step_to(after), words: Ok(words) });
        }
        self.next_with_blanks()
    }

    /// The next block if it is a single code; any other block is not consumed. Same result as [`Self::next`], without
    /// allocation for other codes.
    pub(super) fn next_code(&mut self) -> Option<(Code, Span)> {
        self.skip_blanks();
        let (after, code) = syntax::plain_code(self.bytes.get(self.at..)?)?;
        Some((code, self.step_to(after)))
    }

    /// Fills a run with the following blocks of X and Y only, which most of a file consists of; false if the next block is
    /// another. Much faster than [`Self::next_point`], which reads the last blocks of a file.
    #[inline(never)] // as a separate function, it keeps its variables in registers
    pub(super) fn next_run(&mut self, run: &mut Run) -> bool {
        let Self { bytes, mut at, number, .. } = *self;
        let count = run.fill(|place| {
            loop {
                let rest = bytes.get(at..)?;
                if let Some((length, x, y)) = rest.first_chunk().and_then(syntax::plain_block) {
                    let start = at;
                    at += length;
                    let block = number + 1 + place as u32;
                    return Some(([x, y], Span { start: start as u32, end: at as u32 - 1, block }));
                }
                let blanks = rest.iter().take_while(|&&byte| is_blank(byte)).count();
                if blanks == 0 {
                    return None;
                }
                at += blanks;
            }
        });
        (self.at, self.number) = (at, number + count as u32);
        count > 0
    }

    /// The next block if it is a point only; any other block is not consumed. Same result as [`Self::next`], without allocation
    /// for codes and faults.
    pub(super) fn next_point(&mut self) -> Option<(Point, Span)> {
        self.skip_blanks();
        let rest = self.bytes.get(self.at..)?;
        if rest.first().is_some_and(|&letter| syntax::is_code_letter(letter)) {
            return None;
        }
        if let Some((length, x, y)) = rest.first_chunk().and_then(syntax::signed_block) {
            return Some((Point::whole(x, y), self.step_to(&rest[length..])));
        }
        let (after, point) = syntax::point(rest).ok()?;
        let (b'*', after) = after.split_first()? else { return None };
        Some((point, self.step_to(after)))
    }

    /// The span of the next block, which ends before `after`. Advances to `after`.
    fn step_to(&mut self, after: &[u8]) -> Span {
        let end = self.bytes.len() - after.len();
        self.number += 1;
        let span = Span { start: self.at as u32, end: end as u32 - 1, block: self.number };
        self.at = end;
        span
    }

    /// The next block as text; `None` at the end of the file.
    pub(super) fn next_text(&mut self) -> Option<Span> {
        self.skip_blanks();
        let rest = self.bytes.get(self.at..).filter(|rest| !rest.is_empty())?;
        let length = memchr::memchr(b'*', rest);
        self.ended = length.is_some();
        let length = length.unwrap_or(rest.len());
        self.number += 1;
        let text = rest[..length].trim_ascii_end();
        let span = Span { start: self.at as u32, end: (self.at + text.len()) as u32, block: self.number };
        self.at += length + 1;
        Some(span)
    }

    fn skip_blanks(&mut self) {
        while self.bytes.get(self.at).copied().is_some_and(is_blank) {
            self.at += 1;
        }
    }

    /// The next block, read from a copy without blanks and deleted passages.
    fn next_with_blanks(&mut self) -> Option<Block> {
        let (mut text, mut origins) = (std::mem::take(&mut self.text), std::mem::take(&mut self.origins));
        text.clear();
        origins.clear();
        let mut end = self.bytes.len();
        let (mut asterisks, mut unclosed, mut gaps) = (0, None, Gaps::default());
        let mut at = self.at;
        while let Some(&byte) = self.bytes.get(at) {
            match byte {
                b'*' => {
                    text.last().into_iter().for_each(|&last| gaps.close(last, byte));
                    end = at;
                    break;
                }
                b'/' => match memchr::memchr(b'/', &self.bytes[at + 1..]) {
                    Some(length) => {
                        let span = Span { start: at as u32, end: (at + length + 2) as u32, block: self.number + 1 };
                        asterisks += self.passed.delete(&self.bytes[at + 1..at + 1 + length], span);
                        at += length + 1;
                    }
                    None => unclosed = Some(at),
                },
                _ if is_of_line(byte) && text.is_empty() => self.passed.see_line(byte, at, self.number + 1),
                _ if is_blank(byte) => text.last().into_iter().for_each(|_| gaps.see(byte, at)),
                _ => {
                    text.last().into_iter().for_each(|&last| gaps.close(last, byte));
                    text.push(byte);
                    origins.push(at);
                }
            }
            at += 1;
        }
        self.ended = end < self.bytes.len();
        if !self.ended && text.is_empty() && unclosed.is_none() {
            self.ended = true; // blanks at the end of the file are not a block
            self.at = end;
            return None;
        }
        self.number += 1;
        let block = self.number;
        self.number += asterisks;
        self.at = end + 1;
        let span = Span { start: origins.first().map_or(end, |&at| at) as u32, end: end as u32, block };
        text.push(b'*');
        origins.push(end);
        let words = match (unclosed, gaps.wrong, syntax::block(&text)) {
            (Some(at), _, _) => Err(self
                .fault_at(at, block, "the passage that `/` deletes has no end")
                .hint("put a second `/` behind what is to be left out, or take this one away")),
            (None, Some(at), Ok(_)) => Err(self.gap_at(at, block)),
            (None, None, Ok((_, words))) => Ok(words),
            (None, _, Err(Err::Error(fault) | Err::Failure(fault))) => {
                let at = origins[text.len() - fault.at.len()];
                Err(self.diagnose(&fault, at, block))
            }
            (None, _, Err(Err::Incomplete(_))) => Err(self.fault_at(end, block, "the block is cut short")),
        };
        (self.text, self.origins) = (text, origins);
        Some(Block { span, words })
    }

    fn fault_at(&self, at: usize, block: u32, message: impl Into<String>) -> Diagnostic {
        let end = (at + 1).min(self.bytes.len());
        Diagnostic::new(&code::ISO_SYNTAX, message).at(Span { start: at as u32, end: end as u32, block })
    }

    fn gap_at(&self, at: usize, block: u32) -> Diagnostic {
        let message = match self.bytes[at] {
            b' ' => "a blank stands inside a number".to_owned(),
            b'\t' => "a tab stands inside a number".to_owned(),
            byte => format!("byte 0x{byte:02x} stands inside a block"),
        };
        self.fault_at(at, block, message).hint("a digit may be lost here, and the file damaged; export it again")
    }

    fn diagnose(&self, fault: &Fault<'_>, at: usize, block: u32) -> Diagnostic {
        let letter = char::from(self.bytes[at.min(self.bytes.len() - 1)]);
        let span = Span { start: at as u32, end: at as u32 + 1, block };
        match fault.kind {
            FaultKind::Expected(what) => {
                let byte = self.bytes.get(at).copied();
                let found = match byte {
                    None => "the end of the file".to_owned(),
                    Some(byte @ b'!'..=b'~') => format!("`{}`", char::from(byte)),
                    Some(byte) => format!("byte 0x{byte:02x}"),
                };
                self.fault_at(at, block, format!("{what} was expected here, but {found} was found")).hint(remedy(byte))
            }
            FaultKind::NoValue => Diagnostic::new(&code::ISO_NO_VALUE, format!("{letter} stands without its number"))
                .at(span)
                .hint("the file may be damaged here; export it again"),
            FaultKind::Overflow => {
                let digits = self.bytes[at..].iter().take_while(|b| b.is_ascii_digit() || b"+-.".contains(b)).count();
                let message = format!("the number is beyond {:.0} units of the file", syntax::VALUE_MAX);
                Diagnostic::new(&code::ISO_OVERFLOW, message)
                    .at(Span { end: (at + digits) as u32, ..span })
                    .hint("a block end `*` may be missing, or digits were doubled")
            }
        }
    }
}

/// Remedy for a byte that violates the grammar; `None` stands for the end of the file.
fn remedy(byte: Option<u8>) -> &'static str {
    match byte {
        None => "the file is most likely cut short; export it again",
        Some(b'A'..=b'Z') => "a block end `*` may be missing before it, or a sign before it is spoilt",
        Some(b'e') => "if it is an exponent, write 1000 and not 1e3; codes are capital letters",
        Some(b'a'..=b'z') => "codes are capital letters; a text stands behind M31 or M20 in a block of its own",
        Some(b'0'..=b'9' | b'+' | b'-' | b'.') => "a letter may be missing before this number, or a digit was doubled",
        Some(b',') => "decimals stand behind a point, if a number has any: export the file so",
        Some(b'!'..=b'~') => "export it again: a digit may be spoilt; only texts behind M31 and M20 have such signs",
        Some(_) => "the file may be damaged, or a text stands where M31 or M20 is missing; export it again",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_of_per_cent_signs_around_the_file_are_no_blocks() {
        assert_eq!(points("%\r\nX1*X2*\n%\n"), [(1, Some(1.0), None), (2, Some(2.0), None)]);
        assert_eq!(Blocks::new(b"%\nX1*").frame().map(|span| span.start), Some(0));
        assert_eq!(Blocks::new(b"X1*\n%").frame().map(|span| span.start), Some(4));
        assert!(Blocks::new(b"X1*").frame().is_none());
        assert!(Blocks::new(b"%X1*").next().is_some_and(|block| block.words.is_err()));
    }

    fn points(text: &str) -> Vec<(u32, Option<f64>, Option<f64>)> {
        let mut blocks = Blocks::new(text.as_bytes());
        let mut found = Vec::new();
        while let Some(block) = blocks.next() {
            let point = block.words.expect("a sound block").point.unwrap_or_default();
            found.push((block.span.block, point.x, point.y));
        }
        found
    }

    #[test]
    fn line_breaks_may_stand_inside_numbers() {
        assert_eq!(points("\u{feff}X10\r\n5Y 20*\n\0 X1*\x1a\n"), [(1, Some(105.0), Some(20.0)), (2, Some(1.0), None)]);
    }

    #[test]
    fn blanks_that_may_be_lost_digits_are_told() {
        let faults = |text: &str| {
            let mut blocks = Blocks::new(text.as_bytes());
            let mut found = Vec::new();
            while let Some(block) = blocks.next() {
                found.extend(block.words.err().and_then(|fault| fault.span).map(|span| span.start));
            }
            found
        };
        for sound in ["X1 Y2*", " X 1\tY -2 *", "X1\r\n0*", "X1*\0\0X2*\0", "\0X1*\x1a", "X1/2 3\0/Y2*"] {
            assert!(faults(sound).is_empty(), "{sound:?}");
        }
        for damaged in
            ["X1 0*", "X1\t0*", "X1\x000*", "X1 .5*", "X1. 5*", "X1\n 0*", "X- 10*", "X1\0Y2*", "M1 4*", "X1\r\n\x000*"]
        {
            assert_eq!(faults(damaged).len(), 1, "{damaged:?}");
        }
        assert_eq!(faults("X1*X1\0*"), [5]);
        assert_eq!(faults("X\x1a1*"), [1]);
    }

    #[test]
    fn a_deleted_passage_is_skipped_but_its_blocks_count() {
        assert_eq!(points("X1*/X2*X3*/X4*X5*"), [(1, Some(1.0), None), (2, Some(4.0), None), (5, Some(5.0), None)]);
    }

    #[test]
    fn text_is_kept_verbatim() {
        let bytes = b"M31*\r\nA/B 1\xff\r\n*X1*";
        let mut blocks = Blocks::new(bytes);
        blocks.next();
        let span = blocks.next_text().expect("text");
        assert_eq!(&bytes[span.start as usize..span.end as usize], b"A/B 1\xff");
        assert_eq!(span.block, 2);
        assert_eq!(blocks.next().map(|b| b.span.block), Some(3));
    }
}
