//! Texts: labels up to the terminator defined by DT, and quoted texts.

/// Default terminator of labels: ETX.
const ETX: u8 = 3;
/// Maximum length of a label, bytes. A longer one has lost its terminator and would hide drawing instructions.
const LONGEST: usize = 1024;
/// Minimum number of pen-down points of an outline. A text that contains a move and that many points has lost its terminator.
const OUTLINE: usize = 3;

/// The current label terminator.
#[derive(Debug)]
pub(super) struct Terminator {
    byte: u8,
}

/// A text and the position after it.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct Text {
    /// Offset after its last byte.
    pub(super) end: usize,
    /// Offset after its terminator.
    pub(super) next: usize,
    /// True if the terminator is missing.
    pub(super) is_open: bool,
}

impl Terminator {
    /// The power-on terminator.
    pub(super) fn new() -> Self {
        Self { byte: ETX }
    }

    /// DT: the next byte of any value, except a semicolon, becomes the terminator. Returns the offset after it.
    pub(super) fn define(&mut self, bytes: &[u8], at: usize) -> usize {
        let given = bytes.get(at).copied().filter(|&byte| byte != b';');
        self.byte = given.unwrap_or(ETX);
        at + usize::from(given.is_some())
    }

    /// The text that starts at `at`. Without a terminator it ends at its line end or at a semicolon. A terminator after an
    /// outline belongs to a later text.
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

/// True if a text contains instructions that draw an outline.
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

/// Offset after the quoted text of CO or MG. A text without both quotes ends at its line end, at a semicolon, or at ETX, which
/// ends texts on plotters whatever DT defines.
pub(super) fn quoted(bytes: &[u8], at: usize) -> usize {
    in_quotes(bytes, at).unwrap_or_else(|| {
        let rest = &bytes[at..];
        at + rest.iter().position(|byte| b";\r\n\x03".contains(byte)).unwrap_or(rest.len())
    })
}

/// Offset after a text in quotes, in which a doubled quote stands for one. `None` if a quote is missing, or if an outline
/// between the quotes shows that one was lost.
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
