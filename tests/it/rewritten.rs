//! What the target `iso` promises: any marker, written as a normalised cut file and read again, is the same one.

use std::fs;
use std::io::Cursor;
use std::path::{Path, PathBuf};

use cutc::back::{TARGETS, Target};
use cutc::diagnostic::{Diagnostics, render};
use cutc::ir::Marker;
use cutc::ir::text::print_marker;
use cutc::machine::{Job, Mode, Numbers};
use cutc::pipeline::{self, Input, Order};
use cutc::source::Source;

/// Greatest difference of two numbers, mm and rad: half of the last decimal of a cut file, twice over. Places on the grid
/// of the file are the same to the bit; the chords of arcs and the points of other dialects lie on none.
const ROUNDING: f64 = 2e-7;

fn iso() -> &'static Target {
    TARGETS.iter().find(|target| target.name == "iso").expect("it is a target")
}

fn read(source: &Source, job: &Job) -> Option<Input> {
    let mut found = Diagnostics::default();
    let input = pipeline::read(source, None, job, &mut found);
    input.filter(|_| !found.has_errors())
}

/// The verified cut file that a source is written as.
fn written(source: &Source, job: &Job) -> Vec<u8> {
    let mut out = Cursor::new(Vec::new());
    let mut found = Diagnostics::default();
    let order = Order { from: None, target: iso(), verify: true };
    let compiled = pipeline::compile(source, job, order, &mut out, &mut found).expect("memory takes it");
    assert!(compiled.is_some(), "{}", render(&found, source));
    out.into_inner()
}

/// The words of a marker without places in the source, and with the texts that stand there.
fn words(marker: &Marker, source: &Source) -> Vec<String> {
    let text = print_marker(marker);
    let lines = text.lines().filter(|line| !line.starts_with("marker ") && !line.starts_with("field "));
    let words = lines.flat_map(|line| line.split(' ').filter(|word| !word.starts_with('@')));
    let said = marker.pieces.iter().flat_map(|piece| {
        let labels = piece.labels.iter().flat_map(|label| [Some(label.span), label.mirrored]).flatten();
        let fields = piece.fields.iter().map(|field| field.span);
        labels.chain(fields).map(|span| format!("{:?}", source.slice(span)))
    });
    words.map(str::to_owned).chain(said).collect()
}

fn assert_same(name: &str, [before, after]: [&(Marker, &Source); 2]) {
    let (meant, read) = (words(&before.0, before.1), words(&after.0, after.1));
    assert_eq!(meant.len(), read.len(), "{name}:\n{meant:?}\n{read:?}");
    for (a, b) in meant.iter().zip(&read) {
        let near = a.parse().ok().zip(b.parse().ok()).is_some_and(|(a, b): (f64, f64)| (a - b).abs() <= ROUNDING);
        assert!(a == b || near, "{name}: {a} became {b}");
    }
}

fn fixtures() -> Vec<PathBuf> {
    let folder = |name: &str| {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures").join(name);
        fs::read_dir(path).expect("a folder").map(|entry| entry.expect("readable").path()).collect::<Vec<_>>()
    };
    let mut paths: Vec<PathBuf> = ["iso", "markers", "csv", "pictures"].into_iter().flat_map(folder).collect();
    paths.retain(|path| path.extension().is_some_and(|end| end == "cut" || end == "csv"));
    paths.sort();
    paths
}

#[test]
fn every_fixture_goes_round() {
    let job = Job::default();
    let mut count = 0;
    for path in fixtures() {
        let name = path.display().to_string();
        let source = Source::new(name.as_str(), fs::read(&path).expect("readable")).expect("small");
        let Some(input) = read(&source, &job) else { continue };
        let again = Source::new("again.iso", written(&source, &job)).expect("small");
        let marker = read(&again, &job).expect("what was written is read").marker;
        if input.marker.unit > 0.0 {
            assert_eq!(input.marker.unit.to_bits(), marker.unit.to_bits(), "{name}");
        }
        assert_same(&name, [&(input.marker, &source), &(marker, &again)]);
        assert_eq!(written(&again, &job), again.bytes(), "{name}: written again it is the same file");
        count += 1;
    }
    assert!(count >= 60, "only {count} fixtures");
}

#[test]
fn a_chosen_piece_goes_round_alone() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/markers/metric-six-pieces.cut");
    let source = Source::new("m.cut", fs::read(path).expect("readable")).expect("small");
    let mut job = Job::default();
    job.selection.pieces = Some(Numbers::parse("2,4").expect("numbers"));
    let again = Source::new("again.iso", written(&source, &job)).expect("small");
    let numbers: Vec<u32> =
        read(&again, &Job::default()).expect("read").marker.pieces.iter().map(|piece| piece.number).collect();
    assert_eq!(numbers, [2, 4]);
}

#[test]
fn the_file_reads_well() {
    let text = "H1*G71*N1*X10Y0M43*M31*FRONT*X0Y0*M14*M25*X1000Y0*M26*X1000Y1000*M19*X950Y950*M15*X1000Y1000*M17*M14*\
                X0Y0.5*M18*M15*M01*N2*F30*X2000Y0*M14*X2400Y0*M15*M0*\nN,1\nA,Shirt\nL0*";
    let source = Source::new("a.cut", text.as_bytes().to_vec()).expect("small");
    insta::assert_snapshot!(String::from_utf8(written(&source, &Job::default())).expect("ASCII"));
}

#[test]
fn a_line_that_is_lost_or_changed_is_seen() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/iso/speeds-and-events.cut");
    let source = Source::new("m.cut", fs::read(path).expect("readable")).expect("small");
    let job = Job::default();
    let sound = written(&source, &job);
    let judge = |bytes: Vec<u8>| {
        let mut found = Diagnostics::default();
        let judged = pipeline::judge_program(&mut Cursor::new(bytes), &source, None, &job, None, &mut found);
        judged.expect("memory is read").expect("the source is sound").verdict
    };
    assert!(judge(sound.clone()).passes());
    let lines: Vec<&[u8]> = sound.split_inclusive(|&byte| byte == b'\n').collect();
    // The head makes it one of these files; without it nothing is judged as one.
    for i in 1..lines.len() {
        let mut without = lines.clone();
        without.remove(i);
        assert!(!judge(without.concat()).passes(), "line {i} is lost: {:?}", lines[i].escape_ascii().to_string());
        for digit in lines[i].iter().enumerate().filter(|(_, byte)| byte.is_ascii_digit()).map(|(at, _)| at) {
            let mut changed = lines[i].to_vec();
            changed[digit] = if changed[digit] == b'9' { b'8' } else { changed[digit] + 1 };
            let mut with = lines.clone();
            with[i] = &changed;
            assert!(!judge(with.concat()).passes(), "line {i} is {:?}", changed.escape_ascii().to_string());
        }
    }
}

#[test]
fn a_cut_file_cannot_keep_the_knife_up() {
    let source = Source::new("a.cut", b"H1*G71*N1*X0Y0*M14*X400Y0*M15*M0*".to_vec()).expect("small");
    let job = Job { mode: Mode::Dry, ..Job::default() };
    let mut found = Diagnostics::default();
    let order = Order { from: None, target: iso(), verify: true };
    let compiled = pipeline::compile(&source, &job, order, &mut Cursor::new(Vec::new()), &mut found);
    assert!(compiled.expect("memory takes it").is_none());
    assert_eq!(found.iter().last().map(|found| found.code.name), Some("target/refused"));
}
