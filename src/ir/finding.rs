//! What the verifier found, in a form that pictures and reports can show.

use crate::geom::Point;

/// The worst that was seen under one rule; reported also when it is allowed.
#[derive(Debug, Clone, PartialEq)]
pub struct Finding {
    /// Code of the rule, `verify/kebab-case`.
    pub rule: &'static str,
    /// The worst value.
    pub worst: f64,
    /// The greatest value allowed; `None` when the rule is only reported.
    pub limit: Option<f64>,
    /// Unit of both, as it is shown; empty for counts.
    pub unit: &'static str,
    /// Where the worst value was seen, if it has a place.
    pub place: Option<Sighting>,
}

/// Where and when something was seen in a program.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sighting {
    /// Time in the program, s; `None` when the thing is missing from it, or it tells none.
    pub time: Option<f64>,
    /// Its line, the first being 1, or its record, where it has no lines; `None` when the thing is on none.
    pub line: Option<u64>,
    /// Place on the table, mm.
    pub point: Point,
    /// Number of the source block; 0 = none.
    pub block: u32,
}

impl Finding {
    /// Whether the worst value is allowed. A value that is not a number is not.
    pub fn holds(&self) -> bool {
        self.limit.is_none_or(|limit| self.worst <= limit)
    }
}

/// How many findings have a limit, and how many are only reported.
pub fn counts(findings: &[Finding]) -> (usize, usize) {
    let limited = findings.iter().filter(|finding| finding.limit.is_some()).count();
    (limited, findings.len() - limited)
}

/// What is said of a rule of another machine's verifier.
#[derive(Debug)]
pub struct RuleRow<R> {
    /// The rule.
    pub rule: R,
    /// Its name, as findings bear it.
    pub name: &'static str,
    /// Unit of its value; empty for counts.
    pub unit: &'static str,
    /// What must hold.
    pub about: &'static str,
    /// Why it matters, and what to do.
    pub more: &'static str,
}
