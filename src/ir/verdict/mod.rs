//! The verdict on a program: the rules of a machine, the worst value under each, and the overall result.
//!
//! Every machine has a table of its own rules, in the order of reports; everything else is shared.

mod worst;

pub use worst::{Worst, WorstByRule};

use std::fmt;

use crate::geom::Point;

/// A promise kept by the programs of a machine. Its identity is its address, as with the codes of diagnostics.
pub struct Rule {
    /// Stable name, `verify/kebab-case`.
    pub name: &'static str,
    /// Unit of its values for display; empty for counts.
    pub unit: &'static str,
    /// The promise in a sentence.
    pub about: &'static str,
    /// Explanation and advice: one paragraph per line, examples indented.
    pub more: &'static str,
    /// True if it judges timed rows; it does not apply to a program without them.
    pub needs_time: bool,
    /// True if it judges cutting or drilling; it does not apply to a program that does neither.
    pub needs_cut: bool,
    /// Key of the profile that only sets its limit; `None` when there is none.
    pub key: Option<&'static str>,
    /// Index in the table of its machine, from 0.
    pub place: usize,
}

impl Rule {
    /// The defaults for the fields that a table omits.
    pub const PLAIN: Self =
        Self { name: "", unit: "", about: "", more: "", needs_time: false, needs_cut: false, key: None, place: 0 };
}

impl PartialEq for Rule {
    fn eq(&self, other: &Self) -> bool {
        std::ptr::eq(self, other)
    }
}

impl Eq for Rule {}

impl fmt::Debug for Rule {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.name.fmt(f)
    }
}

/// Declares the rules of a machine, and the table of all of them in the order of reports.
macro_rules! rules {
    ($($name:ident { $($field:ident: $value:expr),* })*) => {
        /// Indices in the table, by the names of the rules.
        #[allow(non_camel_case_types, clippy::upper_case_acronyms)]
        enum Place { $($name),* }

        $(pub(crate) static $name: $crate::ir::verdict::Rule = $crate::ir::verdict::Rule {
            place: Place::$name as usize, $($field: $value,)* ..$crate::ir::verdict::Rule::PLAIN
        };)*

        /// All rules, in the order of reports.
        pub static RULES: &[&$crate::ir::verdict::Rule] = &[$(&$name),*];
    };
}
pub(crate) use rules;

/// The worst value seen under one rule; reported even when it is permitted.
#[derive(Debug, Clone, PartialEq)]
pub struct Finding {
    /// The rule.
    pub rule: &'static Rule,
    /// The worst value.
    pub worst: f64,
    /// Greatest permitted value; `None` when the rule only reports.
    pub limit: Option<f64>,
    /// Unit of both values: usually that of the rule; some program formats have their own word for the counted items.
    pub unit: &'static str,
    /// Sighting of the worst value; `None` when it has no place.
    pub place: Option<Sighting>,
}

impl Finding {
    /// True if the worst value is permitted; false for NaN.
    pub fn holds(&self) -> bool {
        self.limit.is_none_or(|limit| self.worst <= limit)
    }
}

/// Place and time of an observation in a program.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sighting {
    /// Head, from 1, of a machine with several; 0 = none.
    pub head: u32,
    /// Time in the program, s; `None` when the program lacks the item or has no times.
    pub time: Option<f64>,
    /// Line of the program, from 1, or record where it has no lines; `None` when there is none.
    pub line: Option<u64>,
    /// Position on the table, mm.
    pub point: Point,
    /// Number of the source block; 0 = none.
    pub block: u32,
}

impl Sighting {
    /// A place without a row of a program.
    pub fn missing(point: Point, block: u32) -> Self {
        Self { head: 0, time: None, line: None, point, block }
    }

    /// A place at a time of a program, s.
    pub fn at(time: f64, point: Point, block: u32) -> Self {
        Self { time: Some(time), ..Self::missing(point, block) }
    }
}

/// The judgement of a program, or of all programs of a plan.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Verdict {
    /// The worst value under each applicable rule, in the order of the machine's table.
    pub findings: Vec<Finding>,
    /// Message on a row or file that cannot be read. Nothing else is judged then, since everything derived from a missing row
    /// would be wrong.
    pub unread: Option<String>,
    /// Indices in the marker of the pieces with cuts of which the program cuts nothing.
    pub uncut: Vec<u32>,
    /// Rules that do not apply because the program has no times.
    pub untimed: Vec<&'static Rule>,
}

impl Verdict {
    /// True if every rule holds.
    pub fn passes(&self) -> bool {
        self.findings.iter().all(Finding::holds)
    }

    /// The findings that do not hold.
    pub fn broken(&self) -> impl Iterator<Item = &Finding> {
        self.findings.iter().filter(|finding| !finding.holds())
    }

    /// Number of rules with a limit, and number of rules that only report.
    pub fn counts(&self) -> (usize, usize) {
        counts(&self.findings)
    }

    /// The finding under a rule; `None` if the rule does not apply.
    pub fn under(&self, rule: &Rule) -> Option<&Finding> {
        self.findings.iter().find(|finding| finding.rule == rule)
    }
}

/// Number of findings with a limit, and number of those that only report.
pub fn counts(findings: &[Finding]) -> (usize, usize) {
    let limited = findings.iter().filter(|finding| finding.limit.is_some()).count();
    (limited, findings.len() - limited)
}

/// Sorts findings of one machine into the order of its table of rules.
pub fn sort(findings: &mut [Finding]) {
    findings.sort_by_key(|finding| finding.rule.place);
}
