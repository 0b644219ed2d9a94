//! The grammars are live: their sentences are accepted, damaged ones never panic, and real text is among them.

use std::collections::BTreeSet;
use std::fs;
use std::panic::catch_unwind;
use std::path::Path;

use bnf::{Grammar, RandomWalk, Term};
use cutc::diagnostic::{Diagnostics, render};
use cutc::front::{DIALECTS, Dialect};
use cutc::source::Source;

/// Sentences made from each grammar.
const SENTENCES: u32 = 400;
/// Damages tried on each of them.
const DAMAGES: usize = 20;

fn folder(name: &str) -> std::path::PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(name)
}

fn grammar(dialect: &str) -> Grammar {
    let path = folder("grammar").join(dialect).with_extension("bnf");
    let text = fs::read_to_string(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    let rules: Vec<&str> = text.lines().filter(|line| !line.starts_with(';')).collect();
    rules.join("\n").parse().unwrap_or_else(|e| panic!("{}: {e}", path.display()))
}

/// The sentence of that seed, with what its tokens stand for.
fn sentence(grammar: &Grammar, seed: u32) -> Vec<u8> {
    let mut bytes = [0; 32];
    bytes[..4].copy_from_slice(&seed.to_le_bytes());
    let text = grammar.generate_seeded_with_strategy(&mut RandomWalk::from_seed(bytes)).expect("a sentence");
    let texts = ["S:M-A N:FRONT", "BK R X1", "A/B=3,5 %", "\u{43f}\u{435}\u{440}\u{435}\u{434}"];
    let ends = ["\n", "\r\n"];
    text.replace("TEXT", texts[seed as usize % texts.len()])
        .replace("END", ends[seed as usize % ends.len()])
        .replace("ETX", "\u{3}")
        .replace("ESC", "\u{1b}")
        .into_bytes()
}

fn syntax(dialect: &Dialect, bytes: &[u8]) -> String {
    let source = Source::new(dialect.name, bytes.to_vec()).expect("small");
    let mut found = Diagnostics::default();
    (dialect.syntax)(&source, &mut found);
    render(&found, &source)
}

#[test]
fn a_sentence_of_the_grammar_is_accepted() {
    for dialect in DIALECTS {
        let grammar = grammar(dialect.name);
        for seed in 0..SENTENCES {
            let bytes = sentence(&grammar, seed);
            assert_eq!(syntax(dialect, &bytes), "", "{}", bytes.escape_ascii());
        }
    }
}

#[test]
fn a_sentence_with_a_damaged_byte_never_panics() {
    for dialect in DIALECTS {
        let grammar = grammar(dialect.name);
        for seed in 0..SENTENCES {
            let bytes = sentence(&grammar, seed);
            let mut random = fastrand::Rng::with_seed(seed.into());
            for _ in 0..DAMAGES {
                let mut damaged = bytes.clone();
                damaged[random.usize(..bytes.len())] = random.u8(..);
                let outcome = catch_unwind(|| syntax(dialect, &damaged));
                assert!(outcome.is_ok(), "{} panics", damaged.escape_ascii());
            }
        }
    }
}

/// Checks a piece of text against a rule of the grammar, and against the reader. (Rule by rule: a general parser takes too
/// long over a whole file.)
fn check(dialect: &str, rule: &str, text: &str) {
    let grammar = grammar(dialect);
    let parser = grammar.build_parser().expect("every rule is defined");
    let start = Term::Nonterminal(rule.to_owned());
    assert!(parser.parse_input_starting_with(text, &start).next().is_some(), "no {rule} of {dialect}: {text}");
}

/// The blocks of a fixture that the grammar speaks about, as it sees them: without line breaks and blanks.
fn excerpt(bytes: &[u8]) -> Vec<String> {
    let Ok(text) = std::str::from_utf8(bytes) else { return Vec::new() };
    let text = text.trim_start_matches('\u{feff}');
    if !text.ends_with("M0*") || ["M20", "M31", "/"].iter().any(|word| text.contains(word)) {
        return Vec::new();
    }
    text.replace(|c: char| c.is_whitespace(), "").split_inclusive('*').map(str::to_owned).collect()
}

#[test]
fn fixtures_are_sentences_of_the_iso_grammar() {
    let mut blocks = BTreeSet::new();
    for entry in fs::read_dir(folder("fixtures/iso")).expect("a folder") {
        blocks.extend(excerpt(&fs::read(entry.expect("readable").path()).expect("readable")));
    }
    assert!(blocks.len() >= 50, "only {} different blocks stand in plain fixtures", blocks.len());
    for block in blocks {
        check("iso", "block", &block);
    }
}

#[test]
fn every_layout_of_a_label_is_a_sentence_of_the_iso_grammar() {
    check("iso", "label", "X500Y400M31*TEXT*");
    check("iso", "label", "M31*X200Y160*TEXT*");
    check("iso", "label", "M31*TEXT*");
    check("iso", "label", "X300Y300M31*TEXT*TEXT*X400Y300M31*M15*");
    check("iso", "message", "M20*TEXT*");
}

#[test]
fn fixtures_are_sentences_of_the_csv_grammar() {
    for name in ["square", "circle", "open-curve"] {
        let path = folder("fixtures/csv").join(name).with_extension("csv");
        let text = fs::read_to_string(path).expect("readable");
        for line in text.lines().skip(1).take(8) {
            check("csv", "row", &format!("{line}END"));
        }
    }
}
