//! A verdict as a table for people and as JSON for programs.

use std::path::Path;

use serde::Serialize;

use super::finished::say;
use super::options::counted;
use super::report::pretty;
use crate::ir::Finding;
use crate::machine::Mode;
use crate::pipeline::{self, Verdict};
use crate::units::number::fixed;

/// Significant digits of worst values and limits in JSON.
const DIGITS: i32 = 9;
/// The columns of numbers, which stand at the right.
const RIGHT: [bool; 9] = [false, false, true, true, false, true, true, true, true];

/// Rules that are not judged, so many a line.
const RULES_A_LINE: usize = 4;

/// A verdict as JSON.
#[derive(Serialize)]
struct Judged {
    verdict: Word,
    /// In the order of reports; none when the source has errors.
    rules: Vec<Rule>,
    /// Which rows cannot be read; not there when all can.
    #[serde(skip_serializing_if = "Option::is_none")]
    unread: Option<String>,
    /// Rules on times, of a program that tells none; not there when all are judged.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    untimed: Vec<&'static str>,
}

#[derive(Serialize)]
#[serde(rename_all = "lowercase")]
enum Word {
    Pass,
    Fail,
}

/// The worst value under one rule.
#[derive(Serialize)]
struct Rule {
    code: &'static str,
    /// Null when no number says how bad it is, as for a hole that is missing.
    worst: Option<f64>,
    /// Null when the value is only reported.
    limit: Option<f64>,
    unit: &'static str,
    r#where: Option<Where>,
    holds: bool,
}

/// Where the worst value was seen.
#[derive(Serialize)]
struct Where {
    /// Null for what is missing from the program.
    time_s: Option<f64>,
    x_mm: f64,
    y_mm: f64,
    /// Number of the source block; 0 = none.
    block: u32,
}

/// The verdict as JSON; a program whose source has errors is proven by nothing: it fails, without rules.
pub(super) fn json(verdict: Option<&Verdict>) -> String {
    pretty(&Judged::of(verdict))
}

/// The same as one of a list of JSON objects.
pub(super) fn json_of(program: &Path, verdict: Option<&Verdict>) -> String {
    #[derive(Serialize)]
    struct OfProgram {
        program: String,
        #[serde(flatten)]
        judged: Judged,
    }
    pretty(&OfProgram { program: program.display().to_string(), judged: Judged::of(verdict) })
}

impl Judged {
    fn of(verdict: Option<&Verdict>) -> Self {
        let rule = |finding: &Finding| Rule {
            code: finding.rule,
            worst: finding.worst.is_finite().then(|| pipeline::significant(finding.worst, DIGITS)),
            limit: finding.limit.map(|limit| pipeline::significant(limit, DIGITS)),
            unit: finding.unit,
            r#where: finding.place.map(|place| Where {
                time_s: place.time.map(|time| pipeline::significant(time, DIGITS)),
                x_mm: pipeline::significant(place.point.x, DIGITS),
                y_mm: pipeline::significant(place.point.y, DIGITS),
                block: place.block,
            }),
            holds: finding.holds(),
        };
        let passes = verdict.is_some_and(Verdict::passes);
        Self {
            verdict: if passes { Word::Pass } else { Word::Fail },
            rules: verdict.map_or_else(Vec::new, |verdict| verdict.findings.iter().map(rule).collect()),
            unread: verdict.and_then(|verdict| verdict.unread.clone()),
            untimed: verdict.map_or_else(Vec::new, |verdict| verdict.untimed.clone()),
        }
    }
}

/// A row of the table: mark, rule, worst, limit, unit, time, x, y, block.
type Cells = [String; 9];

/// A verdict, and what it is about.
#[derive(Debug, Clone, Copy)]
pub(super) struct Judgement<'a> {
    pub(super) verdict: &'a Verdict,
    pub(super) mode: Mode,
    /// Name of the program.
    pub(super) program: &'a str,
    /// Name of the cutter file.
    pub(super) source: &'a str,
}

/// The verdict as a table: what holds, then what is broken, then one line that says it all.
pub(super) fn text(judgement: &Judgement) -> String {
    let Judgement { verdict, mode, program, source } = *judgement;
    let broken: Vec<_> = verdict.broken().collect();
    let holding = verdict.findings.iter().filter(|finding| finding.holds());
    let titles = ["", "rule", "worst", "limit", "unit", "at s", "X mm", "Y mm", "block"].map(str::to_owned);
    let rows: Vec<Cells> = std::iter::once(titles).chain(holding.chain(broken.iter().copied()).map(cells)).collect();
    let widths: [usize; 9] =
        std::array::from_fn(|column| rows.iter().map(|row| row[column].len()).max().unwrap_or_default());
    let first_broken = rows.len() - broken.len();
    let mut out = String::new();
    for (i, row) in rows.iter().enumerate() {
        if i == first_broken {
            out.push('\n');
        }
        say(&mut out, format_args!("{}", aligned(row, &widths)));
        if let Some(finding) = i.checked_sub(first_broken).map(|i| broken[i]) {
            say(&mut out, format_args!("      the rule: {}", pipeline::about(finding.rule)));
        }
    }
    if let Some(unread) = &verdict.unread {
        say(&mut out, format_args!("\n{unread}\nNothing was judged that needs all rows: mend them first."));
    }
    if !verdict.untimed.is_empty() {
        say(&mut out, format_args!("\nnot judged, because the program tells no times:"));
        for rules in verdict.untimed.chunks(RULES_A_LINE) {
            say(&mut out, format_args!("      {}", rules.join(" ")));
        }
    }
    let (limited, reported) = verdict.counts();
    let total = counted(limited, "rule");
    let besides = if reported == 0 { String::new() } else { format!("{reported} without a limit, ") };
    if broken.is_empty() {
        let is = match mode {
            Mode::Cut => format!("cuts what `{source}` says"),
            Mode::Dry | Mode::Frame => "moves within the limits and keeps the knife up".to_owned(),
        };
        say(&mut out, format_args!("\nPASS  `{program}` {is}: {besides}{total} hold"));
    } else {
        let count = broken.len();
        say(&mut out, format_args!("\nFAIL  `{program}` must not run: it breaks {count} of {total}"));
    }
    out
}

