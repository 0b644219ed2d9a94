//! Figures of a file as JSON: every key is present, null for unknown values.

use std::path::Path;

use serde::Serialize;

use super::options::counted;
use super::setup::{Profile, Setup};
use crate::diagnostic::{Code, Diagnostics, Json, Severity};
use crate::ir::{Finding, Marker};
use crate::machine::Job;
use crate::pipeline::Report;
use crate::source::Source;

#[derive(Serialize)]
struct Figures<T: Serialize> {
    #[serde(flatten)]
    setup: Setup,
    #[serde(flatten)]
    report: T,
    #[serde(flatten)]
    findings: Findings,
}

/// Diagnostics by severity.
#[derive(Serialize)]
pub(super) struct Findings {
    warnings: Vec<Json>,
    errors: Vec<Json>,
    /// Counts of all codes, the worst first: these are complete even if one code is too frequent to list.
    tally: Vec<Tally>,
}

/// A code and its count.
#[derive(Serialize)]
struct Tally {
    code: &'static str,
    severity: Severity,
    count: usize,
}

impl Findings {
    /// The findings about a source.
    pub(super) fn of(diagnostics: &Diagnostics, source: &Source) -> Self {
        let mut lines = source.lines();
        let mut of = |severity| {
            let of_severity = diagnostics.iter().filter(|finding| finding.code.severity == severity);
            of_severity.map(|finding| finding.to_json(source.name(), &mut lines)).collect()
        };
        let count = |(code, count): (&Code, usize)| Tally { code: code.name, severity: code.severity, count };
        let tally = diagnostics.tally().into_iter().map(count).collect();
        Self { warnings: of(Severity::Warning), errors: of(Severity::Error), tally }
    }
}

/// A report with its machine and the findings as one JSON object; without a report all its keys are null.
pub(super) fn json(report: Option<&Report>, diagnostics: &Diagnostics, source: &Source, job: &Job) -> String {
    match report {
        Some(report) => json_of(report, diagnostics, source, job),
        None => json_of(nothing(&Report::of(&Marker::default(), "")), diagnostics, source, job),
    }
}

/// A report with its machine and the findings as one of a list of JSON objects.
pub(super) fn json_of_file(
    file: &Path,
    report: Option<&Report>,
    diagnostics: &Diagnostics,
    source: &Source,
    job: &Job,
) -> String {
    #[derive(Serialize)]
    struct OfFile<T: Serialize> {
        file: String,
        #[serde(flatten)]
        figures: T,
    }
    let blank = || nothing(&Report::of(&Marker::default(), ""));
    let report = report.map_or_else(blank, |report| serde_json::to_value(report).expect("a report is plain data"));
    let figures = Figures { setup: Setup::of(job), report, findings: Findings::of(diagnostics, source) };
    pretty(&OfFile { file: file.display().to_string(), figures })
}

/// Any figures with the findings as one JSON object.
pub(super) fn json_of(figures: impl Serialize, diagnostics: &Diagnostics, source: &Source, job: &Job) -> String {
    pretty(&Figures { setup: Setup::of(job), report: figures, findings: Findings::of(diagnostics, source) })
}

/// Worst value that a verifier of another machine has seen under a rule, as JSON.
#[derive(Debug, Serialize)]
pub(super) struct WorstOf {
    code: &'static str,
    worst: f64,
    limit: Option<f64>,
    unit: &'static str,
}

impl From<&Finding> for WorstOf {
    fn from(finding: &Finding) -> Self {
        Self { code: finding.rule.name, worst: finding.worst, limit: finding.limit, unit: finding.unit }
    }
}

/// Line about a source with errors, of which no program was written.
pub(super) fn nothing_written(source: &Source, diagnostics: &Diagnostics) -> String {
    let [errors, warnings] = [(Severity::Error, "error"), (Severity::Warning, "warning")]
        .map(|(severity, word)| counted(diagnostics.count(severity), word));
    format!("{}: {errors}, {warnings}; no program was written\n", source.name())
}

/// Figures of another machine, with the profile and the findings, as one JSON object.
pub(super) fn json_by_profile(
    figures: impl Serialize,
    diagnostics: &Diagnostics,
    source: &Source,
    job: &Job,
) -> String {
    #[derive(Serialize)]
    struct Json<T: Serialize> {
        profile: Profile,
        #[serde(flatten)]
        figures: T,
        #[serde(flatten)]
        findings: Findings,
    }
    pretty(&Json { profile: Profile::of(job), figures, findings: Findings::of(diagnostics, source) })
}

/// The keys of some figures, all null.
pub(super) fn nothing(figures: &impl Serialize) -> serde_json::Value {
    let mut empty = serde_json::to_value(figures).expect("figures are plain data");
    for value in empty.as_object_mut().into_iter().flat_map(serde_json::Map::values_mut) {
        *value = serde_json::Value::Null;
    }
    empty
}

/// Indented JSON with a final line break.
pub(super) fn pretty(value: &impl Serialize) -> String {
    serde_json::to_string_pretty(value).expect("plain data with text keys") + "\n"
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagnostic::{Diagnostic, code};

    const KEYS: [&str; 28] = [
        "dialect",
        "profile",
        "knife",
        "unit_mm",
        "extent_mm",
        "pieces",
        "contours",
        "closed_contours",
        "notches",
        "drills",
        "labels",
        "cut_m",
        "declared",
        "travel_m",
        "runs",
        "stabs",
        "lifts",
        "time_s",
        "spent",
        "savings",
        "axes",
        "warnings",
        "errors",
        "tally",
        "sides",
        "notch_style",
        "follow",
        "tangent_runs",
    ];

    #[test]
    fn every_key_is_there_whether_known_or_not() {
        let source = Source::new("a.cut", Vec::new()).expect("small");
        let mut found = Diagnostics::default();
        found.push(Diagnostic::new(&code::SOURCE_EMPTY, "the file holds nothing"));
        let report = Report::of(&Marker::default(), "iso");
        for report in [Some(&report), None] {
            let text = json(report, &found, &source, &Job::default());
            let value: serde_json::Value = serde_json::from_str(&text).expect("JSON");
            let mut keys: Vec<_> = value.as_object().expect("an object").keys().map(String::as_str).collect();
            let mut expected = KEYS;
            keys.sort_unstable();
            expected.sort_unstable();
            assert_eq!(keys, expected);
            assert_eq!(value["errors"][0]["code"], "source/empty");
            assert!(value["time_s"].is_null());
        }
    }
}
