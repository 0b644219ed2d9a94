//! Decimal points in a cut file or a plot of whole numbers: each may stand for a digit that was changed.
//!
//! Programs write decimals of one length at every number, or leave out all zeros at their ends. A file in which few numbers
//! have a point, and zeros up to their ends, is written by neither.

use crate::diagnostic::{Code, Diagnostic};
use crate::source::Span;

/// Least number of places in whole numbers for each one with a decimal point.
const FEW: usize = 5;

/// Places of cuts with a decimal point.
#[derive(Debug, Default)]
pub(super) struct Decimals {
    count: usize,
    /// Number of those with zeros at the end of their decimals, or without any decimal.
    padded: usize,
    first: Option<Span>,
}

impl Decimals {
    /// Records a place by its text.
    pub(super) fn see(&mut self, text: &[u8], span: Span) {
        if memchr::memchr(b'.', text).is_none() {
            return;
        }
        self.count += 1;
        self.first.get_or_insert(span);
        let mut numbers = text.split(|byte| !byte.is_ascii_digit() && *byte != b'.');
        let is_padded = |number: &[u8]| number.contains(&b'.') && matches!(number.last(), Some(b'0' | b'.'));
        self.padded += usize::from(numbers.any(is_padded));
    }

    /// Number of places with a decimal point.
    pub(super) fn count(&self) -> usize {
        self.count
    }

    /// The finding on them, if the file has many more places in whole numbers: `changed` where no program writes them, `lone`
    /// on a single one without zeros at its end. `has_whole` is true if the file has that many places in whole numbers.
    pub(super) fn finding(
        &self,
        changed: &'static Code,
        lone: &'static Code,
        has_whole: impl FnOnce(usize) -> bool,
    ) -> Option<Diagnostic> {
        let first = self.first.filter(|_| self.count == 1 || self.padded == self.count)?;
        if !has_whole(FEW * self.count) {
            return None;
        }
        let times = if self.count == 1 { "once".to_owned() } else { format!("{} times", self.count) };
        let message = format!("a decimal point stands amid whole numbers; this happens {times}");
        Some(if self.padded == 0 {
            let finding = Diagnostic::new(lone, message).at(first);
            finding.hint("if a digit has become a point, a cut leads elsewhere: see it in the picture (-t svg)")
        } else {
            let finding = Diagnostic::new(changed, message).at(first);
            finding.hint("a digit may have become a point: the cut would lead elsewhere; transfer the file again")
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagnostic::code::{HPGL_LONE_POINT, HPGL_LOST};

    #[test]
    fn points_that_programs_write_are_told_from_changed_digits() {
        let check = |texts: &[&str], whole: usize, told: Option<&'static Code>| {
            let mut decimals = Decimals::default();
            for text in texts {
                decimals.see(text.as_bytes(), Span::default());
            }
            let finding = decimals.finding(&HPGL_LOST, &HPGL_LONE_POINT, |least| whole >= least);
            assert_eq!(finding.map(|finding| finding.code.name), told.map(|code| code.name), "{texts:?}");
        };
        check(&["36400,4.0"], 11, Some(&HPGL_LOST));
        check(&["36400,4.0", "36400,12.00"], 10, Some(&HPGL_LOST));
        check(&["1.42,400."], 11, Some(&HPGL_LOST));
        check(&["1642.,400"], 11, Some(&HPGL_LOST));
        check(&["1.5,400"], 11, Some(&HPGL_LONE_POINT));
        // Every number has decimals, or those that need some.
        check(&["1.50,2.00", "3.25,2.00"], 0, None);
        check(&["1.5,400", "400,2.25"], 11, None);
        check(&["1.5,400"], 4, None);
        check(&["400,400"], 12, None);
    }
}
