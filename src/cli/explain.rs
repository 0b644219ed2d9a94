//! `cutc explain`: the meaning of a code, a rule, a key or a word, why it matters and what to do.

use std::fmt::Write as _;

use clap::Args;

use super::finished::{DONE, Finished, failure};
use crate::diagnostic::{Severity, code};
use crate::front::DIALECTS;
use crate::machine::MachineProfile;
use crate::machine::keys::{self, KEYS, Key};
use crate::machines::MACHINES;
use crate::manual;

/// Columns of an explanation.
const COLUMNS: usize = 80;
/// Least likeness of a name to what was typed, of 1: two swapped letters or a wrong ending are above it.
const LEAST_LIKENESS: f64 = 0.8;
/// Least number of letters for a search in texts: shorter words occur everywhere.
const FEWEST_LETTERS: usize = 4;

/// Arguments of `cutc explain`.
#[derive(Debug, Args)]
pub(super) struct Arguments {
    /// A code as messages show it, `iso/open-slit`, a rule of the verifier, `verify/on-path`, a code of cut files or an
    /// instruction of plots, `M19`, `SC`, a key of the profile, `knife.width_mm`, or a word, `overcut`
    #[arg(num_args = 0.., value_name = "WORD")]
    words: Vec<String>,
}

/// A code of diagnostics or a rule.
struct Topic {
    name: &'static str,
    /// "error", "warning" or "rule".
    kind: &'static str,
    /// Its meaning in a sentence.
    about: &'static str,
    /// Background.
    more: &'static str,
}

/// Every code, then every rule.
fn topics() -> impl Iterator<Item = Topic> {
    let codes = code::all().map(|code| Topic {
        name: code.name,
        kind: severity(code.severity),
        about: code.about,
        more: code.more,
    });
    let rules = MACHINES.iter().flat_map(|machine| machine.rules);
    let rules = rules.map(|rule| Topic { name: rule.name, kind: "rule", about: rule.about, more: rule.more });
    codes.chain(rules)
}

fn severity(severity: Severity) -> &'static str {
    match severity {
        Severity::Error => "error",
        Severity::Warning => "warning",
    }
}

pub(super) fn run(arguments: &Arguments) -> anyhow::Result<Finished> {
    let asked = arguments.words.join(" ");
    if asked.is_empty() {
        return Ok(Finished::text(list(), String::new(), DONE));
    }
    let topic = || topics().find(|topic| topic.name == asked).map(|topic| explained(&topic));
    let key = || keys::find(&asked).map(key_text);
    let found = topic().or_else(|| word_of_dialect(&asked)).or_else(key).or_else(|| word(&asked));
    found
        .map(|text| Finished::text(text, String::new(), DONE))
        .ok_or_else(|| failure(format!("nothing is said of `{asked}`"), hint(&asked)))
}

/// Hint with a similar name. A family of keys (`codes.<code>`) is similar to everything, and is no name.
fn hint(asked: &str) -> String {
    let likeness = |name: &str| strsim::jaro_winkler(name, asked);
    let keys = KEYS.iter().map(|key| key.name).filter(|name| !name.contains('<'));
    let names = topics().map(|topic| topic.name).chain(keys).chain(manual::glossary().map(|entry| entry.term));
    let near = names.filter(|name| likeness(name) >= LEAST_LIKENESS);
    let nearest = near.max_by(|a, b| likeness(a).total_cmp(&likeness(b)));
    let guess = nearest.map_or_else(String::new, |name| format!("did you mean `{name}`? "));
    format!("{guess}`cutc explain` lists all codes and rules, `cutc manual glossary` the words")
}

/// Letter and number of a code of cut files, as `M014` or `n`; `None` for other words.
fn letter_and_number(word: &str) -> Option<(char, Option<u32>)> {
    let letter = word.chars().next().filter(char::is_ascii_alphabetic)?.to_ascii_uppercase();
    let digits = &word[1..];
    let number = if digits.is_empty() { None } else { Some(digits.parse().ok()?) };
    Some((letter, number))
}

/// True if the words of a row are a code, or a range of codes that holds it.
fn names(words: &str, asked: &str) -> bool {
    let named: Vec<&str> = words.split('`').skip(1).step_by(2).collect();
    if named.iter().any(|word| word.eq_ignore_ascii_case(asked)) {
        return true;
    }
    let Some(asked) = letter_and_number(asked) else { return false };
    let codes: Vec<_> = named.iter().filter_map(|word| letter_and_number(word)).collect();
    let within = |first, last| first <= asked && asked <= last;
    codes.contains(&asked) || words.contains(" to ") && codes.len() == 2 && within(codes[0], codes[1])
}

/// Description of a code in the table of a dialect.
fn word_of_dialect(asked: &str) -> Option<String> {
    for dialect in DIALECTS {
        let rows = dialect.words.iter().filter(|row| names(row.words, asked));
        let told: Vec<String> =
            rows.map(|row| wrapped(&format!("{}: {}", row.words, sentence(row.about)), COLUMNS)).collect();
        if told.is_empty() {
            continue;
        }
        let code = match letter_and_number(asked) {
            Some((letter, Some(number))) => format!("{letter}{number:02}"),
            Some(_) | None => asked.to_ascii_uppercase(),
        };
        let about = wrapped(&format!("word of {}", dialect.about), COLUMNS);
        let head = format!("{code}\n{about}\n\n{}\n", told.join("\n"));
        let spelled = letter_and_number(asked).map_or_else(String::new, |(letter, number)| {
            format!("{letter}{}", number.map_or_else(String::new, |number| number.to_string()))
        });
        let can_be_off = dialect.name == "iso" && keys::find(&format!("{}.{spelled}", keys::CODES)).is_some();
        let off = format!("\nThe profile can switch a code off:\n  {}.{code} = \"ignore\"\n", keys::CODES);
        return Some(if can_be_off { head + &off } else { head });
    }
    None
}

