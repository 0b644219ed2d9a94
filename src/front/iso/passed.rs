//! Bytes that are passed over between blocks: deleted passages, and control bytes of a serial line.

use super::meaning::{Meaning, meaning};
use super::syntax;
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::source::Span;

/// Bytes and passages that were passed over so far.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Passed {
    /// Deleted passages that hold the end of a block or a knife-down: their number, their blocks, and the first of them.
    passages: usize,
    blocks: u32,
    first: Option<Span>,
    /// True if the knife goes down in one.
    cuts: bool,
    /// The first byte of a serial line, and their number.
    line: Option<(u8, Span)>,
    bytes: usize,
}

impl Passed {
    /// Records a passage between two slashes, and returns the number of block ends in it.
    pub(super) fn delete(&mut self, passage: &[u8], span: Span) -> u32 {
        let ends = memchr::memchr_iter(b'*', passage).count() as u32;
        let is_down = |block: &[u8]| {
            let text = [block, b"*"].concat();
            syntax::block(&text).is_ok_and(|(_, words)| words.codes.iter().any(|&code| meaning(code) == Meaning::Down))
        };
        let cuts = passage.split(|&byte| byte == b'*').any(|block| is_down(block.trim_ascii()));
        if ends > 0 || cuts {
            self.passages += 1;
            self.blocks += ends;
            self.cuts |= cuts;
            self.first.get_or_insert(span);
        }
        ends
    }

    /// Records a byte of a serial line at an offset.
    pub(super) fn see_line(&mut self, byte: u8, at: usize, block: u32) {
        self.bytes += 1;
        self.line.get_or_insert((byte, Span { start: at as u32, end: at as u32 + 1, block }));
    }

    /// Reports both.
    pub(super) fn report(&self, out: &mut Diagnostics) {
        if let Some((byte, span)) = self.line {
            let times = if self.bytes == 1 { "once".to_owned() } else { format!("{} times", self.bytes) };
            let message = format!("control bytes of a serial line (0x{byte:02x}) are passed over: {times}");
            let finding = Diagnostic::new(&code::ISO_LINE_BYTES, message).at(span);
            out.push(finding.hint("the file was received over a cable: compare its size with the original"));
        }
        let Some(first) = self.first else { return };
        let ends = if self.blocks == 1 { "1 block end".to_owned() } else { format!("{} block ends", self.blocks) };
        let down = if self.cuts { " and a knife-down" } else { "" };
        let times = if self.passages == 1 { String::new() } else { format!(" in {} places", self.passages) };
        let message = format!("left out between two `/`{times}: {ends}{down}");
        let finding = Diagnostic::new(&code::ISO_DELETED, message).at(first);
        out.push(
            finding.hint("most machines skip one block behind a `/`: see in the picture (`-t svg`) what is missing"),
        );
    }
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::Diagnostics;
    use crate::machine::Job;
    use crate::source::Source;

    /// Checks the findings on an outline with bytes behind it.
    fn check(behind: &str, expected: &[&str]) {
        let file = format!("\0\0G71*N1*X0Y0*M14*X1000Y0*X1000Y1000*X0Y0*M15*{behind}M0*");
        let source = Source::new("a", file.clone().into_bytes()).expect("small");
        let mut out = Diagnostics::default();
        crate::front::iso::lower::lower(&source, &Job::default(), &mut out);
        let found: Vec<&str> = out.iter().map(|finding| finding.code.name).collect();
        assert_eq!(found, expected, "{file:?}");
    }

    #[test]
    fn blocks_that_are_left_out_are_told_and_words_are_not() {
        check("/X5Y5/X500Y0*M14*X500Y60*M15*", &[]);
        check("/N2*X5000Y0*M14*X6000Y0*M15*/*", &["iso/deleted-passage"]);
        check("/M14/*", &["iso/deleted-passage"]);
        check("/X1*/*", &["iso/deleted-passage"]);
    }

    #[test]
    fn bytes_of_a_serial_line_are_passed_over_between_blocks_alone() {
        check("\x13\x11X500Y0*M14*X500Y60*M15*", &["iso/line-bytes"]);
        check("X5\x1300Y0*", &["iso/syntax"]);
    }
}
