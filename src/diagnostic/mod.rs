//! What the program has to say about the user's data: one type, one text rendering, one JSON form.
//!
//! A stage pushes what it finds into a [`Diagnostics`] and goes on, so that one run reports every fault of a file.

pub mod code;
mod text;

use serde::Serialize;

pub use code::{Code, Severity};
pub use text::render;

use crate::source::{Source, Span};

/// One finding about the user's data.
#[derive(Debug, Clone, PartialEq)]
pub struct Diagnostic {
    /// Which kind of finding; gives the severity.
    pub code: &'static Code,
    /// Where in the source; `None` when it concerns the file as a whole.
    pub span: Option<Span>,
    /// What is wrong and where: lower case, no full stop, values with units.
    pub message: String,
    /// What to do about it.
    pub hints: Vec<String>,
}

impl Diagnostic {
    /// A finding about the file as a whole.
    pub fn new(code: &'static Code, message: impl Into<String>) -> Self {
        Self { code, span: None, message: message.into(), hints: Vec::new() }
    }

    /// The finding, at a place.
    #[must_use]
    pub fn at(mut self, span: Span) -> Self {
        self.span = Some(span);
        self
    }

    /// The finding, with one more hint.
    #[must_use]
    pub fn hint(mut self, hint: impl Into<String>) -> Self {
        self.hints.push(hint.into());
        self
    }

    /// The form for programs: code, severity, place, message, hints.
    pub fn to_json(&self, source: &Source) -> Json {
        Json {
            code: self.code.name,
            severity: self.code.severity,
            file: source.name().to_owned(),
            place: self.span.map(|span| {
                let place = source.place(span);
                JsonPlace { block: place.block, line: place.line, byte: place.byte, end_byte: span.end }
            }),
            message: self.message.clone(),
            hints: self.hints.clone(),
        }
    }
}

/// A diagnostic as JSON; `place` is null when it concerns the file as a whole.
#[derive(Debug, Serialize)]
pub struct Json {
    code: &'static str,
    severity: Severity,
    file: String,
    #[serde(flatten)]
    place: Option<JsonPlace>,
    message: String,
    hints: Vec<String>,
}

#[derive(Debug, Serialize)]
struct JsonPlace {
    block: u32,
    line: u32,
    byte: u32,
    end_byte: u32,
}

/// All findings of a run about one source, in the order in which they were found.
#[derive(Debug, Default)]
pub struct Diagnostics {
    list: Vec<Diagnostic>,
    /// Findings of a code beyond [`Diagnostics::MOST_OF_A_CODE`]: counted, not kept.
    surplus: Vec<(&'static Code, usize)>,
}

impl Diagnostics {
    /// How many findings of one code are kept: a megabyte of junk has a fault a byte.
    pub const MOST_OF_A_CODE: usize = 50;

    /// Adds a finding.
    pub fn push(&mut self, diagnostic: Diagnostic) {
        let code = diagnostic.code;
        if self.list.iter().filter(|d| d.code == code).count() < Self::MOST_OF_A_CODE {
            self.list.push(diagnostic);
        } else if let Some((_, count)) = self.surplus.iter_mut().find(|(c, _)| *c == code) {
            *count += 1;
        } else {
            self.surplus.push((code, 1));
        }
    }

    /// Adds all findings of another run over the same source.
    pub fn extend(&mut self, other: Self) {
        for diagnostic in other.list {
            self.push(diagnostic);
        }
        for (code, count) in other.surplus {
            match self.surplus.iter_mut().find(|(c, _)| *c == code) {
                Some((_, total)) => *total += count,
                None => self.surplus.push((code, count)),
            }
        }
    }

    /// The findings that were kept.
    pub fn iter(&self) -> std::slice::Iter<'_, Diagnostic> {
        self.list.iter()
    }

    /// Codes of which more were found than kept, and how many more.
    pub fn surplus(&self) -> &[(&'static Code, usize)] {
        &self.surplus
    }

    /// Number of findings of a severity, the surplus included.
    pub fn count(&self, severity: Severity) -> usize {
        self.list.iter().filter(|d| d.code.severity == severity).count()
            + self.surplus.iter().filter(|(c, _)| c.severity == severity).map(|(_, n)| n).sum::<usize>()
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_flood_of_one_code_is_counted_but_not_kept() {
        let mut found = Diagnostics::default();
        for _ in 0..1000 {
            found.push(Diagnostic::new(&code::SOURCE_EMPTY, "x"));
        }
        assert_eq!(found.iter().count(), Diagnostics::MOST_OF_A_CODE);
        assert_eq!(found.count(Severity::Error), 1000);
    }
}
