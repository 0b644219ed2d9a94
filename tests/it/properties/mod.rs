//! Laws over seeded random cases: a marker that is written as an ISO cut file and read again is the same, and no damage to
//! a file leads past its end, to a panic, or to a program that should not be.

mod sheet;
mod write;

use std::fs;
use std::io::Cursor;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;

use cutc::back::TARGETS;
use cutc::diagnostic::{Diagnostics, render};
use cutc::ir::Marker;
use cutc::ir::marker::Notch;
use cutc::ir::text::print_marker;
use cutc::machine::Job;
use cutc::pipeline::{self, Order};
use cutc::source::{Source, Span};
use fastrand::Rng;
use sheet::{Shape, Sheet};

/// Random markers of each shape of the dialect.
const MARKERS: u64 = 200;
/// Largest fixture that is cut short everywhere, bytes.
const SMALL: usize = 2048;
/// Damages in all.
const DAMAGES: usize = 10_000;
/// Largest fixture whose damaged forms are compiled as well as read when they have no error, bytes: planning takes a
/// hundred times as long as reading.
const TINY: usize = 160;
/// The most that is cut of one, mm: a digit more makes a program of minutes.
const MOST_CUT: f64 = 10_000.0;

/// The text of a marker without spans.
fn text(marker: &Marker) -> String {
    let line = |line: &str| line.split(' ').filter(|word| !word.starts_with('@')).collect::<Vec<_>>().join(" ");
    print_marker(marker).lines().map(|text| line(text) + "\n").collect()
}

fn check(shape: Shape) {
    for seed in 0..MARKERS {
        let sheet = Sheet::random(&mut Rng::with_seed(seed), shape);
        let source = Source::new("a.cut", write::write(&sheet)).expect("small");
        let mut found = Diagnostics::default();
        let input = pipeline::read(&source, None, &Job::default(), &mut found).expect("a cut file");
        let bytes = source.bytes().escape_ascii();
        assert_eq!(text(&input.marker), text(&sheet.marker()), "seed {seed}: {bytes}");
        // Inch files of older cutters state no unit.
        let is_said = found.iter().any(|finding| finding.code.name != "iso/no-unit");
        assert!(!is_said, "seed {seed}: {bytes}: {}", render(&found, &source));
        let labels = input.marker.pieces.iter().flat_map(|piece| &piece.labels).map(|label| source.slice(label.span));
        let texts = sheet.parts.iter().flat_map(|part| &part.labels).map(|label| label.words.as_bytes());
        assert!(labels.eq(texts), "seed {seed}: {bytes}");
    }
}

#[test]
fn a_metric_file_with_pieces_and_a_title_is_read_as_the_marker_that_was_written() {
    check(Shape::Metric);
}

#[test]
fn an_inch_file_with_slits_inside_contours_is_read_as_the_marker_that_was_written() {
    check(Shape::Inch);
}

#[test]
fn a_spaced_file_with_corner_lifts_and_no_pieces_is_read_as_the_marker_that_was_written() {
    check(Shape::Spaced);
}

/// Every valid cut file and plot of the fixtures, with its name, in order.
fn fixtures() -> Vec<(String, Vec<u8>)> {
    let folder = |name| Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures").join(name);
    let entries = ["iso", "hpgl"].map(|name| fs::read_dir(folder(name)).expect("a folder"));
    let entries = entries.into_iter().flatten().map(|entry| entry.expect("readable").path());
    let mut files: Vec<(String, Vec<u8>)> =
        entries.map(|path| (path.display().to_string(), fs::read(path).expect("readable"))).collect();
    files.sort();
    assert!(files.len() >= 80, "only {} fixtures", files.len());
    files
}

