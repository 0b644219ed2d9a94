//! Integers of up to eight digits, read eight bytes at a time. Nearly all numbers of cutter files and plots are of this form,
//! and reading them byte by byte would dominate the time for a large file. The grammars read all other numbers.

/// `0` in each of eight bytes.
const ZEROS: u64 = 0x3030_3030_3030_3030;
/// The highest bit of each byte.
const HIGHEST: u64 = 0x8080_8080_8080_8080;
/// Addend that sets the highest bit of a byte above 9: 0x80 minus ten.
const ABOVE_NINE: u64 = 0x7676_7676_7676_7676;
/// Number of bytes read at once.
const WORD: usize = size_of::<u64>();

/// The number written by the leading digits, and the count of digits, one to eight. `None` for no digits or more than eight, or
/// for fewer than eight bytes.
pub fn leading(bytes: &[u8]) -> Option<(u32, usize)> {
    let word = *bytes.first_chunk::<WORD>()?;
    let count = others(word).trailing_zeros() as usize / WORD;
    if count == 0 || (count == WORD && bytes.get(WORD).is_some_and(u8::is_ascii_digit)) {
        return None;
    }
    Some((value(word, count), count))
}

/// Number of bytes that [`pair`] examines.
pub const PAIR: usize = 3 * WORD;

/// Two numbers separated by one byte that is not a digit, as in `105Y2326*`: the numbers, and the positions of the separator
/// and of the byte after the second number. That byte is not a digit if the separator is below 0x80. `None` when a number has
/// no digits or too many to examine.
#[inline] // most of a file is read here
pub fn pair(bytes: &[u8; PAIR]) -> Option<([u32; 2], [usize; 2])> {
    let [first, second, _] = [0, 1, 2].map(|word| bytes.as_chunks().0[word]);
    // Find both ends at once: the next number of the file starts after the second and depends only on them.
    let ends = others(first);
    if ends == 0 {
        return pair_behind_a_word(bytes);
    }
    let behind = ends & (ends - 1);
    let middle = ends.trailing_zeros() as usize / WORD;
    let end = match behind {
        0 => WORD + others(second).trailing_zeros() as usize / WORD,
        _ => behind.trailing_zeros() as usize / WORD,
    };
    let count = end - middle - 1;
    // One comparison checks for at least one digit and for at most eight.
    if middle == 0 || count.wrapping_sub(1) >= WORD {
        return None;
    }
    Some(([value(first, middle), value(*bytes[middle + 1..].first_chunk()?, count)], [middle, end]))
}

/// The pair when the first number has eight digits, as in coordinates of long markers. The second then has fewer than seven.
fn pair_behind_a_word(bytes: &[u8; PAIR]) -> Option<([u32; 2], [usize; 2])> {
    let [first, second, _] = [0, 1, 2].map(|word| bytes.as_chunks().0[word]);
    let ends = others(second);
    let behind = ends & ends.wrapping_sub(1);
    let count = (behind.trailing_zeros() as usize / WORD).wrapping_sub(1);
    if ends.trailing_zeros() as usize / WORD != 0 || !(1..WORD - 1).contains(&count) {
        return None;
    }
    let number = value(*bytes[WORD + 1..].first_chunk()?, count);
    Some(([value(first, WORD), number], [WORD, WORD + 1 + count]))
}

/// The highest bit of each byte that is not a digit. A byte above 0x7f carries into later bytes only, so the first marked byte
/// is always correct.
fn others(word: [u8; WORD]) -> u64 {
    let word = u64::from_le_bytes(word) ^ ZEROS; // digits become 0 to 9
    (word | word.wrapping_add(ABOVE_NINE)) & HIGHEST
}

/// The number written by the first `count` digits, one to eight.
fn value(word: [u8; WORD], count: usize) -> u32 {
    // The first byte is the lowest of the word. Shift the last digit into the highest byte, so that zeros precede the first
    // digit. Then combine neighbours to numbers of two, four and eight digits (D. Lemire, "Quickly parsing eight digits",
    // 2018).
    let digits = (u64::from_le_bytes(word) ^ ZEROS) << (8 * (WORD - count));
    let twos = digits.wrapping_mul(10 * (1 << 8) + 1) >> 8 & 0x00ff_00ff_00ff_00ff;
    let fours = twos.wrapping_mul(100 * (1 << 16) + 1) >> 16 & 0x0000_ffff_0000_ffff;
    let eight = fours.wrapping_mul(10_000 * (1 << 32) + 1) >> 32;
    eight as u32
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
    fn two_numbers_are_found_with_what_is_between_them() {
        let of = |text: &str| {
            let mut bytes = [b'*'; PAIR];
            bytes[..text.len()].copy_from_slice(text.as_bytes());
            pair(&bytes)
        };
        assert_eq!(of("105Y2326*"), Some(([105, 2326], [3, 8])));
        assert_eq!(of("1Y2*"), Some(([1, 2], [1, 3])));
        assert_eq!(of("1Y234567*9"), Some(([1, 234_567], [1, 8])));
        assert_eq!(of("1234567Y12345678*"), Some(([1_234_567, 12_345_678], [7, 16])));
        for (first, second) in (1..8).flat_map(|first| (1..=8).map(move |second| (first, second))) {
            let [x, y] = ["98765432", "12345678"].map(str::to_owned);
            let (x, y) = (&x[..first], &y[..second]);
            let numbers = [x, y].map(|digits| digits.parse().expect("a number"));
            assert_eq!(of(&format!("{x}Y{y}*")), Some((numbers, [first, first + 1 + second])));
        }
        for second in 1..7 {
            let y = &"98765432"[..second];
            let numbers = [12_345_678, y.parse().expect("a number")];
            assert_eq!(of(&format!("12345678Y{y}*")), Some((numbers, [8, 9 + second])));
        }
        for none in [
            "",
            "Y1*",
            "1*",
            "1Y*",
            "12345678Y*",
            "12345678Y1234567*",
            "12345678Y12345678*",
            "12345678Y-1*",
            "123456789Y1*",
            "1234567812*",
            "12345678901*",
            "1Y123456789*",
            "-1Y1*",
            "1Y-1*",
        ] {
            assert_eq!(of(none), None, "{none}");
        }
    }

    #[test]
    fn every_byte_that_is_no_digit_ends_a_number() {
        for byte in (0..=255_u8).filter(|byte| !byte.is_ascii_digit()) {
            check(&[b'4', b'2', byte, b'9', b'9', b'9', b'9', b'9'], Some((42, 2)));
        }
    }
}
