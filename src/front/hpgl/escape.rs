//! Escape sequences of plotters and printers, and the job language around a plot. All are skipped except resets.

use nom::bytes::complete::{take, take_while, take_while1};
use nom::character::complete::{char, one_of, satisfy};
use nom::combinator::{opt, recognize, value};
use nom::sequence::{preceded, terminated};
use nom::{AsChar, IResult, Parser, branch::alt};

/// Effect of a sequence.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Escape {
    /// Resets the plotter to its power-on state.
    Reset,
    /// No effect on lines.
    Other,
}

type Out<'a> = IResult<&'a [u8], Escape>;

/// `<escape>`: a sequence that begins with the escape character.
pub(super) fn escape(i: &[u8]) -> Out<'_> {
    preceded(char('\u{1b}'), alt((value(Escape::Reset, char('E')), device, encapsulated, language, parametrised, two)))
        .parse(i)
}

/// `<device>`: `.` and a letter, for interfaces; optional numbers end in a colon.
fn device(i: &[u8]) -> Out<'_> {
    let numbers = terminated(take_while(|byte: u8| byte.is_ascii_digit() || byte == b';' || byte == b','), char(':'));
    value(Escape::Other, (char('.'), satisfy(|c| c.is_ascii_graphic()), opt(numbers))).parse(i)
}

/// `<encapsulated>`: `;@:`, and lines with settings of Summa cutters up to one that is `END`, with or without a full stop.
fn encapsulated(i: &[u8]) -> Out<'_> {
    let (mut rest, _) = nom::bytes::complete::tag(&b";@:"[..]).parse(i)?;
    loop {
        let (behind, line) = take_while(|byte| byte != b'\r' && byte != b'\n').parse(rest)?;
        if matches!(line.trim_ascii(), b"END" | b"END.") {
            return Ok((behind, Escape::Other));
        }
        (rest, _) = take_while1(|byte| byte == b'\r' || byte == b'\n').parse(behind)?;
    }
}

/// `<language>`: `%`, a number and a letter: enter HP-GL/2 (B), leave it (A), exit the language (X).
fn language(i: &[u8]) -> Out<'_> {
    value(Escape::Other, (char('%'), opt(one_of("+-")), take_while1(AsChar::is_dec_digit), satisfy(AsChar::is_alpha)))
        .parse(i)
}

/// `<parametrised>`: a mark, a group, then numbers that end in letters, the last one in upper case. Binary data may follow;
/// they are outside the grammar.
fn parametrised(i: &[u8]) -> Out<'_> {
    let body = take_while(|byte: u8| byte.is_ascii_digit() || byte.is_ascii_lowercase() || b"+-.".contains(&byte));
    let mut rule = (one_of("!\"#$&'()*+,/"), body, satisfy(|c| c.is_ascii_uppercase() || c == '@'));
    let (rest, (mark, body, last)) = rule.parse(i)?;
    let length = if has_data(mark, body, last) { count(body) } else { 0 };
    value(Escape::Other, take(length)).parse(rest)
}

/// True if data follow a sequence: those of W (raster rows, fonts, patterns, colours), planes of raster rows, and transparent
/// texts, which are printed unparsed (Hewlett-Packard, "PCL 5 Printer Language Technical Reference Manual").
fn has_data(mark: char, body: &[u8], last: char) -> bool {
    match last {
        'W' => true,
        'V' => mark == '*' && body.starts_with(b"b"),
        'X' => mark == '&' && body.starts_with(b"p"),
        _ => false,
    }
}

/// The number before the last letter of a sequence: the length of the data after it, bytes.
fn count(body: &[u8]) -> usize {
    let start = body.iter().rposition(u8::is_ascii_lowercase).map_or(0, |letter| letter + 1);
    let digits = std::str::from_utf8(&body[start..]).unwrap_or_default();
    if digits.is_empty() || !digits.bytes().all(|byte| byte.is_ascii_digit()) {
        return 0;
    }
    // A count beyond `usize` exceeds the size of any file.
    digits.parse().unwrap_or(usize::MAX)
}

/// `<two>`: a single letter or digit, or `=`.
fn two(i: &[u8]) -> Out<'_> {
    value(Escape::Other, recognize(satisfy(|c| c.is_ascii_alphanumeric() || c == '='))).parse(i)
}

/// `<job>`: a line of the job language.
pub(super) fn job(i: &[u8]) -> Out<'_> {
    let (i, _) = nom::bytes::complete::tag(&b"@PJL"[..]).parse(i)?;
    value(Escape::Other, take_while(|byte| byte != b'\n')).parse(i)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sequence_ends_where_its_kind_says() {
        let check = |text: &'static [u8], left: &str| {
            let (rest, _) = escape(text).expect("a sequence");
            assert_eq!(String::from_utf8_lossy(rest), left, "{text:?}");
        };
        check(b"\x1bEIN;", "IN;");
        check(b"\x1b%0BIN;", "IN;");
        check(b"\x1b%-1BIN;", "IN;");
        check(b"\x1b%-12345X@PJL", "@PJL");
        check(b"\x1b.(IN;", "IN;");
        check(b"\x1b.@;0:IN;", "IN;");
        check(b"\x1b.I81;;17:IN;", "IN;");
        check(b"\x1b&l1x0OIN;", "IN;");
        check(b"\x1b9IN;", "IN;");
        check(b"\x1b;@:\r\nSET OVERCUT=1.\r\nLOAD_MARKERS.\r\nEND.\r\nIN;", "\r\nIN;");
        check(b"\x1b;@:\nUNLOAD_MARKERS\nEND", "");
        check(b"\x1b*b5WPU1,2IN;", "IN;");
        check(b"\x1b*b2m3WPU;IN;", "IN;");
        check(b"\x1b*b3VPU;\x1b(s2WPU", "\x1b(s2WPU");
        check(b"\x1b(s2WPUIN;", "IN;");
        check(b"\x1b&p3XPU;IN;", "IN;");
        check(b"\x1b*b0WIN;", "IN;");
        check(b"\x1b*t300RIN;", "IN;");
        assert_eq!(escape(b"\x1bE").map(|found| found.1), Ok(Escape::Reset));
        // A count beyond the end of the file counts no data.
        assert!(escape(b"\x1b*b6WPU1,2").is_err());
        assert!(escape(b"\x1b;@:\nSET VELOCITY=400\nIN;PU;").is_err());
        assert!(escape(b"\x1b").is_err() && escape(b"\x1b%").is_err());
        assert_eq!(job(b"@PJL ENTER LANGUAGE=HPGL2\r\nIN").map(|found| found.0), Ok(&b"\nIN"[..]));
    }
}
