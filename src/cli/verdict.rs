//! Verdict as a table for people and as JSON for programs.

use std::path::Path;

use serde::Serialize;

use super::explain::wrapped;
use super::finished::say;
use super::options::counted;
use super::report::pretty;
use crate::diagnostic::PieceName;
use crate::ir::Finding;
use crate::ir::verdict::Rule;
use crate::machine::Mode;
use crate::pipeline::{self, Explained, Line, Told};
use crate::units::number::fixed;

/// Significant digits of worst values and limits in JSON.
const DIGITS: i32 = 9;
/// Numeric columns, which are aligned to the right.
const RIGHT: [bool; 9] = [false, false, true, true, false, true, true, true, true];

/// Maximum number of pieces to name; the rest are counted.
const MOST_PIECES: usize = 5;
/// Maximum columns of the text on a broken rule, and its indentation.
const COLUMNS: usize = 94;
const INDENT: &str = "      ";
/// Number of unjudged rules per line.
const RULES_A_LINE: usize = 4;

/// A verdict as JSON.
#[derive(Serialize)]
struct Judged {
    verdict: Word,
    /// Rules in the order of reports; empty if the source has errors.
    rules: Vec<UnderRule>,
    /// Rows that cannot be read; absent if all can.
    #[serde(skip_serializing_if = "Option::is_none")]
    unread: Option<String>,
    /// Rules on times that a program without times leaves unjudged; absent if there are none.
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
struct UnderRule {
    code: &'static str,
    /// Null if no number measures the fault, as for a missing hole.
    worst: Option<f64>,
    /// Null if the value is only reported.
    limit: Option<f64>,
    unit: &'static str,
    r#where: Option<Where>,
    holds: bool,
    /// For a broken rule, the piece at the worst value; absent if there is none.
    #[serde(skip_serializing_if = "Option::is_none")]
    piece: Option<Named>,
    /// For a broken rule, the pieces that are not cut at all; absent if there are none.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    uncut: Vec<Named>,
    /// For a broken rule, the text of the line of the program; absent if the program has no lines.
    #[serde(skip_serializing_if = "Option::is_none")]
    text: Option<String>,
}

/// A piece.
#[derive(Serialize)]
struct Named {
    number: u32,
    /// Absent if there is only one copy.
    #[serde(skip_serializing_if = "Option::is_none")]
    copy: Option<u32>,
    #[serde(skip_serializing_if = "Option::is_none")]
    label: Option<String>,
}

impl Named {
    fn of(name: &PieceName) -> Self {
        let copy = Some(name.copy).filter(|&copy| copy > 0);
        Self { number: name.number, copy, label: name.label.clone() }
    }
}

/// Place of the worst value.
#[derive(Serialize)]
struct Where {
    /// Null for something that is missing from the program.
    time_s: Option<f64>,
    /// Number of the head, from 1; absent in a program without heads.
    #[serde(skip_serializing_if = "Option::is_none")]
    head: Option<u32>,
    /// Line of the program, from 1. Programs without lines have the record, from 0; those of heads the row, from 1; those that
    /// are sewn the entry, from 1. Null if the value is at none of these.
    line: Option<u64>,
    x_mm: f64,
    y_mm: f64,
    /// Number of the source block; 0 if there is none.
    block: u32,
}

/// The verdict as JSON. Without a verdict, as when the source has errors, the program fails and no rules are listed.
pub(super) fn json(explained: Option<&Explained>) -> String {
    pretty(&Judged::of(explained))
}

/// The verdict on one program as an element of a list of JSON objects.
pub(super) fn json_of(program: &Path, explained: Option<&Explained>) -> String {
    #[derive(Serialize)]
    struct OfProgram {
        program: String,
        #[serde(flatten)]
        judged: Judged,
    }
    pretty(&OfProgram { program: program.display().to_string(), judged: Judged::of(explained) })
}

impl Judged {
    fn of(explained: Option<&Explained>) -> Self {
        let rule = |(finding, told): (&Finding, Option<&Told>)| UnderRule {
            code: finding.rule.name,
            worst: finding.worst.is_finite().then(|| pipeline::significant(finding.worst, DIGITS)),
            limit: finding.limit.map(|limit| pipeline::significant(limit, DIGITS)),
            unit: finding.unit,
            r#where: finding.place.map(|place| Where {
                time_s: place.time.map(|time| pipeline::significant(time, DIGITS)),
                head: Some(place.head).filter(|&head| head > 0),
                line: place.line,
                x_mm: pipeline::significant(place.point.x, DIGITS),
                y_mm: pipeline::significant(place.point.y, DIGITS),
                block: place.block,
            }),
            holds: finding.holds(),
            piece: told.and_then(|told| told.piece.as_ref()).map(Named::of),
            uncut: told.map_or_else(Vec::new, |told| told.uncut.iter().map(Named::of).collect()),
            text: told.and_then(|told| match &told.line {
                Some(Line::Text { text, .. }) => Some(text.clone()),
                Some(Line::Record(_) | Line::Row { .. } | Line::Entry(_)) | None => None,
            }),
        };
        let verdict = explained.map(|explained| &explained.verdict);
        let passes = verdict.is_some_and(pipeline::Verdict::passes);
        Self {
            verdict: if passes { Word::Pass } else { Word::Fail },
            rules: explained.map_or_else(Vec::new, |explained| explained.findings().map(rule).collect()),
            unread: verdict.and_then(|verdict| verdict.unread.clone()),
            untimed: verdict.map_or_else(Vec::new, |verdict| verdict.untimed.iter().map(|rule| rule.name).collect()),
        }
    }
}

