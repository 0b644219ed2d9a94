//! The grammar of an instruction, without meaning: one function per rule of `grammar/hpgl.bnf`, in its order.
//!
//! Bytes between instructions, and bodies with their own rules (labels, encoded polylines, escape sequences), are handled in
//! [`super::reader`], [`super::label`], [`super::encoded`] and [`super::escape`].

use nom::bytes::complete::take_while;
use nom::combinator::opt;
use nom::error::{ErrorKind, ParseError};
use nom::{Err, IResult, Parser};

use crate::units::digits;

/// Result of a rule.
pub(super) type Out<'a, T> = IResult<&'a [u8], T, Fault>;

/// Reason why a rule does not match.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Fault {
    /// Other content.
    Other,
    /// A number beyond [`VALUE_MAX`].
    Overflow,
}

impl<'a> ParseError<&'a [u8]> for Fault {
    fn from_error_kind(_: &'a [u8], _: ErrorKind) -> Self {
        Self::Other
    }

    fn append(_: &'a [u8], _: ErrorKind, other: Self) -> Self {
        other
    }
}

/// Largest accepted number, in units of the file: 2.5 km in 1/40 mm, far beyond any table. It is small enough for whole numbers
/// and their binary fractions to be exact.
pub(super) const VALUE_MAX: f64 = 1e8;

/// Number of decimals that need no search for the nearest number: with nine digits before them, all are exact in `f64`.
const MOST_DECIMALS: usize = 6;
const POWERS_OF_TEN: [f64; MOST_DECIMALS + 1] = [1.0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6];

/// `<mnemonic>`: two letters, converted to upper case.
pub(super) fn mnemonic(i: &[u8]) -> Out<'_, [u8; 2]> {
    match i {
        [a, b, rest @ ..] if a.is_ascii_alphabetic() && b.is_ascii_alphabetic() => {
            Ok((rest, [a.to_ascii_uppercase(), b.to_ascii_uppercase()]))
        }
        _ => other(),
    }
}

/// Fast path for two of `<parameter>` that are whole numbers, separated by a comma and optionally preceded by one. The result
/// equals that of [`parameter`]; `None` for anything else.
#[inline] // nearly all of a plot is parsed here
pub(super) fn plain_pair(i: &[u8]) -> Option<(&[u8], [f64; 2])> {
    let i = if let [b',', i @ ..] = i { i } else { i };
    let (i, x) = plain_number(i)?;
    let [b',', i @ ..] = i else { return None };
    let (i, y) = plain_number(i)?;
    Some((i, [x, y]))
}

/// A whole number of at most eight digits, hence below [`VALUE_MAX`], without decimals.
fn plain_number(i: &[u8]) -> Option<(&[u8], f64)> {
    let (sign, unsigned) = if let [b'-', unsigned @ ..] = i { (-1, unsigned) } else { (1, i) };
    let (magnitude, count) = digits::leading(unsigned)?;
    let rest = &unsigned[count..];
    (rest.first() != Some(&b'.')).then_some((rest, (sign * i64::from(magnitude)) as f64))
}

/// `<parameter>`: a number after optional commas and blanks. A sign also separates numbers.
pub(super) fn parameter(i: &[u8]) -> Out<'_, f64> {
    number(&i[separators(i)..])
}

/// Number of leading separator bytes.
pub(super) fn separators(i: &[u8]) -> usize {
    i.iter().position(|&byte| !is_separator(byte)).unwrap_or(i.len())
}

/// True if more than one comma stands before the next number: a number between them is lost.
pub(super) fn has_gap(i: &[u8]) -> bool {
    i[..separators(i)].split(|byte| *byte == b',').count() > 2
}

fn is_separator(byte: u8) -> bool {
    matches!(byte, b',' | b' ' | b'\t' | b'\r' | b'\n')
}

/// `<number>`: a decimal number without an exponent.
fn number(i: &[u8]) -> Out<'_, f64> {
    let (negative, unsigned) = match i.split_first() {
        Some((b'-', rest)) => (true, rest),
        Some((b'+', rest)) => (false, rest),
        _ => (false, i),
    };
    let (mut rest, whole) = opt(digits).parse(unsigned)?;
    let mut magnitude = whole.unwrap_or_default() as f64;
    if let Some((b'.', after)) = rest.split_first() {
        let count = after.iter().position(|byte| !byte.is_ascii_digit()).unwrap_or(after.len());
        if whole.is_none() && count == 0 {
            return other();
        }
        rest = &after[count..];
        magnitude = match POWERS_OF_TEN.get(count) {
            Some(scale) => {
                let (_, decimals) = opt(digits).parse(&after[..count])?;
                // One division of two exact integers gives the nearest number.
                (magnitude * scale + decimals.unwrap_or_default() as f64) / scale
            }
            // Digits with one decimal point always parse as a number.
            None => nearest(&unsigned[..unsigned.len() - rest.len()]).unwrap_or(magnitude),
        };
    } else if whole.is_none() {
        return other();
    }
    if magnitude > VALUE_MAX {
        return Err(Err::Failure(Fault::Overflow));
    }
    // -0.0 becomes 0.0: both are the same position but have different bit patterns.
    Ok((rest, if negative && magnitude > 0.0 { -magnitude } else { magnitude }))
}

