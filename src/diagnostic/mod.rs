//! Diagnostics about the user's data: one type, one text rendering, one JSON form.
//!
//! A stage pushes its findings into a [`Diagnostics`] and continues, so that one run reports every fault of a file.

pub mod code;
mod json;
mod kind;
pub mod pieces;
mod telling;
mod text;

pub use code::{Code, Fault, Harm, Severity};
pub use json::Json;
pub use text::{Detail, render, render_with};

use std::fmt;

use crate::source::Span;

/// Finding about the user's data.
#[derive(Debug, Clone, PartialEq)]
pub struct Diagnostic {
    /// Kind of finding; determines the severity.
    pub code: &'static Code,
    /// Place in the source; `None` if it concerns the file as a whole.
    pub span: Option<Span>,
    /// Piece at that place; `None` outside of pieces.
    pub piece: Option<Box<PieceName>>,
    /// Numbers of the pieces concerned, if there are several.
    pub pieces: Box<[u32]>,
    /// Place on the cloth, X and Y in mm.
    pub at: Option<Box<[f64; 2]>>,
    /// Magnitude, mm, if it can be measured: the worst finding of a code is reported first, or alone.
    pub by: Option<f64>,
    /// Description of the fault and its place: lower case, no full stop, values with units.
    pub message: String,
    /// Remedies.
    pub hints: Vec<String>,
}

/// Name of a piece for people.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub struct PieceName {
    /// Number in the file.
    pub number: u32,
    /// Copy of the marker, from 1; 0 if there is only one.
    pub copy: u32,
    /// First label; `None` without labels.
    pub label: Option<String>,
}

impl fmt::Display for PieceName {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "piece {}", self.number)?;
        if self.copy > 0 {
            write!(f, " of copy {}", self.copy)?;
        }
        self.label.as_ref().map_or(Ok(()), |label| write!(f, " \"{label}\""))
    }
}

impl Diagnostic {
    /// Finding about the file as a whole.
    pub fn new(code: &'static Code, message: impl Into<String>) -> Self {
        let (message, pieces, hints) = (message.into(), Box::default(), Vec::new());
        Self { code, span: None, piece: None, pieces, at: None, by: None, message, hints }
    }

    /// Sets the place in the source.
    #[must_use]
    pub fn at(mut self, span: Span) -> Self {
        self.span = Some(span);
        self
    }

    /// Sets the place on the cloth, X and Y in mm.
    #[must_use]
    pub fn on_cloth(mut self, at: impl Into<[f64; 2]>) -> Self {
        self.at = Some(Box::new(at.into()));
        self
    }

    /// Sets the numbers of the pieces concerned.
    #[must_use]
    pub fn about(mut self, pieces: Vec<u32>) -> Self {
        self.pieces = pieces.into();
        self
    }

    /// Sets the magnitude, mm.
    #[must_use]
    pub fn by(mut self, by: f64) -> Self {
        self.by = Some(by);
        self
    }

    /// Adds a hint.
    #[must_use]
    pub fn hint(mut self, hint: impl Into<String>) -> Self {
        self.hints.push(hint.into());
        self
    }
}

/// Findings of a run about one source, in the order in which they were found.
#[derive(Debug, Default)]
pub struct Diagnostics {
    list: Vec<Diagnostic>,
    /// Number of findings of each code: those beyond [`Diagnostics::MOST_OF_A_CODE`] are counted, not kept.
    counts: Vec<(&'static Code, usize)>,
}

impl Diagnostics {
    /// Greatest number of findings kept per code: a megabyte of junk has a fault per byte. No marker has as many real ones.
    pub const MOST_OF_A_CODE: usize = 10_000;

    /// Adds a finding.
    pub fn push(&mut self, diagnostic: Diagnostic) {
        let count = self.count_of(diagnostic.code);
        *count += 1;
        if *count <= Self::MOST_OF_A_CODE {
            self.list.push(diagnostic);
        }
    }

    /// Adds all findings of another run over the same source.
    pub fn extend(&mut self, other: Self) {
        let mut counted = other.counts;
        for diagnostic in other.list {
            if let Some((_, left)) = counted.iter_mut().find(|(code, _)| *code == diagnostic.code) {
                *left -= 1;
            }
            self.push(diagnostic);
        }
        for (code, left) in counted {
            *self.count_of(code) += left;
        }
    }

    fn count_of(&mut self, code: &'static Code) -> &mut usize {
        let known = self.counts.iter().position(|(known, _)| std::ptr::eq(*known, code));
        let row = known.unwrap_or_else(|| {
            self.counts.push((code, 0));
            self.counts.len() - 1
        });
        &mut self.counts[row].1
    }

    /// Findings that were kept.
    pub fn iter(&self) -> std::slice::Iter<'_, Diagnostic> {
        self.list.iter()
    }

    /// Calls `revise` for each finding from the `first`th on, to add its place or other facts known by now.
    pub fn revise(&mut self, first: usize, revise: impl FnMut(&mut Diagnostic)) {
        self.list.iter_mut().skip(first).for_each(revise);
    }

    /// Number of findings of each code, kept or not, the worst code first.
    pub fn tally(&self) -> Vec<(&'static Code, usize)> {
        let mut tally: Vec<_> = self.counts.iter().copied().filter(|&(_, count)| count > 0).collect();
        tally.sort_by_key(|(code, _)| rank(code));
        tally
    }

    /// Number of findings of a severity, kept or not.
    pub fn count(&self, severity: Severity) -> usize {
        self.counts.iter().filter(|(code, _)| code.severity == severity).map(|(_, count)| count).sum()
    }

    /// True if a finding forbids a program.
    pub fn has_errors(&self) -> bool {
        self.count(Severity::Error) > 0
    }
}

impl<'a> IntoIterator for &'a Diagnostics {
    type Item = &'a Diagnostic;
    type IntoIter = std::slice::Iter<'a, Diagnostic>;

    fn into_iter(self) -> Self::IntoIter {
        self.iter()
    }
}

/// Rank of a code, the worst first: errors, then harm to parts, then the rest, each by stages.
pub fn rank(code: &Code) -> (Severity, Harm, usize) {
    let row = code::all().position(|other| other.name == code.name).unwrap_or(usize::MAX);
    (code.severity, code.harm, row)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_flood_of_one_code_is_counted_but_not_kept() {
        let mut found = Diagnostics::default();
        for _ in 0..2 * Diagnostics::MOST_OF_A_CODE {
            found.push(Diagnostic::new(&code::SOURCE_EMPTY, "x"));
        }
        assert_eq!(found.iter().count(), Diagnostics::MOST_OF_A_CODE);
        assert_eq!(found.count(Severity::Error), 2 * Diagnostics::MOST_OF_A_CODE);
        let mut all = Diagnostics::default();
        all.push(Diagnostic::new(&code::SOURCE_EMPTY, "y"));
        all.extend(found);
        assert_eq!(all.tally(), [(&code::SOURCE_EMPTY, 1 + 2 * Diagnostics::MOST_OF_A_CODE)]);
    }
}
