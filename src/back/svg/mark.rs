//! Marks of a picture: rings at the worst places under rules, and at the places of errors.

use crate::back::target::Outcome;
use crate::diagnostic::Diagnostic;
use crate::ir::verdict::{Finding, Sighting};
use crate::units::MM_PER_M;
use crate::units::number::fixed;

/// A ring and its line in the table: the worst value under a rule, or an error that prevented the program.
pub(super) struct Mark {
    /// Name of the rule, or code of the error.
    pub(super) name: &'static str,
    pub(super) holds: bool,
    /// Its values, and whether they are permitted.
    pub(super) verdict: String,
    pub(super) place: Option<Sighting>,
}

impl Mark {
    fn of_finding(finding: &Finding) -> Self {
        let unit = if finding.unit.is_empty() { String::new() } else { format!(" {}", finding.unit) };
        let value = |value: f64| format!("{}{unit}", shown(value));
        let verdict = match finding.limit {
            // An infinite value: something is missing.
            Some(_) if finding.worst.is_infinite() => "FAILS".to_owned(),
            None => format!("{} (no limit)", value(finding.worst)),
            Some(limit) if finding.holds() => format!("{}, limit {}: holds", value(finding.worst), value(limit)),
            Some(limit) => format!("{}, limit {}: FAILS", value(finding.worst), value(limit)),
        };
        Self { name: finding.rule.name, holds: finding.holds(), verdict, place: finding.place }
    }

    fn of_refusal(error: &Diagnostic) -> Self {
        let block = error.span.map_or(0, |span| span.block);
        let place = error.at.as_deref().map(|&at| Sighting::missing(at.into(), block));
        Self { name: error.code.name, holds: false, verdict: "FAILS".to_owned(), place }
    }
}

/// The marks of a picture: errors, failures, and findings whose worst place is on the cloth. An axis that reaches its limit
/// somewhere is not shown.
pub(super) fn marks(Outcome { findings, refusals, .. }: Outcome) -> Vec<Mark> {
    let on_the_cloth = |finding: &Finding| finding.place.is_some() && matches!(finding.unit, "mm" | "deg");
    let findings = findings.iter().filter(|finding| !finding.holds() || on_the_cloth(finding));
    refusals.iter().map(|error| Mark::of_refusal(error)).chain(findings.map(Mark::of_finding)).collect()
}

/// A value with decimals according to its size: limits range from micrometres to jerks of 1e6.
fn shown(value: f64) -> String {
    let decimals = match value.abs() {
        size if size == 0.0 || size >= MM_PER_M => 0,
        size if size >= 10.0 => 1,
        size if size >= 0.01 => 3,
        _ => 6,
    };
    fixed(value, decimals)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_value_is_shown_with_the_decimals_that_matter() {
        let values: Vec<String> = [0.0, 0.000_4, 0.05, 12.34, 199_999.6].into_iter().map(shown).collect();
        assert_eq!(values, ["0", "0.000400", "0.050", "12.3", "200000"]);
    }
}
