//! Findings about a file, as rows, manifests and overviews tell them.

use serde::{Deserialize, Serialize};

use crate::diagnostic::{Diagnostic, Diagnostics, Harm, Severity};

/// Findings about a file in numbers and words.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub(in crate::cli) struct Found {
    pub(in crate::cli) errors: usize,
    pub(in crate::cli) warnings: usize,
    /// Number of the warnings that parts may be spoilt; a line of an earlier version has none.
    #[serde(default)]
    pub(in crate::cli) spoils: usize,
    /// Message of the worst finding, with its piece; empty if there is none.
    pub(in crate::cli) told: String,
    /// First hint of the finding; empty without one.
    #[serde(default)]
    pub(in crate::cli) hint: String,
    /// Messages of further errors, in the order of the file; the first few.
    #[serde(default)]
    pub(in crate::cli) more: Vec<String>,
}

/// Maximum number of further errors that are told; the page of a file has all.
const MOST_MORE: usize = 4;

impl Found {
    /// The findings of a compile.
    pub(in crate::cli) fn of(diagnostics: &Diagnostics) -> Self {
        let worst = worst(diagnostics);
        let of_worst = diagnostics.iter().filter(|finding| Some(finding.code.name) == worst);
        let by = |finding: &Diagnostic| finding.by.unwrap_or(0.0);
        let first = of_worst.reduce(|worst, other| if by(other) > by(worst) { other } else { worst });
        let errors = diagnostics.iter().filter(|finding| finding.code.severity == Severity::Error);
        let others = errors.filter(|finding| first.is_none_or(|first| !std::ptr::eq(*finding, first)));
        let tally = diagnostics.tally();
        let spoiling = tally.iter().filter(|(code, _)| code.severity == Severity::Warning && code.harm == Harm::Spoils);
        Self {
            errors: diagnostics.count(Severity::Error),
            warnings: diagnostics.count(Severity::Warning),
            spoils: spoiling.map(|(_, count)| count).sum(),
            told: first.map(told).unwrap_or_default(),
            hint: first.and_then(|finding| finding.hints.first().cloned()).unwrap_or_default(),
            more: others.take(MOST_MORE).map(advised).collect(),
        }
    }
}

/// A message with its piece and its block.
fn told(finding: &Diagnostic) -> String {
    let piece = finding.piece.as_ref().map(ToString::to_string);
    let block = finding.span.filter(|span| span.block > 0).map(|span| format!("block {}", span.block));
    let place: Vec<String> = piece.into_iter().chain(block).collect();
    if place.is_empty() { finding.message.clone() } else { format!("{}: {}", place.join(", "), finding.message) }
}

/// A message with its code and its first hint.
fn advised(finding: &Diagnostic) -> String {
    let hint = finding.hints.first().map(|hint| format!("; {hint}"));
    format!("{} `{}`{}", told(finding), finding.code.name, hint.unwrap_or_default())
}

/// The code of the worst finding, for a row.
pub(in crate::cli) fn worst(diagnostics: &Diagnostics) -> Option<&'static str> {
    diagnostics.tally().first().map(|(code, _)| code.name)
}
