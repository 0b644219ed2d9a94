//! Polylines in the compact encoding of PE.
//!
//! Numbers are digits of base 64 (seven-bit mode: 32), the least significant first, the last one marked by a higher range of
//! bytes; the lowest bit of the whole is the sign. (Hewlett-Packard, "HP-GL/2 and HP RTL Reference Guide", PE.) Plots that an
//! editor saved again as UTF-8 have two bytes in the place of a last digit: these are combined.

use super::instruction::{Instruction, instruction};
use super::syntax;

/// An item in the body of PE.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Item {
    /// `:` the next number is a pen.
    Pen,
    /// `<` the next move is with the pen up.
    Up,
    /// `>` the next number is the number of binary fraction bits.
    Fraction,
    /// `=` the next place is absolute.
    Absolute,
    /// A whole number that still includes its fraction bits.
    Number(i64),
}

/// End of a body.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Ending {
    /// The body continues.
    More,
    /// Semicolon.
    Done,
    /// End of the file, between two numbers.
    Open,
    /// No semicolon: the next instruction begins, or another language.
    Next,
    /// Inside a number, or at an invalid byte.
    Damaged,
}

/// Base and ranges of bytes of the two modes.
#[derive(Debug, Clone, Copy)]
struct Mode {
    bits: u32,
    /// First byte of a digit, and of a last digit.
    digit: u8,
    last: u8,
}

/// Least byte of a last digit in the eight-bit mode.
pub(super) const LAST_DIGIT: u8 = 191;
const EIGHT_BIT: Mode = Mode { bits: 6, digit: 63, last: LAST_DIGIT };
const SEVEN_BIT: Mode = Mode { bits: 5, digit: 63, last: 95 };
/// A byte that is no digit of either mode and is invalid in a body.
const NO_DIGIT: u8 = u8::MAX;
/// Number of bits of a number that are kept: a longer number is beyond any table.
const MOST_BITS: u32 = 60;

/// Reads the body of one PE.
#[derive(Debug)]
pub(super) struct Body<'a> {
    bytes: &'a [u8],
    /// Its first byte.
    pub(super) start: usize,
    /// Length of one step of a number, units.
    pub(super) step: f64,
    /// The next byte.
    pub(super) at: usize,
    mode: Mode,
    /// True if bytes above 127 come in pairs of UTF-8.
    paired: bool,
    /// True if such a pair was met.
    pub(super) repaired: bool,
    pub(super) ending: Ending,
}

impl<'a> Body<'a> {
    /// The body that starts at `at`; `paired` when the whole file is text in UTF-8.
    pub(super) fn new(bytes: &'a [u8], at: usize, paired: bool) -> Self {
        let (start, mode, ending) = (at, EIGHT_BIT, Ending::More);
        Self { bytes, start, step: 1.0, at, mode, paired, repaired: false, ending }
    }

    /// Number of bits of a number that one byte holds.
    pub(super) fn digit_bits(&self) -> u32 {
        self.mode.bits
    }

    /// True if its semicolon is all that was read.
    pub(super) fn is_empty(&self) -> bool {
        self.ending == Ending::Done && self.at == self.start + 1
    }

    /// The next item; `None` at the end, and then [`Body::ending`] tells the kind of end.
    pub(super) fn next(&mut self) -> Option<Item> {
        loop {
            let Some(&byte) = self.bytes.get(self.at) else {
                self.ending = Ending::Open;
                return None;
            };
            let item = match byte {
                b';' => {
                    self.at += 1;
                    self.ending = Ending::Done;
                    return None;
                }
                b':' => Item::Pen,
                b'<' => Item::Up,
                b'>' => Item::Fraction,
                b'=' => Item::Absolute,
                b'7' => {
                    self.mode = SEVEN_BIT;
                    self.at += 1;
                    continue;
                }
                // A change of language, ESC %.
                0x1b if self.bytes.get(self.at + 1) == Some(&b'%') => {
                    self.ending = Ending::Next;
                    return None;
                }
                // Controls and blanks are skipped.
                0..=b' ' | 127 => {
                    self.at += 1;
                    continue;
                }
                _ => return self.number(),
            };
            self.at += 1;
            return Some(item);
        }
    }

    fn number(&mut self) -> Option<Item> {
        let start = self.at;
        let Mode { bits, digit, last } = self.mode;
        let (mut value, mut shift) = (0_u64, 0);
        while let Some(byte) = self.byte() {
            let (digit, is_last) = match byte {
                _ if byte >= last && byte - last < (1 << bits) => (byte - last, true),
                _ if byte >= digit && byte - digit < (1 << bits) => (byte - digit, false),
                0..=b' ' | 127 => continue,
                _ => break,
            };
            if shift < MOST_BITS {
                value |= u64::from(digit) << shift;
            } else if digit > 0 {
                break;
            }
            shift += bits;
            if is_last {
                let magnitude = (value >> 1).cast_signed();
                return Some(Item::Number(if value & 1 == 0 { magnitude } else { -magnitude }));
            }
        }
        if self.is_instruction(start) {
            (self.at, self.ending) = (start, Ending::Next);
        } else {
            self.ending = Ending::Damaged;
        }
        None
    }

