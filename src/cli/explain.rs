//! `cutc explain`: what a code means, why it matters and what to do.

use std::fmt::Write as _;

use clap::Args;

use super::explanations::EXPLANATIONS;
use super::{DONE, Finished, failure};
use crate::diagnostic::{Severity, code};
use crate::machine::MachineProfile;
use crate::machine::keys::{self, KEYS, Key};
use crate::pipeline::RULES;

/// Columns of an explanation.
const COLUMNS: usize = 80;
/// Likeness from which a name may have been meant, of 1: two swapped letters or a wrong ending are above it.
const LEAST_LIKENESS: f64 = 0.8;
/// Letters of an instruction of a plot.
const MNEMONIC_LETTERS: usize = 2;
/// Where the codes of cut files are explained.
const README: &str = include_str!("../../README.md");
/// The heading above their table.
const CODES_OF_FILES: &str = "Codes of ISO cut files";

/// Arguments of `cutc explain`.
#[derive(Debug, Args)]
pub(super) struct Arguments {
    /// A code as messages show it, `iso/open-slit`, a rule of the verifier, `verify/on-path`, a code of cut files, `M19`, or
    /// a key of the profile, `knife.width_mm`
    code: Option<String>,
}

/// A code or a rule: name, what kind it is, what it says in a sentence.
type Topic = (&'static str, &'static str, &'static str);

/// Every code, then every rule.
fn topics() -> impl Iterator<Item = Topic> {
    let codes = code::ALL.iter().map(|code| (code.name, severity(code.severity), code.about));
    codes.chain(RULES.iter().map(|&(name, about)| (name, "rule", about)))
}

fn severity(severity: Severity) -> &'static str {
    match severity {
        Severity::Error => "error",
        Severity::Warning => "warning",
    }
}

pub(super) fn run(arguments: &Arguments) -> anyhow::Result<Finished> {
    let Some(asked) = &arguments.code else { return Ok(Finished::text(list(), String::new(), DONE)) };
    if let Some(topic) = topics().find(|(name, _, _)| name == asked) {
        return Ok(Finished::text(explained(topic), String::new(), DONE));
    }
    if let Some(text) = code_of_files(asked).or_else(|| Some(key_text(keys::find(asked)?))) {
        return Ok(Finished::text(text, String::new(), DONE));
    }
    Err(failure(format!("there is no code `{asked}`"), hint(asked)))
}

/// What else may have been meant. A family of keys (`codes.<code>`) is like everything, and is no name.
fn hint(asked: &str) -> String {
    if asked.len() == MNEMONIC_LETTERS && asked.bytes().all(|byte| byte.is_ascii_alphabetic()) {
        return "README has the instructions of plots (HPGL); `cutc explain` lists all codes".to_owned();
    }
    let likeness = |name: &str| strsim::jaro_winkler(name, asked);
    let keys = KEYS.iter().map(|key| key.name).filter(|name| !name.contains('<'));
    let near = topics().map(|topic| topic.0).chain(keys).filter(|name| likeness(name) >= LEAST_LIKENESS);
    let nearest = near.max_by(|a, b| likeness(a).total_cmp(&likeness(b)));
    let guess = nearest.map_or_else(String::new, |name| format!("did you mean `{name}`? "));
    format!("{guess}`cutc explain` lists them all")
}

/// A code of cut files by letter and number, as `M014` or `n`; `None` when it is none.
fn letter_and_number(word: &str) -> Option<(char, Option<u32>)> {
    let letter = word.chars().next().filter(char::is_ascii_alphabetic)?.to_ascii_uppercase();
    let digits = &word[1..];
    let number = if digits.is_empty() { None } else { Some(digits.parse().ok()?) };
    Some((letter, number))
}

/// What README's table says about a code of cut files.
fn code_of_files(asked: &str) -> Option<String> {
    let asked = letter_and_number(asked)?;
    let section = README.split_once(CODES_OF_FILES)?.1.split("\n#").next()?;
    let rows = section.lines().filter_map(|line| line.strip_prefix("| ")?.strip_suffix(" |")?.split_once(" | "));
    let named = |codes: &str| {
        let words: Vec<_> = codes.split('`').skip(1).step_by(2).filter_map(letter_and_number).collect();
        let within = |first, last| first <= asked && asked <= last;
        words.contains(&asked) || codes.contains(" to ") && words.len() == 2 && within(words[0], words[1])
    };
    let told: Vec<String> =
        rows.filter(|(codes, _)| named(codes)).map(|(codes, about)| row_text(codes, about)).collect();
    let ((letter, number), switch) = (asked, "The profile can switch a code off:");
    let code = number.map_or_else(|| letter.to_string(), |number| format!("{letter}{number:02}"));
    let kind = "code of ISO cut files; README has all of them";
    (!told.is_empty())
        .then(|| format!("{code}\n{kind}\n\n{}\n\n{switch}\n  codes.{code} = \"ignore\"\n", told.join("\n")))
}

