//! The words of a line of G-code that a profile gives: letters with plain numbers, and comments.
//!
//! Rules of RS274/NGC, sections 3.3 and 3.4, as `LinuxCNC` obeys them, without what computes: no parameters, no
//! expressions, no subroutines.

use super::Flaw;

/// What comments begin with that controllers obey.
const ACTIVE: &[&str] =
    &["ABORT", "DEBUG", "LOG", "LOGAPPEND", "LOGCLOSE", "LOGOPEN", "PRINT", "PROBECLOSE", "PROBEOPEN", "PY"];
/// Longest number that is read, characters: more digits say nothing.
const NUMBER_CHARS: usize = 16;

/// A letter with its number.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Word {
    /// In capitals.
    pub(super) letter: u8,
    pub(super) number: f64,
    /// As it was written, in capitals, without blanks.
    pub(super) text: String,
}

/// The words of a line; otherwise what is wrong with it first.
pub(super) fn words(line: &str) -> Result<Vec<Word>, Flaw> {
    let mut words = Vec::new();
    let mut left = line.char_indices().peekable();
    while let Some((at, c)) = left.next() {
        match c {
            ' ' | '\t' => {}
            '(' => {
                let text = line[at + 1..].split_once(')').map(|(text, _)| text);
                let text = text.ok_or_else(|| {
                    Flaw::new("a comment without its other bracket", "controllers stop there: a comment is (...)")
                })?;
                comment(text)?;
                while left.next_if(|&(other, _)| other <= at + 1 + text.len()).is_some() {}
            }
            ';' => {
                comment(&line[at + 1..])?;
                break;
            }
            _ if c.is_ascii_alphabetic() => {
                let mut text = String::from(c.to_ascii_uppercase());
                while let Some((_, c)) = left.next_if(|(_, c)| matches!(c, '0'..='9' | '.' | '+' | '-' | ' ' | '\t')) {
                    text.extend(Some(c).filter(|c| !c.is_ascii_whitespace()));
                }
                let number = number(&text[1..]).ok_or_else(|| no_number(&text))?;
                words.push(Word { letter: text.as_bytes()[0], number, text });
            }
            _ => return Err(no_word(c)),
        }
    }
    Ok(words)
}

/// Whether the text of a comment says nothing that an interpreter would stop at, or obey.
fn comment(text: &str) -> Result<(), Flaw> {
    if text.contains('(') {
        return Err(Flaw::new("a comment in a comment", "controllers stop there: brackets do not nest"));
    }
    let first = text.trim_start_matches(|c: char| c.is_ascii_whitespace() || c == '\x0b');
    let first = &first[..first.bytes().take_while(u8::is_ascii_alphabetic).count()];
    let is_active = ACTIVE.contains(&first.to_ascii_uppercase().as_str());
    let flaw = || {
        let hint = "a comment that begins otherwise is none of the controller's business; (MSG, text) shows a text";
        Flaw::new(format!("a comment that begins with {first}, which is obeyed"), hint)
    };
    (!is_active).then_some(()).ok_or_else(flaw)
}

/// A number as words have it: digits, perhaps a point, perhaps a sign before them.
fn number(text: &str) -> Option<f64> {
    let digits = text.strip_prefix(['+', '-']).unwrap_or(text);
    let is_plain = digits.len() <= NUMBER_CHARS
        && digits.bytes().filter(|&byte| byte == b'.').count() <= 1
        && digits.bytes().any(|byte| byte.is_ascii_digit())
        && digits.bytes().all(|byte| byte.is_ascii_digit() || byte == b'.');
    is_plain.then(|| text.parse().ok()).flatten()
}

fn no_number(text: &str) -> Flaw {
    let what = if text.len() == 1 { "without a number".to_owned() } else { "whose number is none".to_owned() };
    Flaw::new(format!("{text} {what}"), "a word is a letter and a plain number, such as P0 or Z-2.5")
}

/// What to say of a character that begins no word.
fn no_word(c: char) -> Flaw {
    let (why, hint) = match c {
        '%' => (", which frames a file", "leave it out: the program ends by M2 or M30"),
        '#' | '[' | ']' | '=' => (", which computes", "write the number: what a program does must stand in it"),
        '/' => (", which a switch of the controller skips", "write the line for one way to run it"),
        ')' => (", which closes no comment", "a comment is (...), without brackets in it"),
        _ => (", which is no word of G-code", "a line is words such as M64 P0, and comments in brackets"),
    };
    Flaw::new(format!("`{c}`{why}"), hint)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_is_words_and_comments() {
        let read = |line: &str| words(line).map(|words| words.into_iter().map(|word| word.text).collect::<Vec<_>>());
        let check = |line: &str, expected: &[&str]| assert_eq!(read(line).expect("words"), expected, "{line}");
        check("", &[]);
        check("m64 P 0(on) ; so", &["M64", "P0"]);
        check("G0Z-1.5\tF+.5", &["G0", "Z-1.5", "F+.5"]);
        check("(MSG, hello)", &[]);
        for line in ["M", "Z--1", "Z1.2.3", "Z.", "Z1e", "%", "#1=2", "Z[1]", "/M3", "(a", "(a (b)", "a)", "M(a)64"] {
            assert!(read(line).is_err(), "{line}");
        }
        for line in ["(py, x)", "( DEBUG, x)", ";PRINT, x", "$H", "Z1234567890123456789"] {
            assert!(read(line).is_err(), "{line}");
        }
        assert_eq!(words("Z-2").expect("a word")[0].number, -2.0);
    }
}
