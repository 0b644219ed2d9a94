//! What a program is worth: the worst value under every rule.

use super::rules::RULES;
use crate::ir::{Finding, finding};

/// What a program is worth.
#[derive(Debug, Clone, PartialEq)]
pub struct Verdict {
    /// The worst value under each rule, in the order of [`RULES`].
    pub findings: Vec<Finding>,
    /// What cannot be read, when something cannot: then nothing is said about what the program does, since all that
    /// follows from a row that is missing would be wrong.
    pub unread: Option<String>,
    /// The pieces, by their place in the marker, of which the program cuts nothing although there is something to cut.
    pub uncut: Vec<u32>,
    /// Rules that say nothing about this program, because it tells no times.
    pub untimed: Vec<&'static str>,
}

impl Verdict {
    /// Whether every rule holds.
    pub fn passes(&self) -> bool {
        self.findings.iter().all(Finding::holds)
    }

    /// How many rules have a limit, and how many only report.
    pub fn counts(&self) -> (usize, usize) {
        finding::counts(&self.findings)
    }

    /// Whether the program was held against what it declares, and not as a cut file.
    pub fn asks_declarations(&self) -> bool {
        self.findings.iter().any(|finding| finding.rule == "verify/declared")
    }

    /// The findings that do not hold.
    pub fn broken(&self) -> impl Iterator<Item = &Finding> {
        self.findings.iter().filter(|finding| !finding.holds())
    }
}

/// Brings findings into the order of [`RULES`].
pub fn sort(findings: &mut [Finding]) {
    let place = |finding: &Finding| RULES.iter().position(|rule| rule.name == finding.rule);
    findings.sort_by_key(|finding| place(finding).expect("every rule stands in the table"));
}