/// What a key of the profile means, what it takes, and what it is when nothing is said.
fn key_text(key: &Key) -> String {
    let table =
        toml::Value::try_from(MachineProfile::default()).expect("a profile holds numbers, words and named tables");
    let default = key.name.split('.').try_fold(&table, |inner, part| inner.get(part));
    let default = default.map_or_else(String::new, |value| format!(" Its default is {}.", keys::shown_value(value)));
    let takes = format!("It must be {}.{default}", key.expects());
    format!(
        "{}\nkey of the profile\n\n{}\n\n{}\n",
        key.name,
        wrapped(&key.about.replace('\n', " "), COLUMNS),
        wrapped(&takes, COLUMNS)
    )
}

/// A row of README's table as a paragraph.
fn row_text(codes: &str, about: &str) -> String {
    wrapped(&format!("{codes}: {}", sentence(about)), COLUMNS)
}

fn list() -> String {
    let width = topics().map(|topic| topic.0.len()).max().unwrap_or(0);
    let mut out = String::new();
    for (name, kind, about) in topics() {
        // Writing into a `String` cannot fail.
        let _ = writeln!(out, "{name:width$}  {kind:7}  {about}");
    }
    out
}

/// What follows from a kind of finding.
fn consequence(kind: &str) -> &'static str {
    match kind {
        "error" => "error: no program is written",
        "warning" => "warning: a program is written; somebody should look",
        _ => "rule of the verifier: a program that breaks it is not written",
    }
}

fn explained((name, kind, about): Topic) -> String {
    let more = EXPLANATIONS.iter().find(|(code, _)| *code == name).map_or("", |(_, text)| text);
    format!("{name}\n{}\n\n{}\n\n{}\n", consequence(kind), wrapped(&sentence(about), COLUMNS), paragraphs(more))
}

/// Rules are said in lower case without a full stop, codes as sentences.
fn sentence(about: &str) -> String {
    let mut letters = about.chars();
    let first: String = letters.next().into_iter().flat_map(char::to_uppercase).collect();
    format!("{first}{}{}", letters.as_str(), if about.ends_with('.') { "" } else { "." })
}

/// Paragraphs stand on a line each; an indented line is an example and stays as it is.
fn paragraphs(text: &str) -> String {
    let paragraph = |line: &str| if line.starts_with(' ') { line.to_owned() } else { wrapped(line, COLUMNS) };
    text.lines().map(paragraph).collect::<Vec<_>>().join("\n")
}

/// A text in lines of so many columns.
pub(super) fn wrapped(text: &str, columns: usize) -> String {
    let mut out = String::new();
    let mut column = 0;
    for word in text.split(' ') {
        let width = word.chars().count();
        if column > 0 && column + 1 + width > columns {
            out.push('\n');
            column = 0;
        } else if column > 0 {
            out.push(' ');
            column += 1;
        }
        out.push_str(word);
        column += width;
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_code_and_rule_is_explained_once() {
        let count = |name: &str| EXPLANATIONS.iter().filter(|(code, _)| *code == name).count();
        let wrong: Vec<_> = topics().map(|topic| topic.0).filter(|name| count(name) != 1).collect();
        assert!(wrong.is_empty(), "EXPLANATIONS must have one row for each of {wrong:?}");
    }

    #[test]
    fn a_code_of_cut_files_is_explained_by_its_row() {
        let check = |asked: &str, expected: &str| {
            let text = code_of_files(asked).unwrap_or_else(|| panic!("{asked} is explained"));
            assert!(text.contains(expected), "{text}");
            assert!(text.lines().all(|line| line.chars().count() <= COLUMNS), "{text}");
        };
        check("M19", "a slit");
        check("m019", "codes.M19 = \"ignore\"");
        check("G1", "codes.G01");
        check("M63", "percent");
        check("N", "A piece begins");
        for unknown in ["M99", "verify/nothing", "", "M", "é1"] {
            assert_eq!(code_of_files(unknown), None, "{unknown}");
        }
    }

    #[test]
    fn a_hint_names_what_is_like_and_nothing_else() {
        for (asked, expected) in [
            ("iso/open-slot", "did you mean `iso/open-slit`?"),
            ("knife.widht_mm", "did you mean `knife.width_mm`?"),
            ("PE", "instructions of plots"),
            ("aa", "instructions of plots"),
        ] {
            assert!(hint(asked).contains(expected), "{asked}: {}", hint(asked));
        }
        for asked in ["foo", "M99", "", "codes.<code>x"] {
            assert!(!hint(asked).contains("did you mean `codes.<"), "{asked}");
        }
        assert_eq!(hint("foo"), "`cutc explain` lists them all");
    }

    #[test]
    fn an_explanation_says_more_than_the_table_and_fits_80_columns() {
        for topic in topics() {
            let text = explained(topic);
            assert!(text.lines().all(|line| line.chars().count() <= COLUMNS), "{text}");
            assert!(text.len() > topic.2.len() + 150, "{text}");
        }
    }
}
