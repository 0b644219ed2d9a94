//! The grammars are live: their sentences are accepted, damaged ones never panic, and real text is among them.

use std::collections::BTreeSet;
use std::fs;
use std::panic::catch_unwind;
use std::path::Path;

use bnf::{Grammar, RandomWalk, Term};
use cutc::diagnostic::{Diagnostics, render};
use cutc::front::{DIALECTS, Dialect};
use cutc::source::{Source, Span};

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
    let inside = |span: Span| span.start <= span.end && span.end as usize <= bytes.len();
    assert!(found.iter().filter_map(|finding| finding.span).all(inside), "{}", bytes.escape_ascii());
    render(&found, &source)
}

/// The dialects that have a grammar: why one has none says the architecture test.
fn with_grammars() -> impl Iterator<Item = &'static Dialect> {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("grammar");
    DIALECTS.iter().filter(move |dialect| folder.join(format!("{}.bnf", dialect.name)).is_file())
}

#[test]
fn a_sentence_of_the_grammar_is_accepted() {
    for dialect in with_grammars() {
        let grammar = grammar(dialect.name);
        for seed in 0..SENTENCES {
            let bytes = sentence(&grammar, seed);
            assert_eq!(syntax(dialect, &bytes), "", "{}", bytes.escape_ascii());
        }
    }
}

#[test]
fn a_sentence_with_a_sign_that_no_block_can_hold_is_refused_there() {
    let iso = DIALECTS.iter().find(|dialect| dialect.name == "iso").expect("cut files are read");
    let grammar = grammar(iso.name);
    let mut refused = 0;
    for seed in 0..SENTENCES {
        let bytes = sentence(&grammar, seed);
        // Texts may hold any sign.
        if [b"M20*", b"M31*"].iter().any(|code| bytes.windows(4).any(|four| four == *code)) {
            continue;
        }
        let at = fastrand::Rng::with_seed(seed.into()).usize(..bytes.len());
        let damaged = [&bytes[..at], b"?", &bytes[at..]].concat();
        let source = Source::new("a.cut", damaged.clone()).expect("small");
        let mut found = Diagnostics::default();
        (iso.syntax)(&source, &mut found);
        let blamed = found.iter().filter_map(|finding| finding.span).map(|span| span.start as usize);
        // At the sign, or at the axis whose number it took away.
        assert!(blamed.clone().count() == 1, "{}", damaged.escape_ascii());
        assert!(
            blamed.clone().all(|start| start == at || start + 1 == at || start + 2 == at),
            "{}",
            damaged.escape_ascii()
        );
        refused += 1;
    }
    assert!(refused > SENTENCES / 10, "only {refused} sentences without texts");
}

#[test]
fn a_plot_with_a_fault_of_grammar_is_refused_there() {
    let hpgl = DIALECTS.iter().find(|dialect| dialect.name == "hpgl").expect("plots are read");
    for (text, code) in [
        (&b"IN;QX1,2;"[..], "hpgl/unknown-instruction"),
        (b"IN;PD1,99999999999;", "hpgl/number-overflow"),
        (b"SP99999999999;", "hpgl/number-overflow"),
        (b"PE7<=__", "hpgl/encoding-open"),
        (b"PE<=,_;", "hpgl/encoding-damaged"),
        (b"PU!;", "hpgl/junk"),
    ] {
        assert!(syntax(hpgl, text).contains(code), "{}: {}", text.escape_ascii(), syntax(hpgl, text));
    }
}

