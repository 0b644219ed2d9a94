//! The verdict on a program: the rules of a machine, the worst that was seen under each, and whether all of them hold.
//!
//! Every machine has a table of its own rules, in the order in which they are told; all else is the same for all of them.

mod worst;

pub use worst::{Worst, WorstByRule};

use std::fmt;

use crate::geom::Point;

/// A promise that programs of a machine keep. Its identity is its address, as with the codes of diagnostics.
pub struct Rule {
    /// Stable name, `verify/kebab-case`.
    pub name: &'static str,
    /// Unit of its values, as it is shown; empty for counts.
    pub unit: &'static str,
    /// The promise itself, in a sentence.
    pub about: &'static str,
    /// Why it matters, and what to do: a line a paragraph, an indented line an example.
    pub more: &'static str,
    /// Whether it judges timed rows: of a program without them it says nothing.
    pub needs_time: bool,
    /// Whether it is on how something is cut or drilled: of a program that does neither it says nothing.
    pub needs_cut: bool,
    /// The key of the profile that is its limit and nothing else.
    pub key: Option<&'static str>,
    /// Its place in the table of its machine, from 0.
    pub place: usize,
}

impl Rule {
    /// A rule without words, on every program: what a row of a table leaves out is this.
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
        /// Places in the table, by the names of the rules.
        #[allow(non_camel_case_types, clippy::upper_case_acronyms)]
        enum Place { $($name),* }

        $(pub(crate) static $name: $crate::ir::verdict::Rule = $crate::ir::verdict::Rule {
            place: Place::$name as usize, $($field: $value,)* ..$crate::ir::verdict::Rule::PLAIN
        };)*

        /// Every rule, in the order of reports.
        pub static RULES: &[&$crate::ir::verdict::Rule] = &[$(&$name),*];
    };
}
pub(crate) use rules;

/// The worst that was seen under one rule; reported also when it is allowed.
#[derive(Debug, Clone, PartialEq)]
pub struct Finding {
    /// The rule.
    pub rule: &'static Rule,
    /// The worst value.
    pub worst: f64,
    /// The greatest value allowed; `None` when the rule is only reported.
    pub limit: Option<f64>,
    /// Unit of both: that of the rule, but where a form of programs has its own word for what is counted.
    pub unit: &'static str,
    /// Where the worst value was seen, if it has a place.
    pub place: Option<Sighting>,
}

impl Finding {
    /// Whether the worst value is allowed. A value that is not a number is not.
    pub fn holds(&self) -> bool {
        self.limit.is_none_or(|limit| self.worst <= limit)
    }
}

/// Where and when something was seen in a program.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sighting {
    /// The head, from 1, of a machine that has several; 0 = none.
    pub head: u32,
    /// Time in the program, s; `None` when the thing is missing from it, or it tells none.
    pub time: Option<f64>,
    /// Its line, the first being 1, or its record, where it has no lines; `None` when the thing is on none.
    pub line: Option<u64>,
    /// Place on the table, mm.
    pub point: Point,
    /// Number of the source block; 0 = none.
    pub block: u32,
}

impl Sighting {
    /// A place that no row of a program is about.
    pub fn missing(point: Point, block: u32) -> Self {
        Self { head: 0, time: None, line: None, point, block }
    }

    /// A place at a time of a program, s.
    pub fn at(time: f64, point: Point, block: u32) -> Self {
        Self { time: Some(time), ..Self::missing(point, block) }
    }
}

/// The worth of a program, or of all programs of a plan.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Verdict {
    /// The worst value under each rule that says something, in the order of the table of the machine's rules.
    pub findings: Vec<Finding>,
    /// The row or the file that cannot be read, and why. Nothing else is judged then: all that follows from a missing row
    /// would be wrong.
    pub unread: Option<String>,
    /// The pieces, by their place in the marker, of which the program cuts nothing although there is something to cut.
    pub uncut: Vec<u32>,
    /// Rules that say nothing about this program, because it tells no times.
    pub untimed: Vec<&'static Rule>,
}

impl Verdict {
    /// Whether every rule holds.
    pub fn passes(&self) -> bool {
        self.findings.iter().all(Finding::holds)
    }

    /// The findings that do not hold.
    pub fn broken(&self) -> impl Iterator<Item = &Finding> {
        self.findings.iter().filter(|finding| !finding.holds())
    }

    /// How many rules have a limit, and how many only report.
    pub fn counts(&self) -> (usize, usize) {
        counts(&self.findings)
    }

    /// The finding under a rule, if that says something.
    pub fn under(&self, rule: &Rule) -> Option<&Finding> {
        self.findings.iter().find(|finding| finding.rule == rule)
    }
}

/// How many findings have a limit, and how many are only reported.
pub fn counts(findings: &[Finding]) -> (usize, usize) {
    let limited = findings.iter().filter(|finding| finding.limit.is_some()).count();
    (limited, findings.len() - limited)
}

/// Brings findings of one machine into the order of its table of rules.
pub fn sort(findings: &mut [Finding]) {
    findings.sort_by_key(|finding| finding.rule.place);
}
