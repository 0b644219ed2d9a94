//! The grammar of a group, without meaning: one function per rule of `grammar/dxf.bnf`, in its order.

/// Maximum number of digits of a code; 1071 is the largest code in use.
const CODE_DIGITS: usize = 4;
/// Codes with decimal numbers (coordinates, sizes and angles) and with whole numbers (flags and counts).
const NUMBER_CODES: std::ops::RangeInclusive<i32> = 10..=59;
const WHOLE_CODES: std::ops::RangeInclusive<i32> = 60..=79;

/// `<code>`: a whole number alone on its line.
pub(in crate::front) fn code(line: &[u8]) -> Option<i32> {
    let line = line.trim_ascii();
    let digits = line.strip_prefix(b"-").or(line.strip_prefix(b"+")).unwrap_or(line);
    if digits.len() > CODE_DIGITS {
        return None;
    }
    parsed(line)
}

/// True if the code permits `<value>`.
pub(in crate::front) fn fits(code: i32, value: &[u8]) -> bool {
    match code {
        code if NUMBER_CODES.contains(&code) => number(value).is_some(),
        code if WHOLE_CODES.contains(&code) => whole(value).is_some(),
        _ => true,
    }
}

/// `<number>`: a finite decimal number with an optional exponent.
pub(in crate::front) fn number(value: &[u8]) -> Option<f64> {
    // The standard library also accepts `inf` and `nan`; they are refused as not finite.
    let number: Option<f64> = parsed(value.trim_ascii());
    // Adding zero turns -0.0 into 0.0: both are the same position but have different bit patterns.
    number.filter(|number| number.is_finite()).map(|number| number + 0.0)
}

/// `<whole>`: a whole number. Some programs append decimals of zero.
pub(in crate::front) fn whole(value: &[u8]) -> Option<i64> {
    number(value)
        .filter(|number| number.fract() == 0.0 && number.abs() < f64::from(i32::MAX))
        .map(|number| number as i64)
}

/// Parses a text as a number.
fn parsed<T: std::str::FromStr>(text: &[u8]) -> Option<T> {
    std::str::from_utf8(text).ok()?.parse().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn codes_are_whole_numbers_whatever_blanks_are_around_them() {
        for (line, expected) in [
            (&b"  0\r"[..], Some(0)),
            (b"1071", Some(1071)),
            (b"-1", Some(-1)),
            (b"", None),
            (b"0 0", None),
            (b"1.5", None),
        ] {
            assert_eq!(code(line), expected, "{}", line.escape_ascii());
        }
    }

    #[test]
    fn numbers_are_decimal_and_finite() {
        let read = |text: &str| number(text.as_bytes());
        assert_eq!([" 12.50", "-.5", "1e2", "+3."].map(read), [Some(12.5), Some(-0.5), Some(100.0), Some(3.0)]);
        assert_eq!(
            ["12,5", "", ".", "-", "nan", "-inf", "infinity", "1e999", "0x10", "1_0", "1 0"].map(read),
            [None; 11]
        );
        assert_eq!(read("-0.0").map(f64::to_bits), Some(0));
        assert_eq!(["1", "66.0", "0.5", "1e40"].map(|text| whole(text.as_bytes())), [Some(1), Some(66), None, None]);
    }
}
