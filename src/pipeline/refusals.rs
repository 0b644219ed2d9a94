//! Refusals of a target, one of each kind.

use crate::diagnostic::Diagnostic;

/// Content that a target cannot express: the first diagnostic of each kind in the file, and the number of cuts or holes.
#[derive(Default)]
pub(super) struct Refusals(Vec<(Diagnostic, usize)>);

impl Refusals {
    /// Adds a refused cut to the others of its kind.
    pub(super) fn add(&mut self, cut: Diagnostic) {
        let is_alike = |(first, _): &&mut (Diagnostic, usize)| first.code == cut.code && first.message == cut.message;
        match self.0.iter_mut().find(is_alike) {
            Some((first, cuts)) => {
                *cuts += 1;
                if cut.span < first.span {
                    *first = cut;
                }
            }
            None => self.0.push((cut, 1)),
        }
    }

    /// Moves the refusals of other content behind these.
    pub(super) fn append(&mut self, others: &mut Self) {
        self.0.append(&mut others.0);
    }

    pub(super) fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// One diagnostic of each kind, with the number of cuts.
    pub(super) fn into_diagnostics(self) -> impl Iterator<Item = Diagnostic> {
        self.0.into_iter().map(|(first, cuts)| match first.span {
            Some(span) if cuts > 1 => {
                let message =
                    format!("{}: {cuts} cuts are like that, the first in block {}", first.message, span.block);
                Diagnostic { message, ..first }
            }
            Some(_) | None => first,
        })
    }
}
