//! Words of G-code: in the spelling of the target `gcode` and in that of people. RS274/NGC treats both as the same program.

use super::number::{self, decimal, leading};
use crate::machine::MachineProfile;
use crate::machine::gcode::{Dialect, Step};
use crate::units::number::exact;

/// First words of comments that controllers execute.
const ACTIVE: &[&[u8]] = &[
    b"ABORT",
    b"DEBUG",
    b"LOG",
    b"LOGAPPEND",
    b"LOGCLOSE",
    b"LOGOPEN",
    b"MSG",
    b"PRINT",
    b"PROBECLOSE",
    b"PROBEOPEN",
    b"PY",
];

/// White space in C, and so to controllers, but not in Rust.
const VERTICAL_TAB: u8 = 0x0b;

/// True if a controller executes the comment with this text.
pub(in crate::verify) fn is_active(comment: &[u8]) -> bool {
    let blanks = comment.iter().take_while(|byte| byte.is_ascii_whitespace() || **byte == VERTICAL_TAB).count();
    let text = &comment[blanks..];
    let first = text.iter().take_while(|byte| byte.is_ascii_alphabetic()).count();
    ACTIVE.contains(&text[..first].to_ascii_uppercase().as_slice())
}

/// Part of a line as a message shows it.
pub(in crate::verify) fn quoted(part: &[u8]) -> String {
    if part.is_empty() { "blank".to_owned() } else { number::quoted(part) }
}

/// Line without its line number.
pub(in crate::verify) fn unnumbered(line: &[u8]) -> &[u8] {
    let Some(rest) = line.strip_prefix(b"N") else { return line };
    let digits = rest.iter().take_while(|byte| byte.is_ascii_digit()).count();
    rest[digits..].strip_prefix(b" ").unwrap_or(line)
}

/// Line in the spelling of the target: capital letters, one blank between words, without line number, comments and redundant
/// digits. Empty when the line commands nothing; `None` when it holds anything besides words and comments.
///
/// Rules of RS274/NGC, sections 3.3 and 3.4, as `LinuxCNC` implements them: outside comments, case and blanks are ignored, even
/// blanks inside a number; a comment stands in brackets, which do not nest, or behind a semicolon.
pub(in crate::verify) fn plain(line: &[u8]) -> Option<Vec<u8>> {
    let line = uncommented(line)?;
    let mut left = line.as_slice();
    // A line number must come first; behind a comment it is not one.
    if let Some(rest) = left.strip_prefix(b"N") {
        let digits = rest.iter().take_while(|byte| byte.is_ascii_digit()).count();
        left = &rest[digits..];
        if digits == 0 {
            return None;
        }
    }
    let mut plain = Vec::with_capacity(2 * line.len());
    while let Some((&letter, rest)) = left.split_first() {
        if letter == BETWEEN_WORDS {
            left = rest;
            continue;
        }
        let length = rest.iter().take_while(|byte| matches!(byte, b'0'..=b'9' | b'.' | b'-' | b'+')).count();
        let (number, behind) = rest.split_at(length);
        if !letter.is_ascii_uppercase() || letter == b'N' {
            return None;
        }
        if !plain.is_empty() {
            plain.push(b' ');
        }
        plain.push(letter);
        push_number(&mut plain, number)?;
        left = behind;
    }
    Some(plain)
}

/// Placeholder for a removed comment. It separates words: no word continues across it.
const BETWEEN_WORDS: u8 = b' ';

/// Line in capital letters without blanks and comments; `None` when a comment is executed or unterminated.
fn uncommented(line: &[u8]) -> Option<Vec<u8>> {
    let mut bare = Vec::with_capacity(line.len());
    let mut left = line;
    while let Some((&byte, rest)) = left.split_first() {
        left = match byte {
            b'(' => {
                let end = rest.iter().position(|&byte| byte == b')')?;
                let comment = &rest[..end];
                if comment.contains(&b'(') || is_active(comment) {
                    return None;
                }
                bare.push(BETWEEN_WORDS);
                &rest[end + 1..]
            }
            b';' if is_active(rest) => return None,
            b';' => &[],
            b' ' | b'\t' => rest,
            _ => {
                bare.push(byte.to_ascii_uppercase());
                rest
            }
        };
    }
    Some(bare)
}

