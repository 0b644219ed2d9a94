//! MTEXT: lines of texts with formatting codes in backslashes and braces.

use std::ops::Range;

/// Codes with an argument up to a semicolon: alignment, colour, font, height, spacing, slant, tab stops, width.
const WITH_ARGUMENT: &[u8] = b"ACcFfHQpTW";
/// Codes that toggle overline, strike-through and underline.
const SWITCHES: &[u8] = b"LlOoKk";

/// Prefixes of codes for a letter by its number.
const LETTERS: [&[u8]; 2] = [b"\\U+", b"\\M+"];

/// True if codes or braces remain in a part of a text, apart from letter codes: its letters are then unknown.
pub(super) fn has_codes(text: &[u8]) -> bool {
    let is_letter = |at: usize| LETTERS.iter().any(|code| text[at..].starts_with(code));
    text.iter().enumerate().any(|(at, byte)| b"{}\\".contains(byte) && !is_letter(at))
}

/// Ranges of the lines of a text, without leading codes and trailing braces. A line ends at `\P`.
pub(super) fn lines(text: &[u8]) -> impl Iterator<Item = Range<usize>> {
    let ends: Vec<usize> = memchr::memmem::find_iter(text, b"\\P").chain([text.len()]).collect();
    let starts: Vec<usize> = [0].into_iter().chain(ends.iter().map(|end| end + 2)).collect();
    starts.into_iter().zip(ends).map(|(start, end)| {
        let line = &text[start..end];
        let is_letter = |byte: &u8| *byte != b'}' && !byte.is_ascii_whitespace();
        let length = line.iter().rposition(is_letter).map_or(0, |last| last + 1);
        start + codes_before(&line[..length])..start + length
    })
}

/// Number of leading bytes of a line, or of a part of it, that are blanks or codes.
pub(super) fn codes_before(line: &[u8]) -> usize {
    let mut at = 0;
    loop {
        at += match line[at..] {
            [b'{', ..] => 1,
            [byte, ..] if byte.is_ascii_whitespace() => 1,
            [b'\\', code, ..] if SWITCHES.contains(&code) => 2,
            [b'\\', code, ref rest @ ..] if WITH_ARGUMENT.contains(&code) => match memchr::memchr(b';', rest) {
                Some(end) => 3 + end,
                None => return at,
            },
            _ => return at,
        };
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_text_is_read_without_the_looks_of_its_letters() {
        let check = |text: &str, expected: &[&str]| {
            let found: Vec<&str> = lines(text.as_bytes()).map(|range| &text[range]).collect();
            assert_eq!(found, expected, "{text}");
        };
        check("UNITS: METRIC", &["UNITS: METRIC"]);
        check(r"\A1;UNITS: METRIC", &["UNITS: METRIC"]);
        check(r"{\fArial|b0|i0;\H2.5x;SIZE: M}\PQUANTITY: 1,1", &["SIZE: M", "QUANTITY: 1,1"]);
        check(r"{\LPIECE NAME: A\l}", &[r"PIECE NAME: A\l"]);
        check(r"\fno end", &[r"\fno end"]);
        check(r"\P{}", &["", ""]);
    }
}
