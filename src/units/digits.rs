//! Whole numbers of up to eight digits, read eight bytes at a time: nearly all numbers of cutter files and plots are such,
//! and reading them byte by byte would take most of the time of a large file. What is anything else the grammars read.

/// `0` in each of eight bytes.
const ZEROS: u64 = 0x3030_3030_3030_3030;
/// The highest bit of each byte.
const HIGHEST: u64 = 0x8080_8080_8080_8080;
/// Added to a byte above 9 it reaches the highest bit: 0x80 less ten.
const ABOVE_NINE: u64 = 0x7676_7676_7676_7676;
/// Bytes that are read at once.
const WORD: usize = size_of::<u64>();

/// The number that the digits at the start of some bytes write, and how many digits it has, one to eight; `None` when
/// there are none or more, or fewer than eight bytes are left.
pub fn leading(bytes: &[u8]) -> Option<(u32, usize)> {
    // The first byte is the lowest of the word; digits become 0 to 9.
    let word = u64::from_le_bytes(*bytes.first_chunk::<WORD>()?) ^ ZEROS;
    // A carry of this sum reaches later bytes only, and the first byte that is no digit counts.
    let others = (word | word.wrapping_add(ABOVE_NINE)) & HIGHEST;
    let count = others.trailing_zeros() as usize / WORD;
    if count == 0 || (count == WORD && bytes.get(WORD).is_some_and(u8::is_ascii_digit)) {
        return None;
    }
    // With the last digit in the highest byte, zeros stand before the first. Then neighbours become numbers of two digits,
    // of four, of eight (D. Lemire, "Quickly parsing eight digits", 2018).
    let digits = word << (8 * (WORD - count));
    let twos = digits.wrapping_mul(10 * (1 << 8) + 1) >> 8 & 0x00ff_00ff_00ff_00ff;
    let fours = twos.wrapping_mul(100 * (1 << 16) + 1) >> 16 & 0x0000_ffff_0000_ffff;
    let eight = fours.wrapping_mul(10_000 * (1 << 32) + 1) >> 32;
    Some((eight as u32, count))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(text: &[u8], expected: Option<(u32, usize)>) {
        assert_eq!(leading(text), expected, "{}", text.escape_ascii());
    }

    #[test]
    fn up_to_eight_digits_are_a_number() {
        check(b"0,123456", Some((0, 1)));
        check(b"7*\xff\xff\xff\xff\xff\xff", Some((7, 1)));
        check(b"12Y-45*X", Some((12, 2)));
        check(b"00012345", Some((12_345, 8)));
        check(b"99999999*", Some((99_999_999, 8)));
        check(b"1234567;", Some((1_234_567, 7)));
        check(b"123456789", None);
        check(b"-1234567", None);
        check(b"\xb01234567", None);
        check(b"1234567", None);
        check(b"", None);
        for number in (0..99_999_999_u32).step_by(98_765) {
            let text = format!("{number}*Y00000000");
            check(text.as_bytes(), Some((number, text.find('*').expect("an asterisk"))));
        }
    }

    #[test]
    fn every_byte_that_is_no_digit_ends_a_number() {
        for byte in (0..=255_u8).filter(|byte| !byte.is_ascii_digit()) {
            check(&[b'4', b'2', byte, b'9', b'9', b'9', b'9', b'9'], Some((42, 2)));
        }
    }
}