/// Appends a number without a plus sign and redundant digits; `None` when the text is not a number.
fn push_number(out: &mut Vec<u8>, number: &[u8]) -> Option<()> {
    let digits = number.strip_prefix(b"-").or_else(|| number.strip_prefix(b"+")).unwrap_or(number);
    let point = digits.iter().position(|&byte| byte == b'.').unwrap_or(digits.len());
    let (whole, decimals) = digits.split_at(point);
    let decimals = decimals.strip_prefix(b".").unwrap_or(decimals);
    if whole.len() + decimals.len() == 0 || !whole.iter().chain(decimals).all(u8::is_ascii_digit) {
        return None;
    }
    if number[0] == b'-' {
        // For a wrapping axis a negative zero differs from zero.
        out.push(b'-');
    }
    let zeros = whole.iter().take_while(|&&digit| digit == b'0').count();
    out.extend_from_slice(if zeros == whole.len() { b"0" } else { &whole[zeros..] });
    let needed = decimals.iter().rposition(|&digit| digit != b'0').map_or(0, |last| last + 1);
    if needed > 0 {
        out.push(b'.');
        out.extend_from_slice(&decimals[..needed]);
    }
    Some(())
}

/// Line of the profile or of the target that a program must contain.
pub(in crate::verify) struct Expected {
    /// Line as it is written.
    pub(in crate::verify) text: String,
    /// Line in the spelling of the target; `None` when the line does not consist of words and must stand verbatim.
    plain: Option<Vec<u8>>,
}

impl Expected {
    /// Creates the line from its text.
    pub(in crate::verify) fn new(text: &str) -> Self {
        Self { text: text.to_owned(), plain: plain(text.as_bytes()).filter(|plain| !plain.is_empty()) }
    }

    /// Line of a step of the profile, with `blank` for a number that the step leaves open.
    pub(in crate::verify) fn of_step(step: &Step, blank: f64, dialect: Dialect) -> Self {
        let word = |letter: char, number: f64| format!(" {letter}{}", exact(number));
        let text = match step {
            Step::Output { pin, on } => format!("M{}{}", if *on { 64 } else { 65 }, word('P', pin.of(blank))),
            Step::Z { to_mm, feed_mm_min: None } => format!("G0{}", word('Z', *to_mm)),
            Step::Z { to_mm, feed_mm_min: Some(feed) } => format!("G1{}{}", word('Z', *to_mm), word('F', *feed)),
            Step::Dwell { time } => format!("G4{}", word(rest_letter(dialect), *time)),
            Step::Code { m, parameters } => {
                let words = parameters.iter().map(|parameter| word(parameter.letter, parameter.number.of(blank)));
                format!("M{m}{}", words.collect::<String>())
            }
        };
        Self::new(&text)
    }

    /// True if the line, as written or in the spelling of the target, is the expected one.
    pub(in crate::verify) fn is(&self, line: &[u8]) -> bool {
        self.text.as_bytes() == line || self.plain.as_deref() == Some(line)
    }
}

/// Letter of the time of a rest in seconds. P of `RepRapFirmware` is in ms.
fn rest_letter(dialect: Dialect) -> char {
    match dialect {
        Dialect::Rs274 => 'P',
        Dialect::Reprap => 'S',
    }
}

/// Number of a word in an unusual form, such as one with many digits; `None` when it is not a number.
fn unusual(word: &[u8]) -> Option<f64> {
    let (_, number) = word.split_first()?;
    let is_plain = number.iter().all(|byte| matches!(byte, b'0'..=b'9' | b'.' | b'-'));
    decimal(number).filter(|_| is_plain)
}

/// Error for a word that the target does not have.
fn foreign(word: &[u8]) -> String {
    format!("has {}, which is no word of the target gcode with this profile", quoted(word))
}

/// Words of a line.
#[derive(Debug, Default, PartialEq)]
pub(in crate::verify) struct Words {
    pub(in crate::verify) g: Option<f64>,
    pub(in crate::verify) x: Option<f64>,
    pub(in crate::verify) y: Option<f64>,
    pub(in crate::verify) c: Option<f64>,
    pub(in crate::verify) i: Option<f64>,
    pub(in crate::verify) j: Option<f64>,
    pub(in crate::verify) f: Option<f64>,
    /// Time of a rest, s.
    pub(in crate::verify) rest: Option<f64>,
}

