//! The grammar of a block, without meaning: one function per rule of `grammar/iso.bnf`, in its order.
//!
//! The rules see a block without line breaks and blanks. Choosing a rule never needs more than one byte of look-ahead, so the
//! first fault is also the furthest.

use arrayvec::ArrayVec;
use nom::IResult;
use nom::bytes::complete::take_while1;
use nom::combinator::opt;
use nom::error::{ErrorKind, ParseError};
use nom::{Err, Parser};

use crate::units::digits;

/// Maximum number of codes in a block; the standard has one, files have three (`H1G71D2`).
const MOST_CODES: usize = 6;

/// Largest accepted number, in units of the file: 25 km in the smallest unit, far beyond any table. It is small enough for
/// whole numbers to be exact.
pub(super) const VALUE_MAX: f64 = 1e8;

/// Number of decimals that are used: with nine digits before them, all are exact in `f64`.
const MOST_DECIMALS: usize = 6;
const POWERS_OF_TEN: [f64; MOST_DECIMALS + 1] = [1.0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6];

/// Result of a rule.
pub(super) type Out<'a, T> = IResult<&'a [u8], T, Fault<'a>>;

/// Violation of the grammar.
#[derive(Debug, PartialEq)]
pub(super) struct Fault<'a> {
    /// The rest of the block from the fault on.
    pub(super) at: &'a [u8],
    /// Kind of fault.
    pub(super) kind: FaultKind,
}

/// Kind of fault in a block.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum FaultKind {
    /// Unexpected content; the text names the expected content.
    Expected(&'static str),
    /// An axis without a number.
    NoValue,
    /// A number beyond [`VALUE_MAX`].
    Overflow,
}

impl<'a> ParseError<&'a [u8]> for Fault<'a> {
    fn from_error_kind(at: &'a [u8], _: ErrorKind) -> Self {
        Self { at, kind: FaultKind::Expected("a word") }
    }

    fn append(_: &'a [u8], _: ErrorKind, other: Self) -> Self {
        other
    }
}

/// The words of a block.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Words {
    /// The codes, in the order of the file.
    pub(super) codes: ArrayVec<Code, MOST_CODES>,
    /// Number of codes before the point.
    pub(super) ahead: usize,
    /// The point.
    pub(super) point: Option<Point>,
}

/// The coordinates of a block, in units of the file; an omitted one keeps its last value.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct Point {
    /// Along the table.
    pub(super) x: Option<f64>,
    /// Across the table.
    pub(super) y: Option<f64>,
    /// Centre of an arc along the table, relative to its start.
    pub(super) i: Option<f64>,
    /// Centre of an arc across the table, relative to its start.
    pub(super) j: Option<f64>,
}

/// A letter and usually a number.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Code {
    /// The letter, upper case.
    pub(super) letter: u8,
    /// The number.
    pub(super) number: Option<f64>,
}

/// `<block>`, including its asterisk.
pub(super) fn block(i: &[u8]) -> Out<'_, Words> {
    let mut words = Words::default();
    let i = codes(i, &mut words)?;
    words.ahead = words.codes.len();
    let (i, point) = opt(point).parse(i)?;
    words.point = point;
    let i = codes(i, &mut words)?;
    match i.split_first() {
        Some((b'*', rest)) => Ok((rest, words)),
        Some((b'X' | b'Y' | b'I' | b'J', _)) => expected(i, "`*`, because a block holds one point,"),
        _ => expected(i, "a letter with its number, or `*`,"),
    }
}

/// `<codes>`: any number of codes, appended to `words`.
fn codes<'a>(mut i: &'a [u8], words: &mut Words) -> Result<&'a [u8], Err<Fault<'a>>> {
    while let (rest, Some(code)) = opt(code).parse(i)? {
        if words.codes.try_push(code).is_err() {
            return Err(Err::Failure(Fault { at: i, kind: FaultKind::Expected("`*` after so many codes") }));
        }
        i = rest;
    }
    Ok(i)
}

