//! The only printer of numbers: no locale, no `-0.000`, the same bytes for the same value.

use super::S_PER_MIN;

/// Largest scaled magnitude for the integer path: below 2^53, so that every integer is exact in `f64`.
const INTEGER_PATH_MAX: f64 = 9.0e15;

/// Maximum number of characters of such a number: its digits, padding for the decimals, a point and a sign.
const DIGITS: usize = 32;

/// Maximum number of digits before the point of such a number.
const WHOLE: usize = 16;

/// Buffer of a number. Its characters end in the middle, so that a copy of constant length can start at any of them.
type Digits = [u8; 2 * DIGITS];

/// Maximum number of decimals in any format here.
const DECIMALS_MAX: usize = 9;
/// The powers of ten up to that.
const POWERS: [f64; DECIMALS_MAX + 1] = [1.0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9];

/// Appends `value` with exactly `decimals` decimals (at most 9), rounded half away from zero, never as `-0.0`.
///
/// Values beyond the integer path (and the non-finite, which no program holds) are printed by the standard library.
pub fn push_fixed(out: &mut Vec<u8>, value: f64, decimals: u32) {
    let decimals = decimals as usize;
    assert!(decimals <= DECIMALS_MAX, "more decimals than any format here prints");
    let scaled = value * POWERS[decimals];
    if scaled.is_nan() || scaled.abs() > INTEGER_PATH_MAX {
        out.extend_from_slice(format!("{value:.decimals$}").as_bytes());
        return;
    }
    // The difference to the integer part is exact.
    let whole = scaled.abs() as i64;
    let rounded = (whole + i64::from(scaled.abs() - whole as f64 >= 0.5)) as u64;
    let mut digits: Digits = [b'0'; 2 * DIGITS];
    let mut at = put(&mut digits, rounded).min(DIGITS - 1 - decimals);
    if decimals > 0 {
        // The digits before the point make room for it.
        let point = DIGITS - decimals;
        digits.copy_within(point - WHOLE..point, point - WHOLE - 1);
        at -= 1;
        digits[point - 1] = b'.';
    }
    if scaled < 0.0 && rounded > 0 {
        at -= 1;
        digits[at] = b'-';
    }
    append(out, &digits, at);
}

/// Appends the characters of the buffer from a position on.
fn append(out: &mut Vec<u8>, digits: &Digits, at: usize) {
    let end = out.len() + DIGITS - at;
    out.extend_from_slice(digits[at..].first_chunk::<DIGITS>().expect("a number begins before the middle"));
    out.truncate(end);
}

/// Writes a number so that it ends in the middle, in groups of eight digits, and returns the place of its first digit that is
/// not zero.
fn put(digits: &mut Digits, mut value: u64) -> usize {
    let mut at = DIGITS;
    loop {
        let group = eight((value % 100_000_000) as u32);
        at -= 8;
        digits[at..at + 8].copy_from_slice(&(group | u64::from_le_bytes([b'0'; 8])).to_le_bytes());
        value /= 100_000_000;
        if value == 0 {
            return at + group.trailing_zeros() as usize / 8;
        }
    }
}

/// The eight digits of a number, one in each byte, the first in the lowest. Groups of four, two and one digit are divided all at
/// once: the products with 10,486 and 103, shifted, are exact quotients by a hundred and by ten.
fn eight(value: u32) -> u64 {
    let fours = u64::from(value / 10_000) | u64::from(value % 10_000) << 32;
    let hundreds = ((fours * 10_486) >> 20) & 0x0000_007f_0000_007f;
    let twos = hundreds | (fours - 100 * hundreds) << 16;
    let tens = ((twos * 103) >> 10) & 0x000f_000f_000f_000f;
    tens | (twos - 10 * tens) << 8
}

/// Appends an integer.
pub fn push_integer(out: &mut Vec<u8>, value: u64) {
    let mut digits: Digits = [b'0'; 2 * DIGITS];
    let at = put(&mut digits, value).min(DIGITS - 1);
    append(out, &digits, at);
}

/// `value` with exactly `decimals` decimals, as printed by [`push_fixed`].
pub fn fixed(value: f64, decimals: u32) -> String {
    let mut out = Vec::with_capacity(24);
    push_fixed(&mut out, value, decimals);
    String::from_utf8(out).expect("digits are ASCII")
}

/// `value` with `decimals` decimals, rounded up: as a limit, the text permits the value.
pub fn up(value: f64, decimals: u32) -> String {
    let step = POWERS[decimals as usize];
    let nearest = (value * step).round() / step;
    fixed(if nearest < value { nearest + 1.0 / step } else { nearest }, decimals)
}

/// The shortest text that parses to the same `f64`; zero has no sign.
pub fn exact(value: f64) -> String {
    format!("{}", if value == 0.0 { 0.0 } else { value })
}

/// Six significant digits, for people: 0.0423333 for a 600th of an inch.
pub fn short(value: f64) -> String {
    // The standard library rounds to decimal digits; parsing the result and printing it exactly adds no others.
    exact(format!("{value:.5e}").parse().unwrap_or(value))
}

