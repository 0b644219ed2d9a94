//! Texts: those of labels, up to the terminator that DT gives, and those in quotes.

/// The terminator of a label unless DT gives another: ETX.
const ETX: u8 = 3;
/// Longest text that a label has, bytes: a longer one has lost its terminator and would swallow what is drawn.
const LONGEST: usize = 1024;
/// Fewest pen-down places of an outline: a text that holds a move and as many places has lost its terminator.
const OUTLINE: usize = 3;

/// The terminator in force.
#[derive(Debug)]
pub(super) struct Terminator {
    byte: u8,
}

/// A text, and where the file goes on.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct Text {
    /// One past its last byte.
    pub(super) end: usize,
    /// The next byte behind its terminator.
    pub(super) next: usize,
    /// Whether its terminator is missing.
    pub(super) is_open: bool,
}

impl Terminator {
    /// As switched on.
    pub(super) fn new() -> Self {
        Self { byte: ETX }
    }

    /// DT: the byte behind it, whatever it is, but a semicolon; where the file goes on.
    pub(super) fn define(&mut self, bytes: &[u8], at: usize) -> usize {
        let given = bytes.get(at).copied().filter(|&byte| byte != b';');
        self.byte = given.unwrap_or(ETX);
        at + usize::from(given.is_some())
    }

    /// The text that starts at `at`. One whose terminator is missing ends with its line or at a semicolon; the terminator
    /// behind an outline is that of a later text.
    pub(super) fn text(&self, bytes: &[u8], at: usize) -> Text {
        let window = &bytes[at..bytes.len().min(at + LONGEST)];
        if let Some(length) = memchr::memchr(self.byte, window)
            && !holds_outline(&window[..length])
        {
            return Text { end: at + length, next: at + length + 1, is_open: false };
        }
        let length = window.iter().position(|byte| b";\r\n".contains(byte)).unwrap_or(window.len());
        Text { end: at + length, next: at + length, is_open: true }
    }
}

/// Whether a text holds instructions that draw an outline.
fn holds_outline(text: &[u8]) -> bool {
    let (mut is_placed, mut down) = (false, 0);
    for instruction in text.split(|byte| b";\r\n".contains(byte)) {
        let Some((mnemonic, numbers)) = instruction.split_at_checked(2) else { continue };
        let is_of_number = |byte: &u8| byte.is_ascii_digit() || *byte == b'.';
        let places = numbers.split(|byte| !is_of_number(byte)).filter(|run| !run.is_empty()).count() / 2;
        match mnemonic {
            b"PU" => is_placed |= places > 0,
            b"PD" if is_placed => down += places,
            _ => {}
        }
    }
    down >= OUTLINE
}

/// Where the file goes on behind the quoted text of CO or MG. One without its second quote, or without any, ends with its
/// line, at a semicolon, or at ETX, which ends texts of plotters whatever DT says.
pub(super) fn quoted(bytes: &[u8], at: usize) -> usize {
    in_quotes(bytes, at).unwrap_or_else(|| {
        let rest = &bytes[at..];
        at + rest.iter().position(|byte| b";\r\n\x03".contains(byte)).unwrap_or(rest.len())
    })
}

/// Where the file goes on behind a text in quotes: a quote within it stands twice. `None` without both of its quotes, and
/// where an outline stands between them: then one is lost.
pub(super) fn in_quotes(bytes: &[u8], at: usize) -> Option<usize> {
    let at = at + bytes[at..].iter().take_while(|byte| **byte == b' ').count();
    if bytes.get(at) != Some(&b'"') {
        return None;
    }
    let end = bytes.len().min(at + 1 + LONGEST);
    let mut next = at + 1;
    while let Some(length) = memchr::memchr(b'"', &bytes[next.min(end)..end]) {
        next += length + 1;
        if bytes.get(next) != Some(&b'"') {
            return Some(next).filter(|_| !holds_outline(&bytes[at + 1..next - 1]));
        }
        next += 1;
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_label_ends_at_its_terminator_and_at_nothing_else() {
        let mut terminator = Terminator::new();
        let bytes = b"LBA;PU1,2\x03PU";
        assert_eq!(terminator.text(bytes, 2), Text { end: 9, next: 10, is_open: false });
        let bytes = b"DT#,1;LBA\x03B#PU";
        assert_eq!(terminator.define(bytes, 2), 3);
        assert_eq!(terminator.text(bytes, 8), Text { end: 11, next: 12, is_open: false });
        assert_eq!(terminator.define(b"DT;", 2), 2);
        assert_eq!(terminator.byte, ETX);
    }

    #[test]
    fn a_label_without_terminator_ends_with_its_line() {
        let terminator = Terminator::new();
        assert_eq!(terminator.text(b"LBSIZE M\nPU", 2), Text { end: 8, next: 8, is_open: true });
        let far = [b"LBA;PU;".as_slice(), &[b' '; 2 * LONGEST], b"\x03"].concat();
        assert_eq!(Terminator::new().text(&far, 2), Text { end: 3, next: 3, is_open: true });
    }

    #[test]
    fn a_label_that_would_swallow_an_outline_ends_with_its_line() {
        let terminator = Terminator::new();
        let swallowed = b"LBBACK;PU1,1;PD9,1,9,9;PD1,9,1,1;PU;LBFRONT\x03";
        assert_eq!(terminator.text(swallowed, 2), Text { end: 6, next: 6, is_open: true });
        let words = b"LBPU1,1;PD9,1;SC0,9,0,9;PD\x03";
        assert!(!terminator.text(words, 2).is_open);
    }

    #[test]
    fn a_quoted_text_ends_at_its_quote() {
        assert_eq!(quoted(b"CO\"a;b\";PU", 2), 7);
        assert_eq!(quoted(b"MG\"a\"\";b\";PU", 2), 9);
        assert_eq!(quoted(b"CO\"\";PU", 2), 4);
        assert_eq!(quoted(b"CO\"a;PU", 2), 4);
        assert_eq!(quoted(b"CO;PU", 2), 2);
        assert_eq!(quoted(b"MGa\x03PD1,2;", 2), 3);
    }
}
