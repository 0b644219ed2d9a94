//! Numbers in the text of programs.

/// Maximum number of characters of a field in a message.
const QUOTED_CHARS: usize = 24;
/// Maximum number of digits of an integer that `f64` represents exactly.
const EXACT_DIGITS: usize = 15;
const POWERS: [f64; 16] = [1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15];

/// Field as a message shows it.
pub(in crate::verify) fn quoted(field: &[u8]) -> String {
    let text: String = String::from_utf8_lossy(field).escape_debug().take(QUOTED_CHARS).collect();
    if text.is_empty() { "nothing".to_owned() } else { format!("`{text}`") }
}

/// Integer below 2^32; `None` for anything else.
pub(crate) fn whole(field: &[u8]) -> Option<u32> {
    if field.is_empty() || field.len() > 10 {
        return None;
    }
    let value = field.iter().try_fold(0_u64, |sum, b| b.is_ascii_digit().then(|| sum * 10 + u64::from(b - b'0')))?;
    u32::try_from(value).ok()
}

/// Decimal number, correctly rounded; `None` for anything else. Short numbers are a quotient of two exact values, hence rounded
/// once.
pub(crate) fn decimal(field: &[u8]) -> Option<f64> {
    short(field).or_else(|| {
        // Exponents and long numbers: use the standard library, but reject the words that it accepts.
        let is_number = field.iter().all(|byte| matches!(byte, b'0'..=b'9' | b'.' | b'e' | b'E' | b'+' | b'-'));
        let number: f64 = std::str::from_utf8(field).ok().filter(|_| is_number)?.parse().ok()?;
        number.is_finite().then_some(number)
    })
}

/// Decimal number with few digits and without exponent, the usual case; `None` for any other text.
pub(in crate::verify) fn short(field: &[u8]) -> Option<f64> {
    leading(field).filter(|(_, length)| *length == field.len()).map(|(number, _)| number)
}

/// Short decimal number at the beginning of a text, and its length in bytes.
pub(super) fn leading(text: &[u8]) -> Option<(f64, usize)> {
    let start = usize::from(text.first() == Some(&b'-'));
    let (before, mut value) = digits(&text[start..], 0);
    let (mut at, mut decimals) = (start + before, 0);
    if text.get(at) == Some(&b'.') {
        (decimals, value) = digits(&text[at + 1..], value);
        at += 1 + decimals;
    }
    let count = before + decimals;
    let magnitude = || value as f64 / POWERS[decimals];
    (1..=EXACT_DIGITS).contains(&count).then(|| (if start == 0 { magnitude() } else { -magnitude() }, at))
}

/// Number of leading digits of a text, and `value` continued by them.
fn digits(text: &[u8], mut value: u64) -> (usize, u64) {
    for (i, byte) in text.iter().enumerate() {
        let digit = byte.wrapping_sub(b'0');
        if digit >= 10 {
            return (i, value);
        }
        value = value.wrapping_mul(10).wrapping_add(u64::from(digit));
    }
    (text.len(), value)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn decimals_are_read_as_the_standard_library_reads_them() {
        for text in ["0", "-0.000001", "12.345678", "-98765.432100", "1e-3", "123456789012345678.5"] {
            assert_eq!(decimal(text.as_bytes()), text.parse().ok(), "{text}");
        }
        for text in ["", "-", ".", "nan", "inf", "1,5", "0x10", "1.2.3", " 1"] {
            assert_eq!(decimal(text.as_bytes()), None, "{text}");
        }
    }
}