/// Duration for people, with the given decimals of a second: `59.9 s`, `2 min 05.3 s`.
pub fn clock(seconds: f64, decimals: u32) -> String {
    // Round first: 119.96 s are 2 min, not 1 min 60.0 s.
    let rounded = fixed(seconds, decimals).parse().unwrap_or(seconds);
    let minutes = (rounded / S_PER_MIN).floor();
    if minutes < 1.0 {
        return format!("{} s", fixed(rounded, decimals));
    }
    let width = if decimals == 0 { 2 } else { decimals as usize + 3 };
    format!("{} min {:0>width$} s", fixed(minutes, 0), fixed(rounded - minutes * S_PER_MIN, decimals))
}

/// A number with its noun: `1 error`, `2 errors`.
pub fn counted(count: usize, noun: &str) -> String {
    format!("{count} {noun}{}", if count == 1 { "" } else { "s" })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Powers of ten up to a greatest value, each with its neighbours.
    fn powers(most: u64) -> Vec<u64> {
        let powers = (0..20).map(|exponent| 10_u64.pow(exponent)).filter(|power| *power < most);
        powers.flat_map(|power| [power - 1, power, power + 1]).collect()
    }

    /// Seeded values of every number of digits, up to a greatest one.
    fn seeded(most: u64) -> Vec<u64> {
        let mut random = fastrand::Rng::with_seed(59);
        let value = |_| {
            let shift = random.u32(..most.ilog2());
            random.u64(..=most >> shift)
        };
        (0..20_000).map(value).collect()
    }

    #[test]
    fn integers_have_the_digits_of_the_standard_library() {
        for value in powers(u64::MAX).into_iter().chain(seeded(u64::MAX)).chain([u64::MAX]) {
            let mut out = b"x".to_vec();
            push_integer(&mut out, value);
            assert_eq!(String::from_utf8(out).expect("ASCII"), format!("x{value}"));
        }
    }

    #[test]
    fn fixed_numbers_have_the_digits_of_the_rounded_integer() {
        let most = INTEGER_PATH_MAX as u64;
        for count in powers(most).into_iter().chain(seeded(most)).chain([most]) {
            for (decimals, power) in POWERS.iter().enumerate() {
                let value = count as f64 / power;
                let rounded = (value * power).round() as u64;
                if rounded > most {
                    continue;
                }
                let digits = format!("{rounded:0>width$}", width = decimals + 1);
                let (whole, part) = digits.split_at(digits.len() - decimals);
                let point = if decimals > 0 { "." } else { "" };
                let expected = format!("{whole}{point}{part}");
                assert_eq!(fixed(value, decimals as u32), expected, "{value}");
                let sign = if rounded > 0 { "-" } else { "" };
                assert_eq!(fixed(-value, decimals as u32), format!("{sign}{expected}"), "{value}");
            }
        }
    }

    #[test]
    fn fixed_numbers_have_no_negative_zero() {
        assert_eq!(fixed(-0.000_000_4, 6), "0.000000");
        assert_eq!(fixed(-0.000_000_6, 6), "-0.000001");
        assert_eq!(fixed(1.5, 0), "2");
        assert_eq!([fixed(0.5, 0), fixed(-2.5, 0), fixed(0.499_999_999_999_999_94, 0)], ["1", "-3", "0"]);
        assert_eq!([fixed(0.0, 3), fixed(9.9999, 3), fixed(-123_456.789, 2)], ["0.000", "10.000", "-123456.79"]);
        assert_eq!(fixed(-12.345_678_9, 3), "-12.346");
        assert_eq!(fixed(0.05, 6), "0.050000");
        assert_eq!(fixed(1e20, 2), "100000000000000000000.00");
    }

    #[test]
    fn a_limit_that_is_printed_passes_when_it_is_set() {
        assert_eq!([up(0.121, 2), up(0.12, 2), up(0.1, 1), up(5.000_000_1, 1)], ["0.13", "0.12", "0.1", "5.1"]);
        for i in 1..2000 {
            let value = f64::from(i) * 0.003_7;
            assert!(up(value, 2).parse::<f64>().expect("a number") >= value - 1e-12, "{value}");
        }
    }

    #[test]
    fn durations_are_rounded_before_they_are_split() {
        let shown = [(59.94, 1), (59.96, 1), (125.3, 1), (119.999_9, 3), (3600.0, 0)].map(|(s, of)| clock(s, of));
        assert_eq!(shown, ["59.9 s", "1 min 00.0 s", "2 min 05.3 s", "2 min 00.000 s", "60 min 00 s"]);
    }

    #[test]
    fn exact_numbers_read_back() {
        for value in [0.1, -1.0 / 3.0, 1e-12, 123_456_789.125] {
            assert_eq!(exact(value).parse::<f64>(), Ok(value));
        }
        assert_eq!(exact(-0.0), "0");
    }

    #[test]
    fn short_numbers_have_six_digits_at_the_most() {
        for (value, text) in [(25.4 / 600.0, "0.0423333"), (0.0254, "0.0254"), (25.4 / 300.0, "0.0846667"), (1.0, "1")]
        {
            assert_eq!(short(value), text);
        }
        assert_eq!((short(-0.0), short(f64::INFINITY)), ("0".to_owned(), "inf".to_owned()));
    }
}
