//! Scanner for the numbers in an attribute, with the byte offset of each.

/// A position in the text of an attribute.
#[derive(Debug, Clone, Copy)]
pub(super) struct Scan<'a> {
    text: &'a str,
    at: usize,
}

impl<'a> Scan<'a> {
    /// A scanner at the start of a text.
    pub(super) fn of(text: &'a str) -> Self {
        Self { text, at: 0 }
    }

    /// Offset of the next byte.
    pub(super) fn byte(&self) -> usize {
        self.at
    }

    /// Rest of the text.
    pub(super) fn rest(&self) -> &'a str {
        &self.text[self.at..]
    }

    pub(super) fn is_at_end(&self) -> bool {
        self.at >= self.text.len()
    }

    /// The next letter if it is ASCII, otherwise 0.
    pub(super) fn next(&self) -> u8 {
        self.rest().bytes().next().filter(u8::is_ascii).unwrap_or(0)
    }

    /// Skips an ASCII letter.
    pub(super) fn pass(&mut self) {
        self.at += usize::from(self.next() != 0);
    }

    pub(super) fn pass_blanks(&mut self) {
        self.at += self.count(|byte| b" \t\r\n".contains(&byte));
    }

    /// Skips blanks and at most one comma.
    pub(super) fn pass_separator(&mut self) {
        self.pass_blanks();
        if self.next() == b',' {
            self.pass();
            self.pass_blanks();
        }
    }

    /// Parses a number after blanks. `None` without a finite number; only the blanks are then skipped.
    pub(super) fn number(&mut self) -> Option<f64> {
        self.pass_blanks();
        let start = self.at;
        let found = self.digits().and_then(|text| text.parse::<f64>().ok()).filter(|number| number.is_finite());
        if found.is_none() {
            self.at = start;
        }
        found
    }

    /// The text of a number: a sign, digits with a point, and an exponent.
    fn digits(&mut self) -> Option<&'a str> {
        let start = self.at;
        if b"+-".contains(&self.next()) {
            self.pass();
        }
        let is_digit = |byte: u8| byte.is_ascii_digit();
        let whole = self.count(is_digit);
        self.at += whole;
        let mut fraction = 0;
        if self.next() == b'.' {
            self.pass();
            fraction = self.count(is_digit);
            self.at += fraction;
        }
        if whole + fraction == 0 {
            return None;
        }
        let end = self.at;
        if self.next().eq_ignore_ascii_case(&b'e') {
            self.pass();
            if b"+-".contains(&self.next()) {
                self.pass();
            }
            let exponent = self.count(is_digit);
            // The unit `em` begins like an exponent.
            self.at = if exponent > 0 { self.at + exponent } else { end };
        }
        Some(&self.text[start..self.at])
    }

    fn count(&self, is: impl Fn(u8) -> bool) -> usize {
        self.rest().bytes().take_while(|byte| is(*byte)).count()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(text: &str, number: Option<f64>, rest: &str) {
        let mut scan = Scan::of(text);
        assert_eq!(scan.number(), number, "{text}");
        assert_eq!(scan.rest(), rest, "{text}");
    }

    #[test]
    fn a_number_ends_where_it_ends() {
        check("1.5.5", Some(1.5), ".5");
        check(" -1-2", Some(-1.0), "-2");
        check("+.5e1x", Some(5.0), "x");
        check("1e", Some(1.0), "e");
        check("2em", Some(2.0), "em");
        check("3.", Some(3.0), "");
        check("1E-2 ", Some(0.01), " ");
        for text in ["", ".", "-", "e5", "1e999", "ü", "NaN", "inf"] {
            check(text, None, text);
        }
    }
}
