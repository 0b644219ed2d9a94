//! Every fixture is read: the valid ones without errors, the invalid ones with messages that people review.

use std::fmt::Write as _;
use std::fs;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};

use cutc::diagnostic::{Diagnostics, Severity, render};
use cutc::front::{self, DIALECTS, Dialect};
use cutc::geom::{Point, polyline};
use cutc::ir::Marker;
use cutc::machine::Job;
use cutc::source::Source;

/// Largest fixture that is damaged in every way, bytes.
const SMALL: usize = 2048;
/// Single bytes that are damaged in each small fixture.
const DAMAGES: usize = 2000;
/// Most lines that one message may take on a terminal, and columns of each.
const MOST_LINES: usize = 20;
const MOST_COLUMNS: usize = 100;

fn files(folder: &str) -> Vec<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures").join(folder);
    let mut files: Vec<PathBuf> =
        fs::read_dir(&root).map(|dir| dir.map(|entry| entry.expect("readable").path()).collect()).unwrap_or_default();
    files.sort();
    assert!(!files.is_empty(), "{} holds no fixture", root.display());
    files
}

fn stem(path: &Path) -> &str {
    path.file_stem().and_then(|stem| stem.to_str()).expect("a fixture is named by its topic in ASCII")
}

fn source(path: &Path, bytes: Vec<u8>) -> Source {
    let name = path.file_name().and_then(|name| name.to_str()).expect("an ASCII name");
    Source::new(name, bytes).expect("fixtures are small")
}

fn read(dialect: &Dialect, source: &Source) -> (Marker, Diagnostics) {
    let mut found = Diagnostics::default();
    let marker = cutc::pipeline::marker_of(dialect, source, &Job::default(), &mut found);
    (marker, found)
}

fn at(point: Point) -> String {
    format!("{:.3} {:.3}", point.x, point.y)
}

/// What a marker holds: a line for each thing.
fn describe(marker: &Marker, source: &Source) -> String {
    let mut out = format!("unit {} mm\n", marker.unit);
    for piece in &marker.pieces {
        for event in &piece.events {
            let _ = writeln!(out, "{:?}, block {}", event.kind, event.span.block);
        }
        let feed = piece.feed.map_or(String::new(), |feed| format!(", feed {feed:.3} mm/s"));
        let _ = writeln!(out, "piece {}, block {}{feed}", piece.number, piece.span.block);
        for contour in &piece.contours {
            let points = marker.points(contour);
            let kind = if contour.closed { "closed" } else { "open" };
            let (count, length) = (points.len(), polyline::length(&points));
            let _ = writeln!(out, "  {kind} contour of {count} points, {length:.3} mm, from {}", at(points[0]));
            for (_, segment) in marker.list.walk(contour.range) {
                let joint = segment.joint;
                let flags =
                    [(joint.lift, "lift"), (joint.full_advance, "full advance"), (joint.no_overcut, "no overcut")];
                let asked: Vec<&str> = flags.iter().filter(|(set, _)| *set).map(|(_, name)| *name).collect();
                if segment.percent != 100 {
                    let _ = writeln!(out, "    to {}: {} %", at(segment.to), segment.percent);
                }
                if !asked.is_empty() {
                    let _ = writeln!(out, "    at {}: {}", at(segment.from), asked.join(", "));
                }
            }
        }
        for notch in &piece.notches {
            let _ =
                writeln!(out, "  {:?} {} -> {}, block {}", notch.kind, at(notch.root), at(notch.tip), notch.span.block);
        }
        for drill in &piece.drills {
            let _ = writeln!(out, "  drill {} at {}, block {}", drill.tool, at(drill.at), drill.span.block);
        }
        for label in &piece.labels {
            let text = source.slice(label.span).escape_ascii().to_string();
            let place = label.at.map_or("nowhere".to_owned(), at);
            let heading = label.heading.map_or(String::new(), |h| format!(", {:.1} deg", h.radians().to_degrees()));
            let _ = writeln!(out, "  label at {place}{heading}: {text}");
            if let Some(mirrored) = label.mirrored {
                let _ = writeln!(out, "    mirrored: {}", source.slice(mirrored).escape_ascii());
            }
        }
        for field in &piece.fields {
            let value = source.slice(field.span).escape_ascii();
            let _ = writeln!(out, "  field {}: {value}", char::from(field.letter));
        }
    }
    for event in &marker.closing {
        let _ = writeln!(out, "{:?}, block {}", event.kind, event.span.block);
    }
    out
}

#[test]
fn a_valid_fixture_is_recognised_and_read_without_errors() {
    for dialect in DIALECTS {
        for path in files(dialect.name) {
            let source = source(&path, fs::read(&path).expect("readable"));
            let mut found = Diagnostics::default();
            let detected = front::detect(&source, None, &mut found).map(|dialect| dialect.name);
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
        if front::detect(&source, Some("cut"), &mut found).is_none() {
            assert_eq!(found.count(Severity::Error), 1, "{}", path.display());
            insta::assert_snapshot!(format!("detect-{}", stem(&path)), render(&found, &source));
        }
    }
}

/// Reads damaged bytes: as long as nothing panics, anything may be found.
fn survive(dialect: &Dialect, path: &Path, bytes: Vec<u8>, damage: &str) {
    let source = source(path, bytes);
    let outcome = catch_unwind(AssertUnwindSafe(|| {
        let (marker, found) = read(dialect, &source);
        let _ = (dialect.sniff)(source.bytes());
        (describe(&marker, &source), render(&found, &source))
    }));
    assert!(outcome.is_ok(), "{}: {damage} panics", path.display());
}

fn small_fixtures(dialect: &Dialect) -> Vec<(PathBuf, Vec<u8>)> {
    let folders = [dialect.name.to_owned(), format!("invalid/{}", dialect.name)];
    let paths = folders.iter().flat_map(|folder| files(folder));
    paths.map(|path| (path.clone(), fs::read(&path).expect("readable"))).filter(|(_, b)| b.len() < SMALL).collect()
}

#[test]
fn a_fixture_cut_short_anywhere_never_panics() {
    for dialect in DIALECTS {
        for (path, bytes) in small_fixtures(dialect) {
            for length in 0..bytes.len() {
                survive(dialect, &path, bytes[..length].to_vec(), &format!("a cut after {length} bytes"));
            }
        }
    }
}

#[test]
fn a_fixture_with_a_damaged_byte_never_panics() {
    for dialect in DIALECTS {
        for (path, bytes) in small_fixtures(dialect).into_iter().filter(|(_, bytes)| !bytes.is_empty()) {
            let mut random = fastrand::Rng::with_seed(bytes.len() as u64);
            for _ in 0..DAMAGES {
                let mut damaged = bytes.clone();
                let (at, byte) = (random.usize(..bytes.len()), random.u8(..));
                damaged[at] = byte;
                survive(dialect, &path, damaged, &format!("byte {byte:#04x} at {at}"));
            }
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
