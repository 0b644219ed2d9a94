//! Numbers, flags and lengths.

/// Sequential reader of bytes.
pub(super) struct Numbers<'a> {
    pub(super) bytes: &'a [u8],
    pub(super) at: usize,
}

impl<'a> Numbers<'a> {
    pub(super) fn of(text: &'a str) -> Self {
        Self { bytes: text.as_bytes(), at: 0 }
    }

    pub(super) fn peek(&self) -> Option<u8> {
        self.bytes.get(self.at).copied()
    }

    /// Skips blanks and commas.
    pub(super) fn skip(&mut self) {
        while self.peek().is_some_and(|byte| byte.is_ascii_whitespace() || byte == b',') {
            self.at += 1;
        }
    }

    /// Next number.
    pub(super) fn number(&mut self) -> Option<f64> {
        self.skip();
        let (mut end, mut has_point, mut has_exponent, mut has_digit) = (self.at, false, false, false);
        while let Some(&byte) = self.bytes.get(end) {
            let before = self.bytes[self.at..end].last().copied();
            let goes_on = match byte {
                b'0'..=b'9' => true,
                b'+' | b'-' => matches!(before, None | Some(b'e' | b'E')),
                b'.' => !has_point && !has_exponent,
                b'e' | b'E' => has_digit && !has_exponent && self.is_exponent(end),
                _ => false,
            };
            if !goes_on {
                break;
            }
            has_point |= byte == b'.';
            has_exponent |= byte.eq_ignore_ascii_case(&b'e');
            has_digit |= byte.is_ascii_digit();
            end += 1;
        }
        let value = std::str::from_utf8(&self.bytes[self.at..end]).ok()?.parse::<f64>().ok()?;
        self.at = end;
        value.is_finite().then_some(value)
    }

    /// True if digits follow an `e`.
    fn is_exponent(&self, at: usize) -> bool {
        match &self.bytes[at + 1..] {
            [b'+' | b'-', digit, ..] | [digit, ..] => digit.is_ascii_digit(),
            [] => false,
        }
    }

    /// Flag of an arc.
    pub(super) fn flag(&mut self) -> Option<bool> {
        self.skip();
        let flag = self.peek().filter(|byte| b"01".contains(byte))?;
        self.at += 1;
        Some(flag == b'1')
    }
}

/// All numbers of a list.
pub(super) fn list(text: &str) -> Vec<f64> {
    let mut numbers = Numbers::of(text);
    std::iter::from_fn(|| numbers.number()).collect()
}

/// Length in pixels at `dots` pixels per inch; percentages refer to `whole`.
pub(super) fn length(text: &str, dots: f64, whole: f64) -> Option<f64> {
    let mut numbers = Numbers::of(text.trim());
    let value = numbers.number()?;
    let unit = std::str::from_utf8(&numbers.bytes[numbers.at..]).ok()?.trim().to_lowercase();
    let inches = match unit.as_str() {
        "" | "px" => return Some(value),
        "%" => return Some(whole * value / 100.0),
        "in" => 1.0,
        "mm" => 1.0 / 25.4,
        "cm" => 1.0 / 2.54,
        "q" => 1.0 / 101.6,
        "pt" => 1.0 / 72.0,
        "pc" => 1.0 / 6.0,
        _ => return None,
    };
    Some(value * inches * dots)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_end_where_the_next_begins() {
        assert_eq!(list("1-2.5.5,+3e1 4E-1"), [1.0, -2.5, 0.5, 30.0, 0.4]);
        assert_eq!(list("1..5"), [1.0, 0.5]);
        assert!(list("x").is_empty());
    }

    #[test]
    fn lengths_are_in_pixels() {
        for (text, px) in
            [("1in", 96.0), ("25.4mm", 96.0), ("2.54 cm", 96.0), ("72pt", 96.0), ("6pc", 96.0), ("101.6Q", 96.0)]
        {
            assert!(length(text, 96.0, 0.0).is_some_and(|found| (found - px).abs() < 1e-9), "{text}");
        }
        assert_eq!(length("50%", 96.0, 30.0), Some(15.0));
        assert_eq!(length("5px", 96.0, 30.0), Some(5.0));
        assert_eq!(length("5em", 96.0, 30.0), None);
    }
}