/// Cells of a row of the table: mark, rule, worst, limit, unit, time, x, y, block.
type Cells = [String; 9];

/// A verdict and its subject.
#[derive(Debug, Clone, Copy)]
pub(super) struct Judgement<'a> {
    pub(super) explained: &'a Explained,
    pub(super) mode: Mode,
    /// Work of the machine, as a verb.
    pub(super) works: &'static str,
    /// Name of the program.
    pub(super) program: &'a str,
    /// Name of the cutter file.
    pub(super) source: &'a str,
}

/// The verdict as a table: rules that hold, then broken ones, then a line with the result.
pub(super) fn text(judgement: &Judgement) -> String {
    let Judgement { explained: Explained { verdict, told }, mode, works, program, source } = *judgement;
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
        if let Some((finding, told)) = i.checked_sub(first_broken).map(|i| (broken[i], &told[i])) {
            explain(finding.rule, told, &mut out);
        }
    }
    if let Some(unread) = &verdict.unread {
        say(&mut out, format_args!("\n{unread}\nNothing was judged that needs all rows: mend them first."));
    }
    if !verdict.untimed.is_empty() {
        say(&mut out, format_args!("\nnot judged, because the program tells no times:"));
        for rules in verdict.untimed.chunks(RULES_A_LINE) {
            let names: Vec<&str> = rules.iter().map(|rule| rule.name).collect();
            say(&mut out, format_args!("      {}", names.join(" ")));
        }
    }
    let (limited, reported) = verdict.counts();
    let total = counted(limited, "rule");
    let besides = if reported == 0 { String::new() } else { format!("{reported} without a limit, ") };
    if broken.is_empty() {
        let is = match mode {
            Mode::Cut => format!("{works} what `{source}` says"),
            Mode::Dry | Mode::Frame => "moves within the limits and works on nothing".to_owned(),
        };
        say(&mut out, format_args!("\nPASS  `{program}` {is}: {besides}{total} hold"));
    } else {
        let count = broken.len();
        say(&mut out, format_args!("\nFAIL  `{program}` must not run: it breaks {count} of {total}"));
    }
    out
}

/// Appends the explanation of a broken rule: its meaning, its place, and the remedy.
fn explain(rule: &Rule, told: &Told, out: &mut String) {
    let mut lines = vec![format!("the rule: {}", rule.about)];
    if !told.uncut.is_empty() {
        let names: Vec<String> = told.uncut.iter().take(MOST_PIECES).map(ToString::to_string).collect();
        let more = told.uncut.len().saturating_sub(MOST_PIECES);
        let more = if more == 0 { String::new() } else { format!(" and {more} more") };
        lines.push(format!("not cut at all: {}{more}", names.join(", ")));
    }
    if let Some(piece) = told.piece.as_ref().filter(|piece| !told.uncut.contains(piece)) {
        lines.push(format!("the place: {piece}"));
    }
    match &told.line {
        Some(Line::Text { number, text }) => lines.push(format!("line {number} of the program: {text}")),
        Some(Line::Record(number)) => lines.push(format!("record {number} of the program")),
        Some(Line::Row { head, number }) => lines.push(format!("row {number} of head {head}")),
        Some(Line::Entry(number)) => lines.push(format!("entry {number} of the program")),
        None => {}
    }
    lines.push(format!("what to do: {}", rule.more));
    for line in lines {
        for part in wrapped(&line, COLUMNS).lines() {
            say(out, format_args!("{INDENT}{part}"));
        }
    }
}