/// Every span of a marker.
fn spans(marker: &Marker) -> Vec<Span> {
    let mut spans: Vec<Span> =
        marker.contours().flat_map(|(_, c)| marker.list.walk(c.range)).map(|(_, s)| s.span).collect();
    for piece in &marker.pieces {
        spans.push(piece.span);
        spans.extend(piece.notches.iter().flat_map(Notch::strokes).map(|stroke| stroke.span));
        spans.extend(piece.drills.iter().map(|drill| drill.span));
        spans.extend(piece.outline_notches.iter().map(|vee| vee.span));
        spans.extend(piece.labels.iter().flat_map(|label| [Some(label.span), label.mirrored]).flatten());
        spans.extend(piece.fields.iter().map(|field| field.span));
        spans.extend(piece.events.iter().map(|event| event.span));
    }
    spans.extend(marker.closing.iter().map(|event| event.span));
    spans
}

/// Reads damaged bytes: nothing may panic, and every span must lie inside the source. Gives what is to be cut, mm; `None`
/// when errors were found.
fn read(bytes: &[u8], damage: &str) -> Option<f64> {
    let outcome = catch_unwind(AssertUnwindSafe(|| {
        let source = Source::new("a.cut", bytes.to_vec()).expect("small");
        let mut found = Diagnostics::default();
        let input = pipeline::read(&source, None, &Job::default(), &mut found);
        let marker = input.map(|input| input.marker).unwrap_or_default();
        let said = found.iter().filter_map(|finding| finding.span);
        let inside = |span: &Span| span.start <= span.end && span.end as usize <= bytes.len();
        let astray = spans(&marker).into_iter().chain(said).find(|span| !inside(span));
        assert_eq!(astray, None, "of {} bytes", bytes.len());
        render(&found, &source);
        (!found.has_errors()).then(|| marker.drawn_length())
    }));
    outcome.unwrap_or_else(|_| panic!("{damage}: {}", bytes.escape_ascii()))
}

/// Compiles damaged bytes, faulty or not: a program comes out only without errors, and it passes the verifier.
fn compile(bytes: &[u8], is_faulty: bool, damage: &str) {
    let source = Source::new("a.cut", bytes.to_vec()).expect("small");
    let target = TARGETS.iter().find(|target| target.name == "csv").expect("setpoints are a target");
    let mut found = Diagnostics::default();
    let order = Order { from: None, target, verify: true };
    let outcome = catch_unwind(AssertUnwindSafe(|| {
        pipeline::compile(&source, &Job::default(), order, &mut Cursor::new(Vec::new()), &mut found)
    }));
    let compiled = outcome.unwrap_or_else(|_| panic!("{damage}: {}", bytes.escape_ascii()));
    let has_program = compiled.expect("memory takes everything").is_some();
    assert!(!(has_program && is_faulty), "{damage}: a program of a faulty file");
    assert_eq!(has_program, !found.has_errors(), "{damage}");
}

#[test]
fn a_file_cut_short_anywhere_is_read_without_a_panic_and_within_its_bytes() {
    for (name, bytes) in fixtures().into_iter().filter(|(_, bytes)| bytes.len() < SMALL) {
        for length in (0..bytes.len()).step_by(crate::ONE_IN) {
            let damage = format!("{name} cut after {length} bytes");
            let cut = read(&bytes[..length], &damage);
            if cut.is_none_or(|cut| cut < MOST_CUT && bytes.len() <= TINY) {
                compile(&bytes[..length], cut.is_none(), &damage);
            }
        }
    }
}

#[test]
fn a_file_with_a_damaged_byte_is_read_without_a_panic_and_gives_no_program_with_errors() {
    let files = fixtures();
    let mut random = Rng::with_seed(4);
    for i in 0..DAMAGES / crate::ONE_IN {
        let (name, bytes) = &files[i % files.len()];
        let mut damaged = bytes.clone();
        let at = random.usize(..bytes.len());
        damaged[at] = random.u8(..);
        let damage = format!("{name} with byte {:#04x} at {at}", damaged[at]);
        let cut = read(&damaged, &damage);
        if cut.is_none_or(|cut| cut < MOST_CUT && bytes.len() <= TINY) {
            compile(&damaged, cut.is_none(), &damage);
        }
    }
}
