//! What the program has to say about the user's data: one type, one text rendering, one JSON form.
//!
//! A stage pushes what it finds into a [`Diagnostics`] and goes on, so that one run reports every fault of a file.

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

/// One finding about the user's data.
#[derive(Debug, Clone, PartialEq)]
pub struct Diagnostic {
    /// Which kind of finding; gives the severity.
    pub code: &'static Code,
    /// Where in the source; `None` when it concerns the file as a whole.
    pub span: Option<Span>,
    /// The piece that lies there, if it is in one.
    pub piece: Option<Box<PieceName>>,
    /// The numbers of the pieces that it is about, where it is about several.
    pub pieces: Box<[u32]>,
    /// The place on the cloth, X and Y in mm.
    pub at: Option<Box<[f64; 2]>>,
    /// How bad it is, mm, where that can be measured: of its code the worst is told first, or alone.
    pub by: Option<f64>,
    /// What is wrong and where: lower case, no full stop, values with units.
    pub message: String,
    /// What to do about it.
    pub hints: Vec<String>,
}

/// A piece as people know it.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub struct PieceName {
    /// Its number in the file.
    pub number: u32,
    /// The copy of the marker that it is of, from 1; 0 where there is but one.
    pub copy: u32,
    /// Its first label, when it has one.
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
    /// A finding about the file as a whole.
    pub fn new(code: &'static Code, message: impl Into<String>) -> Self {
        let (message, pieces, hints) = (message.into(), Box::default(), Vec::new());
        Self { code, span: None, piece: None, pieces, at: None, by: None, message, hints }
    }

    /// The finding, at a place.
    #[must_use]
    pub fn at(mut self, span: Span) -> Self {
        self.span = Some(span);
        self
    }

    /// The finding, at a place on the cloth, X and Y in mm.
    #[must_use]
    pub fn on_cloth(mut self, at: impl Into<[f64; 2]>) -> Self {
        self.at = Some(Box::new(at.into()));
        self
    }

    /// The finding, about the pieces with these numbers.
    #[must_use]
    pub fn about(mut self, pieces: Vec<u32>) -> Self {
        self.pieces = pieces.into();
        self
    }

    /// The finding, so many mm bad.
    #[must_use]
    pub fn by(mut self, by: f64) -> Self {
        self.by = Some(by);
        self
    }

    /// The finding, with one more hint.
    #[must_use]
    pub fn hint(mut self, hint: impl Into<String>) -> Self {
        self.hints.push(hint.into());
        self
    }
}

/// All findings of a run about one source, in the order in which they were found.
#[derive(Debug, Default)]
pub struct Diagnostics {
    list: Vec<Diagnostic>,
    /// How many of each code were found: those beyond [`Diagnostics::MOST_OF_A_CODE`] are counted, not kept.
    counts: Vec<(&'static Code, usize)>,
}

impl Diagnostics {
    /// How many findings of one code are kept: a megabyte of junk has a fault a byte. No marker has so many of another
    /// kind.
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

    /// The findings that were kept.
    pub fn iter(&self) -> std::slice::Iter<'_, Diagnostic> {
        self.list.iter()
    }

    /// Says of each from the `first`th on where it is, or anything else that is better known by now.
    pub fn revise(&mut self, first: usize, revise: impl FnMut(&mut Diagnostic)) {
        self.list.iter_mut().skip(first).for_each(revise);
    }

    /// How many of each code were found, kept or not, the worst code first.
    pub fn tally(&self) -> Vec<(&'static Code, usize)> {
        let mut tally: Vec<_> = self.counts.iter().copied().filter(|&(_, count)| count > 0).collect();
        tally.sort_by_key(|(code, _)| rank(code));
        tally
    }

    /// Number of findings of a severity, kept or not.
    pub fn count(&self, severity: Severity) -> usize {
        self.counts.iter().filter(|(code, _)| code.severity == severity).map(|(_, count)| count).sum()
    }

    /// Whether anything found forbids a program.
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

/// Place of a code among all, the worst first: errors, then what may spoil parts, then the rest, each by stages.
fn rank(code: &Code) -> (Severity, Harm, usize) {
    let row = code::ALL.iter().position(|other| other.name == code.name).unwrap_or(code::ALL.len());
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