    /// True if a known instruction begins at a byte, and ends as instructions do: `AutoCAD`'s driver writes no semicolon after
    /// its last encoded polyline.
    fn is_instruction(&self, at: usize) -> bool {
        let Ok((rest, found)) = syntax::mnemonic(&self.bytes[at..]) else { return false };
        let numbers = rest.iter().position(|byte| !b"+-., 0123456789".contains(byte)).unwrap_or(rest.len());
        let goes_on = rest.get(numbers).is_none_or(|byte| byte.is_ascii_alphabetic() || b";\r\n\x03".contains(byte));
        goes_on && instruction(found) != Instruction::Unknown
    }

    /// The next byte, with the effect of saving as UTF-8 undone.
    fn byte(&mut self) -> Option<u8> {
        let first = *self.bytes.get(self.at)?;
        self.at += 1;
        if !self.paired || first < 0xc0 {
            return Some(first);
        }
        // Two bytes of UTF-8 hold the original byte: 110000ab 10cdefgh.
        let second = *self.bytes.get(self.at)?;
        if !matches!(first, 0xc2 | 0xc3) || second & 0xc0 != 0x80 {
            // Another character, such as the replacement of lost bytes: the original is unknown.
            return Some(NO_DIGIT);
        }
        self.at += 1;
        self.repaired = true;
        Some(((first & 0x03) << 6) | (second & 0x3f))
    }
}

/// True if bytes are text in UTF-8 with characters beyond ASCII; a truncated end does not matter.
pub(super) fn is_paired(bytes: &[u8]) -> bool {
    !bytes.is_ascii() && std::str::from_utf8(bytes).map_or_else(|fault| fault.error_len().is_none(), |_| true)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn items(bytes: &[u8], paired: bool) -> (Vec<Item>, Ending) {
        let mut body = Body::new(bytes, 0, paired);
        let items = std::iter::from_fn(|| body.next()).collect();
        (items, body.ending)
    }

    #[test]
    fn numbers_have_their_least_digit_first_and_their_sign_last() {
        // 100 = 200 / 2: 200 = 8 + 3 * 64, so the bytes 63 + 8 and 191 + 3.
        let check =
            |bytes: &[u8], value: i64| assert_eq!(items(bytes, false), (vec![Item::Number(value)], Ending::Done));
        check(&[71, 194, b';'], 100);
        // -100: 201 = 9 + 3 * 64.
        check(&[72, 194, b';'], -100);
        check(&[191, b';'], 0);
        // Seven bits: 200 = 8 + 6 * 32.
        check(&[b'7', 71, 101, b';'], 100);
        check(&[72, 10, 194, b';'], -100);
    }

    #[test]
    fn flags_stand_between_numbers() {
        let (found, ending) = items(b"7<=___:a>b", false);
        let n = Item::Number;
        assert_eq!(ending, Ending::Open);
        assert_eq!(found, [Item::Up, Item::Absolute, n(0), n(0), n(0), Item::Pen, n(1), Item::Fraction, n(-1)]);
    }

    #[test]
    fn an_instruction_ends_a_body_that_has_no_semicolon() {
        for (bytes, at) in [
            (b"?\xc0PUSP0;PG;".as_slice(), 2),
            (b"?\xc0PU400,400;", 2),
            (b"7?_PU", 3),
            (b"?\xc0PU;", 2),
            (b"?\xc0\x1b%0A", 2),
        ] {
            let mut body = Body::new(bytes, 0, false);
            while body.next().is_some() {}
            assert_eq!((body.ending, body.at), (Ending::Next, at), "{}", bytes.escape_ascii());
        }
        for damaged in [b"?\xc0QQ0;".as_slice(), b"?\xc0PU<?;", b"?\xc0P;"] {
            assert_eq!(items(damaged, false).1, Ending::Damaged, "{}", damaged.escape_ascii());
        }
    }

    #[test]
    fn pairs_of_utf_8_are_put_together_again() {
        let saved = "G\u{c2};".as_bytes();
        assert!(is_paired(saved) && !is_paired(b"G\xc2;") && !is_paired(b"IN;") && is_paired(&saved[..2]));
        assert_eq!(items(saved, true), (vec![Item::Number(100)], Ending::Done));
    }

    #[test]
    fn damage_is_seen() {
        assert_eq!(items(b"G,1;", false).1, Ending::Damaged);
        assert_eq!(items(b"GGGGGGGGGGGGG\xc2;", false).1, Ending::Damaged);
        assert_eq!(items(b"GG", false).1, Ending::Damaged);
        assert_eq!(items("G\u{fffd};".as_bytes(), true).1, Ending::Damaged);
    }
}