impl Point {
    /// A point with whole X and Y.
    pub(super) fn whole(x: i32, y: i32) -> Self {
        Self { x: Some(x.into()), y: Some(y.into()), ..Self::default() }
    }

    /// True for the end of an arc: a centre is given.
    pub(super) fn has_centre(&self) -> bool {
        self.i.is_some() || self.j.is_some()
    }
}

/// True if a code can begin with a letter.
pub(super) fn is_code_letter(letter: u8) -> bool {
    letter.is_ascii_uppercase() && !matches!(letter, b'X' | b'Y' | b'I' | b'J')
}

/// `<code>`
fn code(i: &[u8]) -> Out<'_, Code> {
    match i.split_first() {
        Some((&letter, rest)) if is_code_letter(letter) => {
            let (rest, number) = opt(number).parse(rest)?;
            Ok((rest, Code { letter, number }))
        }
        _ => Err(Err::Error(Fault { at: i, kind: FaultKind::Expected("a code") })),
    }
}

/// `<point>`
pub(super) fn point(mut i: &[u8]) -> Out<'_, Point> {
    let mut point = Point::default();
    let start = i.len();
    while let Some((&letter, rest)) = i.split_first() {
        match letter {
            b'X' if point.x.is_none() => (i, point.x) = coordinate(i, rest)?,
            b'Y' if point.y.is_none() => (i, point.y) = coordinate(i, rest)?,
            b'I' if point.i.is_none() => (i, point.i) = coordinate(i, rest)?,
            b'J' if point.j.is_none() => (i, point.j) = coordinate(i, rest)?,
            _ => break,
        }
    }
    if i.len() < start { Ok((i, point)) } else { expected(i, "a point") }
}

/// Number of bytes examined for a plain block: more than it can have, so that no index needs a bounds check.
const PLAIN_BYTES: usize = 40;

/// Fast path for a `<block>` of X and Y only, both whole numbers, as nearly all blocks are. Returns its length and the numbers,
/// equal to those of [`block`]. `None` for any other block, which [`block`] and [`point`] must decide.
#[inline] // most of a file is parsed here; with more than one call site the compiler would not inline it
pub(super) fn plain_block(i: &[u8; PLAIN_BYTES]) -> Option<(usize, i32, i32)> {
    let [b'X', rest @ ..] = i else { return None };
    // Numbers without signs are tried first, as they are the most common.
    let digits = rest.first_chunk()?;
    match digits::pair(digits) {
        Some(([x, y], [middle, end])) if digits[middle] == b'Y' && digits[end] == b'*' => {
            Some((end + 2, x.cast_signed(), y.cast_signed()))
        }
        _ => signed_block(i),
    }
}

/// A `<block>` of X and Y only, both whole numbers with optional signs: its length and the numbers.
#[inline(never)] // as a separate function, it does not slow down the common case
pub(super) fn signed_block(i: &[u8; PLAIN_BYTES]) -> Option<(usize, i32, i32)> {
    let (at, x, y) = plain_place(i)?;
    (i[at] == b'*').then_some((at + 1, x, y))
}

/// X and Y as whole numbers: the offset after them, and the numbers.
fn plain_place(i: &[u8; PLAIN_BYTES]) -> Option<(usize, i32, i32)> {
    let (at, x) = plain_coordinate(i, 0, b'X')?;
    let (at, y) = plain_coordinate(i, at, b'Y')?;
    Some((at, x, y))
}

/// A letter at an offset and a whole number of at most eight digits, below [`VALUE_MAX`]: the offset after it, and the number.
fn plain_coordinate(i: &[u8; PLAIN_BYTES], at: usize, letter: u8) -> Option<(usize, i32)> {
    if i[at] != letter {
        return None;
    }
    let is_negative = i[at + 1] == b'-';
    let start = at + 1 + usize::from(is_negative);
    let (magnitude, count) = digits::leading(&i[start..])?;
    let value = magnitude.cast_signed();
    Some((start + count, if is_negative { -value } else { value }))
}