#[test]
fn a_sentence_with_a_damaged_byte_never_panics_and_is_blamed_within_its_bytes() {
    for dialect in with_grammars() {
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

/// Looks texts up in the grammar of a dialect, rule by rule: a general parser takes too long over a whole file.
fn check(dialect: &str, texts: &BTreeSet<(&str, String)>) {
    let grammar = grammar(dialect);
    let parser = grammar.build_parser().expect("every rule is defined");
    let is_none = |(rule, text): &&(&str, String)| {
        let start = Term::Nonterminal((*rule).to_owned());
        parser.parse_input_starting_with(text, &start).next().is_none()
    };
    let strange: Vec<_> = texts.iter().filter(is_none).collect();
    assert!(strange.is_empty(), "no sentences of {dialect}: {strange:?}");
}

/// The statements of an excerpt of a cut file, as the grammar sees them: a file is any sequence of them. Coordinates are
/// made alike, since any digits may stand there.
fn statements(bytes: &[u8]) -> Vec<(&'static str, String)> {
    let mut blocks = Blocks { bytes: &bytes[..bytes.len().min(EXCERPT)], at: 0 };
    blocks.take_end();
    let mut statements = Vec::new();
    while let Some(block) = blocks.next() {
        let code = block.rfind('M').map_or("", |at| &block[at..]);
        if code == "M20" {
            blocks.text();
            statements.push(("message", "M20*TEXT*".to_owned()));
        } else if code == "M31" {
            let place = if block == "M31" { blocks.next_if(is_place) } else { None };
            blocks.text();
            let before = place.map_or(format!("{block}*"), |place| format!("M31*{place}*"));
            let mut ahead = blocks.clone();
            let is_text = ahead.next().is_some_and(|text| text.bytes().any(|byte| byte.is_ascii_lowercase()))
                || MIRRORED_TEXTS.iter().any(|text| blocks.bytes[blocks.at..].starts_with(text.as_bytes()));
            match ahead.next_if(|next| next.strip_suffix("M31").is_some_and(is_place)).filter(|_| is_text) {
                Some(second) => {
                    blocks = ahead;
                    statements.push(("mirrored", format!("{before}TEXT*TEXT*{second}*")));
                }
                None => statements.push(("label", format!("{before}TEXT*"))),
            }
        } else {
            statements.push(("block", block + "*"));
        }
    }
    statements.into_iter().map(|(rule, text)| (rule, with_like_digits(&text))).collect()
}

/// Bytes of a fixture that are looked at.
const EXCERPT: usize = 4096;
/// Texts of mirrored labels in the fixtures that are written in capitals.
const MIRRORED_TEXTS: [&str; 1] = ["HTRUOF"];

/// The blocks of a cut file, cut by other means than the reader's.
#[derive(Clone)]
struct Blocks<'a> {
    bytes: &'a [u8],
    at: usize,
}

impl Blocks<'_> {
    /// Leaves out what is no block: a byte order mark, a line of per cent signs, the list of labels behind M0, and a block that the excerpt cuts.
    fn take_end(&mut self) {
        self.at = self.bytes.iter().position(|&byte| byte != 0).unwrap_or(0);
        self.at += if self.bytes[self.at..].starts_with(b"\xef\xbb\xbf") { 3 } else { 0 };
        while self.bytes.get(self.at).is_some_and(|&byte| byte == b'%' || byte.is_ascii_whitespace()) {
            self.at += 1;
        }
        let list = self.bytes.windows(5).position(|five| five == b"M0*\nN");
        let end = list.map(|at| at + 3).or_else(|| self.bytes.iter().rposition(|&byte| byte == b'*').map(|at| at + 1));
        self.bytes = &self.bytes[..end.unwrap_or(self.bytes.len())];
    }

    /// The next block without blanks and deleted passages; `None` when only blanks are left.
    fn next(&mut self) -> Option<String> {
        let mut block = String::new();
        let mut deleted = false;
        while let Some(&byte) = self.bytes.get(self.at) {
            self.at += 1;
            match byte {
                b'/' => deleted = !deleted,
                _ if deleted => {}
                b'*' => return Some(block),
                b' ' | b'\t' | b'\r' | b'\n' | 0 | 0x1a | 2 | 3 | 0x11 | 0x13 => {}
                _ => block.push(char::from(byte)),
            }
        }
        None
    }

    fn next_if(&mut self, wanted: impl Fn(&str) -> bool) -> Option<String> {
        let mut ahead = self.clone();
        let block = ahead.next().filter(|block| wanted(block))?;
        *self = ahead;
        Some(block)
    }

    /// Passes over a text.
    fn text(&mut self) {
        while self.bytes.get(self.at).is_some_and(|&byte| byte != b'*') {
            self.at += 1;
        }
        self.at += 1;
    }
}