/// The nearest number to a decimal with any number of digits.
fn nearest(decimal: &[u8]) -> Option<f64> {
    std::str::from_utf8(decimal).ok()?.parse().ok()
}

/// The rest after a number that is too large for [`parameter`].
pub(super) fn behind_number(i: &[u8]) -> &[u8] {
    let behind = |i: &[u8], is: &dyn Fn(u8) -> bool| i.iter().position(|&byte| !is(byte)).unwrap_or(i.len());
    let i = &i[behind(i, &is_separator)..];
    let i = i.strip_prefix(b"-").or_else(|| i.strip_prefix(b"+")).unwrap_or(i);
    let i = &i[behind(i, &|byte| byte.is_ascii_digit())..];
    let i = i.strip_prefix(b".").unwrap_or(i);
    &i[behind(i, &|byte| byte.is_ascii_digit())..]
}

/// `<digits>`: their value; saturates at `u64::MAX`.
fn digits(i: &[u8]) -> Out<'_, u64> {
    let (mut value, mut rest) = (0_u64, i);
    while let [digit @ b'0'..=b'9', behind @ ..] = rest {
        value = value.saturating_mul(10).saturating_add(u64::from(digit - b'0'));
        rest = behind;
    }
    if rest.len() == i.len() { other() } else { Ok((rest, value)) }
}

/// `<end>`: an optional semicolon after optional blanks; a letter also ends an instruction.
pub(super) fn end(i: &[u8]) -> Out<'_, ()> {
    let (i, _) = take_while(is_separator).parse(i)?;
    Ok((i.strip_prefix(b";").unwrap_or(i), ()))
}

fn other<'a, T>() -> Out<'a, T> {
    Err(Err::Error(Fault::Other))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(text: &str, expected: &[f64], left: &str) {
        let mut rest = text.as_bytes();
        let mut found = Vec::new();
        while let Ok((after, value)) = parameter(rest) {
            found.push(value);
            rest = after;
        }
        assert_eq!(found, expected, "{text}");
        assert_eq!(String::from_utf8_lossy(rest), left, "{text}");
    }

    #[test]
    fn parameters_are_separated_by_commas_blanks_and_signs() {
        check("1,2;", &[1.0, 2.0], ";");
        check("1 2\t3\r\n4PU", &[1.0, 2.0, 3.0, 4.0], "PU");
        check("10-20+30-.5", &[10.0, -20.0, 30.0, -0.5], "");
        check("1.5,2.;", &[1.5, 2.0], ";");
        check("718304,0000000000000000000012", &[718_304.0, 12.0], "");
        check("-,4", &[], "-,4");
        check(".;", &[], ".;");
    }

    #[test]
    fn a_number_beyond_any_table_is_a_fault_and_zero_has_no_sign() {
        assert_eq!(number(b"2147483648"), Err(Err::Failure(Fault::Overflow)));
        assert_eq!(number(b"99999999999999999999999999"), Err(Err::Failure(Fault::Overflow)));
        assert_eq!(number(b"100000000").map(|found| found.1), Ok(1e8));
        assert!(number(b"-0.0").is_ok_and(|(_, zero)| zero.is_sign_positive()));
    }

    #[test]
    fn every_decimal_counts() {
        for text in ["0.1234567", "12345678.123456789012345678901234567890", ".000000049", "7.0000000000000000000"] {
            assert_eq!(number(text.as_bytes()), Ok((&b""[..], text.parse().expect("a number"))), "{text}");
            assert_eq!(
                number(format!("-{text};").as_bytes()).map(|found| -found.1),
                Ok(text.parse().expect("a number"))
            );
        }
    }

    #[test]
    fn a_mnemonic_is_two_letters_in_either_case() {
        assert_eq!(mnemonic(b"pD1,2"), Ok((&b"1,2"[..], *b"PD")));
        assert_eq!(mnemonic(b"P1"), Err(Err::Error(Fault::Other)));
        assert_eq!(end(b" \r\n;PU"), Ok((&b"PU"[..], ())));
        assert_eq!(end(b"PU"), Ok((&b"PU"[..], ())));
    }

    #[test]
    fn a_plain_pair_is_what_the_grammar_says() {
        let numbers = ["0", "-0", "7", "-7", "+7", "0042", "1234567", "-99999999", "100000000", "1.5", "3.", "", "-"];
        let (starts, ends) = (["", ",", ",,", " "], [";", "", ",5,6", "-7", "PU"]);
        let mut plain = 0;
        for (x, y) in numbers.iter().flat_map(|x| numbers.map(|y| (x, y))) {
            for text in starts.iter().flat_map(|start| ends.map(|end| format!("{start}{x},{y}{end}        "))) {
                let Some((rest, pair)) = plain_pair(text.as_bytes()) else { continue };
                let (left, first) = parameter(text.as_bytes()).expect("a number");
                let (left, second) = parameter(left).expect("a number");
                assert_eq!((rest, pair), (left, [first, second]), "{text}");
                assert!(pair.iter().all(|value| *value != 0.0 || value.is_sign_positive()));
                plain += 1;
            }
        }
        assert!(plain > 100, "{plain}");
    }
}