/// Fast path for a `<block>` of a single code, with a whole number or none, as most other blocks are: the rest after it, and
/// the code.
pub(super) fn plain_code(i: &[u8]) -> Option<(&[u8], Code)> {
    let (&letter, rest) = i.split_first().filter(|(letter, _)| is_code_letter(**letter))?;
    let (rest, number) = match digits::leading(rest) {
        Some((number, count)) => (&rest[count..], Some(f64::from(number))),
        None => (rest, None),
    };
    let [b'*', rest @ ..] = rest else { return None };
    Some((rest, Code { letter, number }))
}

/// Fast path for a `<block>` of X, Y and one code after them, as for labels: the rest after it, and its words.
pub(super) fn plain_point_and_code(i: &[u8]) -> Option<(&[u8], Words)> {
    let (at, x, y) = plain_place(i.first_chunk()?)?;
    let (rest, code) = plain_code(&i[at..])?;
    Some((rest, Words { codes: std::iter::once(code).collect(), ahead: 0, point: Some(Point::whole(x, y)) }))
}

/// `<coordinate>`: `i` starts at the letter, `rest` at its number. After the letter the branch is certain.
fn coordinate<'a>(i: &'a [u8], rest: &'a [u8]) -> Out<'a, Option<f64>> {
    match number(rest) {
        Ok((rest, value)) => Ok((rest, Some(value))),
        Err(Err::Error(_)) => Err(Err::Failure(Fault { at: i, kind: FaultKind::NoValue })),
        Err(failure) => Err(failure),
    }
}

/// `<number>`: a whole number in units of the file; a plus sign and decimals are tolerated.
fn number(i: &[u8]) -> Out<'_, f64> {
    let (negative, unsigned) = match i.split_first() {
        Some((b'-', rest)) => (true, rest),
        Some((b'+', rest)) => (false, rest),
        _ => (false, i),
    };
    // The usual case: a whole number far below the largest.
    if let Some((magnitude, count)) = digits::leading(unsigned)
        && unsigned[count..].first() != Some(&b'.')
    {
        let value = i64::from(magnitude);
        return Ok((&unsigned[count..], (if negative { -value } else { value }) as f64));
    }
    let (mut rest, whole) = digits(unsigned)?;
    let mantissa = append(0, whole);
    let mut magnitude = mantissa as f64;
    if let Some((b'.', after)) = rest.split_first() {
        rest = after;
        if let (after, Some(decimals)) = opt(digits).parse(after)? {
            rest = after;
            // One division of two exact integers gives the nearest number.
            let kept = &decimals[..decimals.len().min(MOST_DECIMALS)];
            magnitude = append(mantissa, kept) as f64 / POWERS_OF_TEN[kept.len()];
        }
    }
    if magnitude > VALUE_MAX {
        return Err(Err::Failure(Fault { at: i, kind: FaultKind::Overflow }));
    }
    // -0.0 becomes 0.0: both are the same position but have different bit patterns.
    Ok((rest, if negative && magnitude > 0.0 { -magnitude } else { magnitude }))
}

/// The number with the digits of `value` followed by `digits`; saturates.
fn append(value: u64, digits: &[u8]) -> u64 {
    digits.iter().fold(value, |value, digit| value.saturating_mul(10).saturating_add(u64::from(digit - b'0')))
}

/// `<digits>`
fn digits(i: &[u8]) -> Out<'_, &[u8]> {
    take_while1(|byte: u8| byte.is_ascii_digit()).parse(i)
}