/// Meaning, values and default of a key of the profile.
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

/// Definition of a word in the glossary, and other texts that contain it.
fn word(asked: &str) -> Option<String> {
    let lower = asked.to_lowercase();
    let mut out = String::new();
    for entry in manual::glossary().filter(|entry| entry.term.to_lowercase() == lower) {
        let _ = writeln!(out, "{}\nword of the trade\n\n{}\n", entry.term, wrapped(&sentence(&entry.text), COLUMNS));
    }
    let has = |text: &str| lower.len() >= FEWEST_LETTERS && text.to_lowercase().contains(&lower);
    let topics = topics().filter(|topic| has(topic.name) || has(topic.about)).map(|topic| (topic.name, topic.about));
    let keys = KEYS.iter().filter(|key| has(key.name) || has(key.about)).map(|key| (key.name, key.about));
    let rows: Vec<(&str, &str)> = topics.chain(keys).collect();
    if !rows.is_empty() {
        let _ = writeln!(out, "Where `{asked}` stands:");
        let width = rows.iter().map(|(name, _)| name.len()).max().unwrap_or(0);
        for (name, about) in rows {
            let _ = writeln!(out, "  {name:width$}  {}", about.replace('\n', " "));
        }
    }
    (!out.is_empty()).then_some(out)
}

fn list() -> String {
    let width = topics().map(|topic| topic.name.len()).max().unwrap_or(0);
    let mut out = String::new();
    for Topic { name, kind, about, .. } in topics() {
        // Writing into a `String` cannot fail.
        let _ = writeln!(out, "{name:width$}  {kind:7}  {about}");
    }
    out
}

/// Consequence of a kind of finding.
fn consequence(kind: &str) -> &'static str {
    match kind {
        "error" => "error: no program is written",
        "warning" => "warning: a program is written; somebody should look",
        _ => "rule of the verifier: a program that breaks it is not written",
    }
}

fn explained(Topic { name, kind, about, more }: &Topic) -> String {
    format!("{name}\n{}\n\n{}\n\n{}\n", consequence(kind), wrapped(&sentence(about), COLUMNS), paragraphs(more))
}

/// A description as a sentence: those of rules are in lower case without a full stop.
fn sentence(about: &str) -> String {
    let mut letters = about.chars();
    let first: String = letters.next().into_iter().flat_map(char::to_uppercase).collect();
    format!("{first}{}{}", letters.as_str(), if about.ends_with('.') { "" } else { "." })
}

/// Wraps paragraphs, one per line; an indented line is an example and stays as it is.
fn paragraphs(text: &str) -> String {
    let paragraph = |line: &str| if line.starts_with(' ') { line.to_owned() } else { wrapped(line, COLUMNS) };
    text.lines().map(paragraph).collect::<Vec<_>>().join("\n")
}

/// Wraps a text to a number of columns.
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
    fn every_code_and_rule_stands_once_with_its_explanation() {
        let count = |name: &str| topics().filter(|topic| topic.name == name).count();
        for topic in topics() {
            assert!(count(topic.name) == 1 && !topic.about.is_empty() && !topic.more.is_empty(), "{}", topic.name);
        }
    }

    #[test]
    fn a_code_of_a_dialect_is_explained_by_its_row() {
        let check = |asked: &str, expected: &str| {
            let text = word_of_dialect(asked).unwrap_or_else(|| panic!("{asked} is explained"));
            assert!(text.contains(expected), "{text}");
            assert!(text.lines().all(|line| line.chars().count() <= COLUMNS), "{text}");
        };
        check("M19", "a slit");
        check("m019", "codes.M19 = \"ignore\"");
        check("G1", "codes.G01");
        check("M63", "percent");
        check("N", "A piece begins");
        check("SC", "Obeyed");
        check("pd", "Moves");
        for unknown in ["M99", "verify/nothing", "", "M", "é1", "XX"] {
            assert_eq!(word_of_dialect(unknown), None, "{unknown}");
        }
    }

    #[test]
    fn a_word_is_found_in_the_glossary_and_wherever_it_stands() {
        let text = word("overcut").expect("a word of the trade");
        assert!(text.contains("word of the trade") && text.contains("verify/overcut-part"), "{text}");
        assert!(text.contains("knife.front_overlap_mm"), "{text}");
        assert_eq!(word("xyzzy"), None);
    }

    #[test]
    fn a_hint_names_what_is_like_and_nothing_else() {
        for (asked, expected) in [
            ("iso/open-slot", "did you mean `iso/open-slit`?"),
            ("knife.widht_mm", "did you mean `knife.width_mm`?"),
            ("plunge cuts", "did you mean `plunge cut`?"),
        ] {
            assert!(hint(asked).contains(expected), "{asked}: {}", hint(asked));
        }
        for asked in ["foo", "M99", "", "codes.<code>x"] {
            assert!(!hint(asked).contains("did you mean `codes.<"), "{asked}");
        }
        assert!(hint("foo").starts_with("`cutc explain` lists"));
    }

    #[test]
    fn an_explanation_says_more_than_the_table_and_fits_80_columns() {
        for topic in topics() {
            let text = explained(&topic);
            assert!(text.lines().all(|line| line.chars().count() <= COLUMNS), "{text}");
            assert!(text.len() > topic.about.len() + 150, "{text}");
        }
    }
}
