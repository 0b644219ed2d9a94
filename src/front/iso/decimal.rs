//! Decimal points in a file of whole numbers: each stands for a digit that was changed.

use super::block::Blocks;
use crate::diagnostic::{Diagnostic, code};
use crate::source::Span;

/// Least number of places in whole numbers for each one with a decimal point.
const FEW: usize = 5;

/// Places with a decimal point.
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

    /// The finding on them, if they are few and no program writes them: programs write decimals at every number, or leave out
    /// all zeros at their ends.
    pub(super) fn finding(&self, bytes: &[u8]) -> Option<Diagnostic> {
        let first = self.first.filter(|_| self.count == 1 || self.padded == self.count)?;
        if whole_places(bytes, FEW * self.count) < FEW * self.count {
            return None;
        }
        let times = if self.count == 1 { "once".to_owned() } else { format!("{} times", self.count) };
        let message = format!("a decimal point stands amid whole numbers; this happens {times}");
        let finding = Diagnostic::new(&code::ISO_POINT, message).at(first);
        Some(finding.hint("a digit may have become a point: the cut would lead elsewhere; transfer the file again"))
    }
}

/// Number of places in whole numbers, up to `most`.
fn whole_places(bytes: &[u8], most: usize) -> usize {
    let (mut blocks, mut count) = (Blocks::new(bytes), 0);
    while count < most {
        if let Some((_, span)) = blocks.next_point() {
            count += usize::from(!bytes[span.start as usize..span.end as usize].contains(&b'.'));
        } else if blocks.next().is_none() {
            break;
        }
    }
    count
}
