//! Every fixture is read: the valid ones without errors, the invalid ones with messages that people review.

use std::fs;

use cutc::diagnostic::{Diagnostics, Severity, render};
use cutc::front::{self, DIALECTS};
use cutc::source::Source;

use crate::support::fixtures::{describe, files, read, source, stem};

/// Most lines that one message may take on a terminal, and columns of each.
const MOST_LINES: usize = 20;
const MOST_COLUMNS: usize = 100;

#[test]
fn a_valid_fixture_is_recognised_and_read_without_errors() {
    for dialect in DIALECTS {
        for path in files(dialect.name) {
            let source = source(&path, fs::read(&path).expect("readable"));
            let mut found = Diagnostics::default();
            let detected = front::choose(&source, None, None, &mut found).map(|dialect| dialect.name);
            assert_eq!(detected, Some(dialect.name), "{}", path.display());
            let (marker, found) = read(dialect, &source);
            assert!(!found.has_errors(), "{}", render(&found, &source));
            let text = format!("{}{}", describe(&marker, &source), render(&found, &source));
            insta::assert_snapshot!(format!("{}-{}", dialect.name, stem(&path)), text);
        }
    }
}

#[test]
fn an_invalid_fixture_is_refused_in_words_that_fit_a_terminal() {
    for dialect in DIALECTS {
        for path in files(&format!("invalid/{}", dialect.name)) {
            let source = source(&path, fs::read(&path).expect("readable"));
            let (_, found) = read(dialect, &source);
            assert!(found.has_errors(), "{} is read without an error", path.display());
            let text = render(&found, &source);
            assert!(text.lines().all(|line| line.chars().count() <= MOST_COLUMNS), "{text}");
            for one in &found {
                let mut alone = Diagnostics::default();
                alone.push(one.clone());
                assert!(render(&alone, &source).lines().count() < MOST_LINES, "{text}");
            }
            insta::assert_snapshot!(format!("invalid-{}-{}", dialect.name, stem(&path)), text);
        }
    }
}

#[test]
fn what_is_no_cutter_file_is_called_by_its_name() {
    for path in files("invalid/iso") {
        let source = source(&path, fs::read(&path).expect("readable"));
        let mut found = Diagnostics::default();
        if front::choose(&source, None, Some("cut"), &mut found).is_none() {
            assert_eq!(found.count(Severity::Error), 1, "{}", path.display());
            insta::assert_snapshot!(format!("detect-{}", stem(&path)), render(&found, &source));
        }
    }
}

/// Damages of a block in the middle of a long file: what is said must show the place and fit a terminal.
#[test]
fn a_file_of_one_long_line_has_readable_errors() {
    let vertex = |i: u32| format!("X{}Y{}*", 1000 + i % 700, 2000 + i * 7 % 900);
    let vertices: String = (0..5500).map(vertex).collect();
    let (head, end) = ("H1*G71*M15*N1*X0Y0*M14*", "X0Y0*M15*M0*");
    let place = head.len() + vertices[..vertices.len() / 2].rfind('*').expect("blocks") + 1;
    let whole = format!("{head}{vertices}{end}");
    assert!(whole.len() > 59_000 && !whole.contains('\n'), "{} bytes", whole.len());
    let damages = [("X1?2Y5*", 2), ("x", 0), ("X5Y5X", 4), ("X5Y*", 2), ("\u{43f}*", 0), ("X123456789012*", 1)];
    let iso = DIALECTS.iter().find(|dialect| dialect.name == "iso").expect("cut files are read");
    for (damage, at) in damages {
        let mut bytes = whole.clone().into_bytes();
        bytes.splice(place..place, damage.bytes());
        let source = Source::new("long.cut", bytes).expect("small");
        let (_, found) = read(iso, &source);
        let first = found.iter().next().expect("a fault");
        assert_eq!(first.span.map(|span| span.start as usize), Some(place + at), "{damage}");
        assert!(!first.hints.is_empty(), "{damage}");
        let text = render(&found, &source);
        assert!(text.lines().count() < MOST_LINES, "{text}");
        assert!(text.lines().all(|line| line.chars().count() <= MOST_COLUMNS), "{text}");
    }
}