fn expected<'a, T>(at: &'a [u8], what: &'static str) -> Out<'a, T> {
    Err(Err::Error(Fault { at, kind: FaultKind::Expected(what) }))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(text: &str, x: Option<f64>, y: Option<f64>, codes: &str) {
        let (rest, words) = block(text.as_bytes()).expect("a block");
        assert!(rest.is_empty());
        let point = words.point.unwrap_or_default();
        assert_eq!((point.x, point.y), (x, y), "{text}");
        let found: Vec<String> = words
            .codes
            .iter()
            .map(|c| format!("{}{}", c.letter as char, c.number.map_or(String::new(), |n| n.to_string())))
            .collect();
        assert_eq!(found.join(" "), codes, "{text}");
    }

    #[test]
    fn a_block_is_codes_and_a_point() {
        check("*", None, None, "");
        check("X105Y-2326*", Some(105.0), Some(-2326.0), "");
        check("Y7*", None, Some(7.0), "");
        check("X+1.25Y10.*", Some(1.25), Some(10.0), "");
        check("H1G71D2*", None, None, "H1 G71 D2");
        check("X3904Y1117M31*", Some(3904.0), Some(1117.0), "M31");
        check("QX905Y0*", Some(905.0), Some(0.0), "Q");
        check("ZX984251*", Some(984_251.0), None, "Z");
        check("M00*", None, None, "M0");
    }

    /// The start of a file, followed by bytes that no block holds.
    fn padded(text: &[u8]) -> [u8; PLAIN_BYTES] {
        let mut start = [0; PLAIN_BYTES];
        start[..text.len()].copy_from_slice(text);
        start
    }

    #[test]
    fn a_plain_block_is_what_the_grammar_says() {
        let numbers = ["0", "-0", "7", "-7", "+7", "0042", "1234567", "-99999999", "100000000", "1.5", "3.", "", "-"];
        let ends = ["*", "", "M31*", "*X1Y1*", "Y1*", " *"];
        for (x, y) in numbers.iter().flat_map(|x| numbers.map(|y| (x, y))) {
            for text in ends.map(|end| format!("X{x}Y{y}{end}")) {
                let Some((length, x, y)) = plain_block(&padded(text.as_bytes())) else { continue };
                let rest = &text.as_bytes()[length..];
                let (left, words) = block(text.as_bytes()).expect("a block");
                let point = Point { x: Some(x.into()), y: Some(y.into()), ..Point::default() };
                assert_eq!((rest, words), (left, Words { point: Some(point), ..Words::default() }), "{text}");
            }
        }
        assert!(plain_block(&padded(b"X12Y-34*X56789*")).is_some());
    }

    #[test]
    fn a_plain_code_is_what_the_grammar_says() {
        let numbers = ["", "0", "-0", "+1", "14", "0043", "99999999", "100000000", "1.5", "3.", "-", "x"];
        let ends = ["*", "", "M31*", "*X1Y1*X1Y1*", "X1*", " *"];
        for (letter, number) in (0..=127_u8).flat_map(|letter| numbers.map(|number| (char::from(letter), number))) {
            for text in ends.map(|end| format!("{letter}{number}{end}")) {
                let Some((rest, code)) = plain_code(text.as_bytes()) else { continue };
                let (left, words) = block(text.as_bytes()).expect("a block");
                assert_eq!(
                    (rest, words),
                    (left, Words { codes: [code].into_iter().collect(), ahead: 1, point: None }),
                    "{text}"
                );
            }
        }
        assert!(plain_code(b"M14*X56789*").is_some() && plain_code(b"Q*").is_some());
    }

    #[test]
    fn zero_has_no_sign() {
        let (_, words) = block(b"X-0*").expect("a block");
        assert!(words.point.and_then(|p| p.x).is_some_and(f64::is_sign_positive));
    }

    #[test]
    fn a_fault_names_its_place() {
        let fault = |text: &'static [u8]| match block(text) {
            Err(Err::Error(fault) | Err::Failure(fault)) => (text.len() - fault.at.len(), fault.kind),
            other => panic!("{other:?}"),
        };
        assert_eq!(fault(b"X105Y*"), (4, FaultKind::NoValue));
        assert_eq!(fault(b"X99999999999Y1*"), (1, FaultKind::Overflow));
        assert!(matches!(fault(b"X1Y2X3Y4*"), (4, FaultKind::Expected(_))));
        assert!(matches!(fault(b"M14%*"), (3, FaultKind::Expected(_))));
    }
}
