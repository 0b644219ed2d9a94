//! Words of a line of G-code: letters with plain numbers.
//!
//! Follows RS274/NGC, sections 3.3 and 3.4, as in `LinuxCNC`, without anything that computes: no variables, expressions or
//! subroutines. Blanks are allowed between words only.

use std::fmt;

use crate::units::number::exact;

/// Greatest length of a number, characters: further digits carry no information.
const NUMBER_CHARS: usize = 16;
/// Placeholder of a number that is not known yet: that of a drill, or the advance of the cloth.
const BLANK: &str = "#";

/// Flaw of a line or a step.
#[derive(Debug, PartialEq)]
pub(in crate::machine) struct Flaw {
    /// Flawed content, continuing "the key has".
    pub(in crate::machine) has: String,
    /// Suggested replacement.
    pub(in crate::machine) hint: String,
}

impl Flaw {
    pub(super) fn new(has: impl Into<String>, hint: impl Into<String>) -> Self {
        Self { has: has.into(), hint: hint.into() }
    }
}

/// Number of a word.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Number {
    /// Given number.
    Plain(f64),
    /// Number of the current drill, or the advance of the cloth in mm; written `#`.
    Blank,
}

impl Number {
    /// Number, with `blank` in place of `#`.
    pub fn of(self, blank: f64) -> f64 {
        match self {
            Self::Plain(number) => number,
            Self::Blank => blank,
        }
    }
}

impl fmt::Display for Number {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Plain(number) => out.write_str(&exact(*number)),
            Self::Blank => out.write_str(BLANK),
        }
    }
}

/// Letter with its number, printed as in G-code.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Word {
    /// Upper-case letter.
    pub(super) letter: char,
    pub(super) number: Number,
}

impl Word {
    /// True if it is this G or M code.
    pub(super) fn is(self, code: &str) -> bool {
        self.to_string() == code
    }

    /// True if it is a code; every other word belongs to one.
    pub(super) fn is_code(self) -> bool {
        matches!(self.letter, 'G' | 'M')
    }
}

impl fmt::Display for Word {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(out, "{}{}", self.letter, self.number)
    }
}

/// Words of a line without comments, or its first flaw.
pub(super) fn words(line: &str) -> Result<Vec<Word>, Flaw> {
    let mut words: Vec<Word> = Vec::new();
    let mut left = line.trim();
    while let Some(letter) = left.chars().next() {
        if !letter.is_ascii_alphabetic() {
            return Err(no_word(letter));
        }
        let is_of_number = |c: char| matches!(c, '0'..='9' | '.' | '+' | '-' | '#');
        let length = left[1..].find(|c| !is_of_number(c)).unwrap_or(left.len() - 1);
        let (text, behind) = left.split_at(1 + length);
        let number = number(&text[1..]).ok_or_else(|| no_number(text))?;
        let word = Word { letter: letter.to_ascii_uppercase(), number };
        if !word.is_code() && words.iter().any(|before| before.letter == word.letter) {
            let has = format!("two words {} on a line", word.letter);
            return Err(Flaw::new(has, "no interpreter takes that: write two lines"));
        }
        words.push(word);
        left = behind.trim_start();
    }
    Ok(words)
}

/// Number in a word: digits with an optional point and sign, or `#`.
fn number(text: &str) -> Option<Number> {
    if text == BLANK {
        return Some(Number::Blank);
    }
    let digits = text.strip_prefix(['+', '-']).unwrap_or(text);
    let is_plain = digits.len() <= NUMBER_CHARS
        && digits.bytes().filter(|&byte| byte == b'.').count() <= 1
        && digits.bytes().any(|byte| byte.is_ascii_digit())
        && digits.bytes().all(|byte| byte.is_ascii_digit() || byte == b'.');
    is_plain.then(|| text.parse().ok()).flatten().map(Number::Plain)
}

fn no_number(text: &str) -> Flaw {
    let what = if text.len() == 1 { "without a number" } else { "whose number is none" };
    Flaw::new(format!("{text} {what}"), "a word is a letter and a plain number, such as P0 or Z-2.5")
}

/// Flaw for a character that begins no word.
fn no_word(c: char) -> Flaw {
    let (why, hint) = match c {
        '%' => (", which frames a file", "leave it out: the program ends by M2 or M30"),
        '#' | '[' | ']' | '=' => (", which computes", "write the number: what a program does must stand in it"),
        '/' => (", which a switch of the controller skips", "write the line for one way to run it"),
        '(' | ')' | ';' => (", which is of a comment", "comments stand in `gcode.header` and `gcode.footer`, as (...)"),
        _ => (", which is no word of G-code", "a line is words such as M64 P0"),
    };
    let shown = if c.is_control() { format!("the character U+{:04X}", u32::from(c)) } else { format!("`{c}`") };
    Flaw::new(format!("{shown}{why}"), hint)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_is_words() {
        let read = |line: &str| words(line).map(|words| words.iter().map(Word::to_string).collect::<Vec<_>>());
        let check = |line: &str, expected: &[&str]| assert_eq!(read(line).expect("words"), expected, "{line}");
        check("", &[]);
        check("m064 P#", &["M64", "P#"]);
        check("G0Z-1.50\tF+.5", &["G0", "Z-1.5", "F0.5"]);
        for line in
            ["M", "M 3", "Z--1", "Z1.2.3", "Z.", "Z1e", "%", "#1=2", "Z[1]", "/M3", "(a)", "M(a)64", "P#0", "P0 P1"]
        {
            assert!(read(line).is_err(), "{line}");
        }
        for line in ["$H", "Z1234567890123456789", "M0 \u{e9}", "\u{e9}"] {
            assert!(read(line).is_err(), "{line}");
        }
    }
}