fn cells(finding: &Finding) -> Cells {
    let (worst, limit) = pipeline::figures(finding);
    let mark = match (finding.holds(), finding.limit) {
        (false, _) => "FAIL",
        (true, Some(_)) => "ok",
        (true, None) => "info",
    };
    // The place of a zero is of no use.
    let place = finding.place.filter(|_| worst != "0");
    [
        mark.to_owned(),
        finding.rule.name.to_owned(),
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
    use crate::ir::verdict::Sighting;
    use crate::pipeline::{Verdict, rules};

    fn explained() -> Explained {
        let at = |time, x, block| Some(Sighting { time, ..Sighting::missing([x, 20.0].into(), block) });
        let finding = |rule: &'static Rule, worst, limit, place| Finding { rule, worst, limit, unit: rule.unit, place };
        let verdict = Verdict {
            findings: vec![
                finding(&rules::FORMAT, 0.0, Some(0.0), None),
                finding(&rules::END, 0.0, Some(1e-6), at(Some(1.5), 10.0, 0)),
                finding(&rules::ACCELERATION_X, 8123.456, Some(8012.0), at(Some(12.345), 1695.377, 268)),
                finding(&rules::COMPLETE, f64::INFINITY, Some(0.01), at(None, 5.0, 7)),
                finding(&rules::OVERCUT_NEIGHBOUR, 1.0 / 3.0, None, at(Some(80.0), 0.0, 9)),
            ],
            unread: None,
            uncut: vec![2],
            untimed: Vec::new(),
        };
        let front = || PieceName { number: 4, copy: 0, label: Some("FRONT".to_owned()) };
        let text = "12.345,1695.377,20.000,0.000,1,0,0,268".to_owned();
        let told = vec![
            Told { piece: Some(front()), uncut: Vec::new(), line: Some(Line::Text { number: 12_347, text }) },
            Told { piece: None, uncut: vec![front()], line: None },
        ];
        Explained { verdict, told }
    }

    #[test]
    fn what_is_broken_stands_last_and_marked() {
        let explained = explained();
        let text = text(&Judgement {
            explained: &explained,
            mode: Mode::Cut,
            works: "cuts",
            program: "a.csv",
            source: "a.cut",
        });
        assert!(text.lines().all(|line| line.len() <= 100), "{text}");
        insta::assert_snapshot!(text, @r#"
              rule                         worst     limit  unit        at s    X mm  Y mm  block
        ok    verify/format                    0         0  bad rows
        ok    verify/end                       0  0.000001  mm, deg
        info  verify/overcut-neighbour    0.3334      none  mm        80.000     0.0  20.0      9

        FAIL  verify/acceleration-x         8124      8012  mm/s2     12.345  1695.4  20.0    268
              the rule: X never accelerates more than its limit
              the place: piece 4 "FRONT"
              line 12347 of the program: 12.345,1695.377,20.000,0.000,1,0,0,268
              what to do: Too much force makes the drive slip or trip, and the rest of the lay is cut
              displaced. Check axes.x.acceleration_mm_s2.
        FAIL  verify/complete           infinite      0.01  mm                   5.0  20.0      7
              the rule: no stretch of a contour or slit is left uncut
              not cut at all: piece 4 "FRONT"
              what to do: A stretch left uncut holds the part in the cloth, and it is torn when lifted off.
              The allowance is verify.max_uncut_mm, what rounding can leave.

        FAIL  `a.csv` must not run: it breaks 2 of 4 rules
        "#);
    }

    #[test]
    fn a_verdict_is_valid_json_even_beyond_measure() {
        let value: serde_json::Value = serde_json::from_str(&json(Some(&explained()))).expect("JSON");
        assert_eq!(value["verdict"], "fail");
        let rules = value["rules"].as_array().expect("a list");
        assert_eq!(rules.len(), 5);
        assert!(rules[0]["where"].is_null() && rules[3]["worst"].is_null() && rules[4]["limit"].is_null());
        assert!(rules[2]["holds"] == false && rules[2]["piece"]["number"] == 4);
        assert_eq!(rules[3]["uncut"][0]["label"], "FRONT");
        assert_eq!(
            rules[2]["where"].to_string(),
            r#"{"block":268,"line":null,"time_s":12.345,"x_mm":1695.377,"y_mm":20.0}"#
        );
        assert!(rules[3]["where"]["time_s"].is_null() && rules[1]["holds"] == true);
        assert_eq!(rules[4]["worst"].to_string(), "0.333333333");
        let unread: serde_json::Value = serde_json::from_str(&json(None)).expect("JSON");
        assert_eq!(unread.to_string(), r#"{"rules":[],"verdict":"fail"}"#);
    }
}