/// Whether a block is an X and a Y with whole numbers.
fn is_place(block: &str) -> bool {
    let number = |text: &str| text.trim_start_matches(['-', '+']).parse::<u32>().is_ok();
    block.strip_prefix('X').and_then(|rest| rest.split_once('Y')).is_some_and(|(x, y)| number(x) && number(y))
}

fn with_like_digits(text: &str) -> String {
    let mut is_coordinate = false;
    let like = |c: char| {
        if c.is_ascii_uppercase() {
            is_coordinate = matches!(c, 'X' | 'Y' | 'I' | 'J');
        }
        if is_coordinate && c.is_ascii_digit() { '1' } else { c }
    };
    text.chars().map(like).collect()
}

#[test]
fn excerpts_of_all_valid_fixtures_are_sentences_of_the_iso_grammar() {
    let mut texts = BTreeSet::new();
    let mut files = 0;
    for name in ["fixtures/iso", "fixtures/markers", "fixtures/pictures"] {
        for entry in fs::read_dir(folder(name)).expect("a folder") {
            let path = entry.expect("readable").path();
            if path.extension().is_some_and(|extension| extension == "cut") {
                texts.extend(statements(&fs::read(path).expect("readable")));
                files += 1;
            }
        }
    }
    assert!(files >= 50, "only {files} fixtures");
    for rule in ["block", "message", "label", "mirrored"] {
        assert!(texts.iter().any(|text| text.0 == rule), "no {rule} stands in a fixture");
    }
    check("iso", &texts);
}

#[test]
fn every_layout_of_a_label_is_a_sentence_of_the_iso_grammar() {
    let layouts = [
        ("label", "X500Y400M31*TEXT*"),
        ("label", "M31*X200Y160*TEXT*"),
        ("label", "M31*TEXT*"),
        ("mirrored", "X300Y300M31*TEXT*TEXT*X400Y300M31*"),
        ("message", "M20*TEXT*"),
    ];
    check("iso", &layouts.into_iter().map(|(rule, text)| (rule, text.to_owned())).collect());
}