impl Words {
    /// Words of a line in the spelling of the target; the error is the end of a message about the line.
    pub(in crate::verify) fn of(line: &[u8], profile: &MachineProfile) -> Result<Self, String> {
        let mut words = Self::default();
        let mut left = line;
        loop {
            let usual = left.get(1..).and_then(leading).map(|(number, length)| (number, length + 1));
            let is_whole = |(_, end): &(f64, usize)| left.get(*end).is_none_or(|&byte| byte == b' ');
            let (number, end) = if let Some(word) = usual.filter(is_whole) {
                word
            } else {
                let end = left.iter().position(|&byte| byte == b' ').unwrap_or(left.len());
                (unusual(&left[..end]).ok_or_else(|| foreign(&left[..end]))?, end)
            };
            let place = words.place(left[0], profile).ok_or_else(|| foreign(&left[..end]))?;
            if place.replace(number).is_some() {
                return Err(format!("has two words {}", char::from(left[0])));
            }
            match left.get(end + 1..) {
                Some(behind) => left = behind,
                None => return Ok(words),
            }
        }
    }

    /// Time of a rest, s; `None` when the line is not a rest or has other words.
    pub(in crate::verify) fn rest(&self) -> Option<f64> {
        let alone = Self { g: Some(4.0), rest: self.rest, ..Self::default() };
        self.rest.filter(|_| *self == alone)
    }

    /// Letter that a line of motion must not have; for example, P on an arc is a number of turns.
    pub(in crate::verify) fn foreign_to(&self, code: f64, dialect: Dialect) -> Option<char> {
        let is_arc = code > 1.0;
        let there = [
            ('I', self.i.is_some() && !is_arc),
            ('J', self.j.is_some() && !is_arc),
            ('F', self.f.is_some() && code == 0.0),
            (rest_letter(dialect), self.rest.is_some()),
        ];
        there.into_iter().find(|(_, is_foreign)| *is_foreign).map(|(letter, _)| letter)
    }

    /// Field of a letter; `None` when the target has no such letter.
    fn place(&mut self, letter: u8, profile: &MachineProfile) -> Option<&mut Option<f64>> {
        Some(match letter {
            b'G' => &mut self.g,
            b'X' => &mut self.x,
            b'Y' => &mut self.y,
            b'I' => &mut self.i,
            b'J' => &mut self.j,
            b'F' => &mut self.f,
            letter if char::from(letter) == rest_letter(profile.gcode.dialect) => &mut self.rest,
            letter if letter == profile.gcode.letter.byte() => &mut self.c,
            _ => return None,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_that_say_the_same_are_spelled_alike() {
        let check = |line: &str, expected: Option<&str>| {
            let plain = plain(line.as_bytes()).map(|plain| String::from_utf8(plain).expect("ASCII"));
            assert_eq!(plain.as_deref(), expected, "{line}");
        };
        check("G1 X1.5 Y-2 C0 F600", Some("G1 X1.5 Y-2 C0 F600"));
        check("n10g01x+01.50y-2.0\tc.0f 6 0 0. (slower) ; here", Some("G1 X1.5 Y-2 C0 F600"));
        check("G91.10 M064 P-0 X-.50", Some("G91.1 M64 P-0 X-0.5"));
        check("X1e3", Some("X1 E3"));
        check("n5 (b) g1 (c)X1(d)Y2(e)", Some("G1 X1 Y2"));
        for nothing in ["", " \t", "N7", "(a)(b)", "; (MSG, no comment)", "n1 (a ; b)"] {
            check(nothing, Some(""));
        }
        let foreign = [
            "/G1 X1",
            "%",
            "G1 X#1",
            "G1 X[1+1]",
            "O100 SUB",
            "G1 X",
            "X1.2.3",
            "X--1",
            "X.",
            "N G1",
            "N1 N2",
            "G1 N2",
        ];
        let amid = ["M(a)65 P0", "X16(;)9.2812", "G4 P0.0(a)60", "X (c) 367", "N(a)5 G1", "(a)N5 G1"];
        let comments = [
            "G1 (a",
            "G1 (a (b)",
            "G1 a)",
            "G1 X1 ( MSG, hello)",
            "(abort, x)",
            "G1 X1 (\x0bMSG, x)",
            ";py, x",
            "(debug,) (b)",
        ];
        for line in foreign.into_iter().chain(comments).chain(amid) {
            check(line, None);
        }
    }
}