fn cells(finding: &Finding) -> Cells {
    let (worst, limit) = pipeline::figures(finding);
    let mark = match (finding.holds(), finding.limit) {
        (false, _) => "FAIL",
        (true, Some(_)) => "ok",
        (true, None) => "info",
    };
    // The place of a zero is of no use to anybody.
    let place = finding.place.filter(|_| worst != "0");
    [
        mark.to_owned(),
        finding.rule.to_owned(),
        worst,
        limit.unwrap_or_else(|| "none".to_owned()),
        finding.unit.to_owned(),
        place.and_then(|place| place.time).map_or_else(String::new, |time| fixed(time, 3)),
        place.map_or_else(String::new, |place| fixed(place.point.x, 1)),
        place.map_or_else(String::new, |place| fixed(place.point.y, 1)),
        place.filter(|place| place.block > 0).map_or_else(String::new, |place| place.block.to_string()),
    ]
}

fn aligned(row: &Cells, widths: &[usize; 9]) -> String {
    let cell = |column: usize| {
        let (text, width) = (&row[column], widths[column]);
        if RIGHT[column] { format!("{text:>width$}") } else { format!("{text:width$}") }
    };
    let cells: Vec<_> = (0..row.len()).map(cell).collect();
    cells.join("  ").trim_end().to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ir::finding::Sighting;

    fn verdict() -> Verdict {
        let at = |time, x, block| Some(Sighting { time, point: [x, 20.0].into(), block });
        let finding = |rule, worst, limit, unit, place| Finding { rule, worst, limit, unit, place };
        Verdict {
            findings: vec![
                finding("verify/format", 0.0, Some(0.0), "bad rows", None),
                finding("verify/end", f64::INFINITY, Some(1e-6), "mm, deg", at(Some(1.5), 10.0, 0)),
                finding("verify/acceleration-x", 8123.456, Some(8012.0), "mm/s2", at(Some(12.345), 1695.377, 268)),
                finding("verify/complete", 0.000_12, Some(0.01), "mm", at(None, 5.0, 7)),
                finding("verify/overcut-neighbour", 1.0 / 3.0, None, "mm", at(Some(80.0), 0.0, 9)),
            ],
            unread: None,
            untimed: Vec::new(),
        }
    }

    #[test]
    fn what_is_broken_stands_last_and_marked() {
        let verdict = verdict();
        let text = text(&Judgement { verdict: &verdict, mode: Mode::Cut, program: "a.csv", source: "a.cut" });
        assert!(text.lines().all(|line| line.len() <= 100), "{text}");
        insta::assert_snapshot!(text, @r"
              rule                         worst     limit  unit        at s    X mm  Y mm  block
        ok    verify/format                    0         0  bad rows
        ok    verify/complete            0.00012      0.01  mm                   5.0  20.0      7
        info  verify/overcut-neighbour    0.3334      none  mm        80.000     0.0  20.0      9

        FAIL  verify/end                infinite  0.000001  mm, deg    1.500    10.0  20.0
              the rule: the program ends with knife and drill up, and parked if the profile says so
        FAIL  verify/acceleration-x         8124      8012  mm/s2     12.345  1695.4  20.0    268
              the rule: X never accelerates more than its limit

        FAIL  `a.csv` must not run: it breaks 2 of 4 rules
        ");
    }

    #[test]
    fn a_verdict_is_valid_json_even_beyond_measure() {
        let value: serde_json::Value = serde_json::from_str(&json(Some(&verdict()))).expect("JSON");
        assert_eq!(value["verdict"], "fail");
        let rules = value["rules"].as_array().expect("a list");
        assert_eq!(rules.len(), 5);
        assert!(rules[0]["where"].is_null() && rules[1]["worst"].is_null() && rules[4]["limit"].is_null());
        assert_eq!(rules[1]["holds"], false);
        assert_eq!(rules[2]["where"].to_string(), r#"{"block":268,"time_s":12.345,"x_mm":1695.377,"y_mm":20.0}"#);
        assert!(rules[3]["where"]["time_s"].is_null() && rules[3]["holds"] == true);
        assert_eq!(rules[4]["worst"].to_string(), "0.333333333");
        let unread: serde_json::Value = serde_json::from_str(&json(None)).expect("JSON");
        assert_eq!(unread.to_string(), r#"{"rules":[],"verdict":"fail"}"#);
    }
}