/// Instructions with their numbers, labels and comments of a plot, cut by other means than the reader's, up to the first
/// thing that is none of these. Numbers are made alike, since any digits may stand there.
fn plot_statements(bytes: &[u8]) -> Vec<(&'static str, String)> {
    let mut statements = Vec::new();
    let mut rest = bytes;
    while let [first, second, behind @ ..] = rest {
        if first.is_ascii_whitespace() {
            rest = &rest[1..];
            continue;
        }
        let mnemonic = String::from_utf8_lossy(&[*first, *second]).to_uppercase();
        match mnemonic.as_str() {
            "LB" | "BL" | "WD" => {
                let Some(length) = behind.iter().position(|&byte| byte == 3) else { break };
                statements.push(("text", format!("{mnemonic}TEXTETX")));
                rest = &behind[length + 1..];
            }
            "CO" | "MG" if behind.first() == Some(&b'"') => {
                let Some(length) = behind.iter().skip(1).position(|&byte| byte == b'"') else { break };
                statements.push(("text", format!("{mnemonic}\"TEXT\";")));
                rest = &behind[length + 2..];
            }
            "MG" if behind.iter().find(|byte| matches!(byte, b';' | 3)) == Some(&3) => {
                let Some(length) = behind.iter().position(|&byte| byte == 3) else { break };
                statements.push(("text", "MGTEXTETX".to_owned()));
                rest = &behind[length + 1..];
            }
            "BP" if behind.starts_with(b"1,") => {
                let Some(length) = behind.iter().position(|&byte| byte == b';') else { break };
                let has_quotes = behind[..length].contains(&b'"');
                let text = if has_quotes { "BP1,\"TEXT\",5,1;" } else { "BP1,TEXT;" };
                statements.push(("text", text.to_owned()));
                rest = &behind[length + 1..];
            }
            // A semicolon leads an instruction, or is all that is left of a label or a comment.
            _ if *first == b';' && !leads_instruction(&rest[1..]) => rest = &rest[1..],
            "PE" | "DT" => break,
            _ => {
                let leads = usize::from(*first == b';');
                let numbers = &rest[leads + 2..];
                let is_mnemonic = rest[leads..leads + 2].iter().all(u8::is_ascii_alphabetic);
                let is_number = |byte: &u8| byte.is_ascii_digit() || b"+-., \t\r\n".contains(byte);
                let length = numbers.iter().position(|byte| !is_number(byte)).unwrap_or(numbers.len());
                let end = length + usize::from(leads == 0 && numbers.get(length) == Some(&b';'));
                if !is_mnemonic {
                    break;
                }
                let text = String::from_utf8_lossy(&rest[..leads + 2 + end]).to_uppercase();
                let text = text.replace("\r\n", "END").replace('\n', "END").replace('\t', " ");
                // Blanks and commas behind the last number say nothing; an escape sequence may follow them.
                let text = text.trim_end_matches([' ', ',']).replace(",;", ";");
                statements.push(("instruction", with_short_numbers(&text)));
                rest = &numbers[end..];
            }
        }
    }
    statements
}

/// Whether an instruction with numbers, or with nothing, comes first.
fn leads_instruction(bytes: &[u8]) -> bool {
    let name = String::from_utf8_lossy(&bytes[..bytes.len().min(2)]).to_uppercase();
    name.len() == 2
        && name.bytes().all(|byte| byte.is_ascii_alphabetic())
        && !["LB", "BL", "WD", "CO", "MG", "BP", "PE", "DT"].contains(&&*name)
}

/// The same with a digit 1 for each run of digits.
fn with_short_numbers(text: &str) -> String {
    let mut out = String::new();
    for c in text.chars() {
        if !c.is_ascii_digit() {
            out.push(c);
        } else if !out.ends_with('1') {
            out.push('1');
        }
    }
    out
}

#[test]
fn excerpts_of_all_plots_are_sentences_of_the_hpgl_grammar() {
    let mut texts = BTreeSet::new();
    for entry in fs::read_dir(folder("fixtures/hpgl")).expect("a folder") {
        let bytes = fs::read(entry.expect("readable").path()).expect("readable");
        texts.extend(plot_statements(&bytes));
    }
    assert!(texts.len() >= 50, "only {} statements", texts.len());
    check("hpgl", &texts);
}

#[test]
fn fixtures_are_sentences_of_the_csv_grammar() {
    for name in ["square", "circle", "open-curve"] {
        let path = folder("fixtures/csv").join(name).with_extension("csv");
        let text = fs::read_to_string(path).expect("readable");
        check("csv", &text.lines().skip(1).take(8).map(|line| ("row", format!("{line}END"))).collect());
    }
}

#[test]
fn a_sentence_of_the_grammar_of_sewing_has_rows_that_are_read() {
    let grammar = grammar("sew");
    for seed in 0..SENTENCES {
        let bytes = sentence(&grammar, seed);
        let source = Source::new("a.csv", bytes.clone()).expect("small");
        let mut found = Diagnostics::default();
        cutc::sew::plan(&source, &cutc::sew::Asked::default(), &cutc::machine::Job::default(), &mut found);
        // Random points seldom suit their element.
        let is_row = found.iter().any(|finding| finding.code.name == "sew/row");
        assert!(!is_row, "{}\n{}", bytes.escape_ascii(), render(&found, &source));
    }
}
