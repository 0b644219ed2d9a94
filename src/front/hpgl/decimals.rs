//! Decimal points in a plot of whole numbers: each stands for a digit that was changed.
//!
//! Programs write decimals of one length at every number, or leave out all zeros at their ends. A plot in which few numbers
//! have a point, and zeros up to their ends, is written by neither.

use super::count::Count;
use crate::diagnostic::{Diagnostic, code};
use crate::source::Span;

/// Least number of places in whole numbers for each one with a decimal point.
const FEW: usize = 5;

/// Places with a decimal point that the pen draws to.
#[derive(Debug, Default)]
pub(super) struct Decimals {
    places: Count,
    /// Number of those with zeros at the end of their decimals, or without any decimal.
    padded: usize,
}

impl Decimals {
    /// Counts a place by its text.
    pub(super) fn see(&mut self, text: &[u8], span: Span) {
        self.places.add(span);
        let mut numbers = text.split(|byte| !byte.is_ascii_digit() && *byte != b'.');
        let is_padded = |number: &[u8]| number.contains(&b'.') && matches!(number.last(), Some(b'0' | b'.'));
        self.padded += usize::from(numbers.any(is_padded));
    }

    /// The finding on them in a plot with a number of places, if they are few and no program writes them.
    pub(super) fn finding(&self, places: usize) -> Option<Diagnostic> {
        let Count { count, first: Some(_) } = self.places else { return None };
        let whole = places.saturating_sub(count);
        if whole < FEW * count || self.padded < count && count > 1 {
            return None;
        }
        let message = format!("a decimal point stands amid whole numbers; this happens {}", self.places.times());
        let finding = self.places.diagnostic(&code::HPGL_LOST, message);
        Some(finding.hint("a digit may have become a point: the outline would be another one; transfer it again"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_that_programs_write_are_told_from_changed_digits() {
        let check = |texts: &[&str], places: usize, is_told: bool| {
            let mut decimals = Decimals::default();
            texts.iter().for_each(|text| decimals.see(text.as_bytes(), Span::default()));
            assert_eq!(decimals.finding(places).is_some(), is_told, "{texts:?}");
        };
        check(&["36400,4.0"], 12, true);
        check(&["36400,4.0", "36400,12.00"], 12, true);
        check(&["1.42,400"], 12, true);
        check(&["1642.,400"], 12, true);
        // Every number has decimals, or those that need some.
        check(&["1.50,2.00", "3.25,2.00"], 2, false);
        check(&["1.5,400", "400,2.25"], 12, false);
        check(&["1.5,400"], 4, false);
        check(&[], 12, false);
    }
}
