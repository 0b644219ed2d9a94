//! Counter of occurrences in a plot.

use crate::diagnostic::{Code, Diagnostic};
use crate::source::Span;

/// Number of occurrences, and the location of the first.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Count {
    pub(super) count: usize,
    pub(super) first: Option<Span>,
}

impl Count {
    /// Adds an occurrence.
    pub(super) fn add(&mut self, span: Span) {
        self.count += 1;
        self.first.get_or_insert(span);
    }

    /// The number in words.
    pub(super) fn times(&self) -> String {
        if self.count == 1 { "once".to_owned() } else { format!("{} times", self.count) }
    }

    /// A diagnostic at the first occurrence.
    pub(super) fn diagnostic(&self, code: &'static Code, message: String) -> Diagnostic {
        Diagnostic { span: self.first, ..Diagnostic::new(code, message) }
    }
}
