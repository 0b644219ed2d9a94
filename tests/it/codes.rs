//! Every code of ISO cut files acts, or is said not to; every one can be switched off.

use std::io::Cursor;

use cutc::back::TARGETS;
use cutc::diagnostic::Diagnostics;
use cutc::ir::Finding;
use cutc::ir::text::print_marker;
use cutc::machine::profile::CodeUse;
use cutc::machine::{Job, keys};
use cutc::pipeline::{self, Order};
use cutc::source::Source;

/// What is read with the named codes ignored: the text of the marker without spans, then the codes of what was found, a
/// line each.
fn read(file: &str, ignored: &[&str]) -> String {
    let source = Source::new("a.cut", file.as_bytes().to_vec()).expect("small");
    let mut job = Job::default();
    job.profile.codes = ignored.iter().map(|name| ((*name).to_owned(), CodeUse::Ignore)).collect();
    let mut found = Diagnostics::default();
    let input = pipeline::read(&source, None, &job, &mut found).expect("a cut file");
    let text = print_marker(&input.marker);
    let line = |line: &str| line.split(' ').filter(|word| !word.starts_with('@')).collect::<Vec<_>>().join(" ");
    let lines = text.lines().map(line).chain(found.iter().map(|finding| finding.code.name.to_owned()));
    lines.map(|line| line + "\n").collect()
}

/// What the verifier finds wrong with the program of a file, read with the named codes ignored; nothing when there is none
/// because the file then has errors.
fn faults(file: &str, ignored: &[&str]) -> Vec<Finding> {
    let source = Source::new("a.cut", file.as_bytes().to_vec()).expect("small");
    let mut job = Job::default();
    job.profile.codes = ignored.iter().map(|name| ((*name).to_owned(), CodeUse::Ignore)).collect();
    let target = TARGETS.iter().find(|target| target.name == "csv").expect("setpoints are a target");
    let order = Order { from: None, target, verify: true };
    let mut out = Cursor::new(Vec::new());
    let compiled = pipeline::compile(&source, &job, order, &mut out, &mut Diagnostics::default());
    let verdict = compiled.expect("memory takes everything").and_then(|compiled| compiled.verdict);
    verdict.map_or_else(Vec::new, |verdict| verdict.broken().cloned().collect())
}

/// Blocks before the contour, at its start, at its last corner, behind it, and behind the last piece.
fn file([head, before, at_start, corner, behind, end]: [&str; 6]) -> String {
    format!(
        "H1*{head}M15*N1*{before}X0Y0*M14*{at_start}X1000Y0*{corner}X1000Y1000*X0Y0*M15*{behind}N2*M15*X2000Y0*M14*X3000Y0*\
         X3000Y1000*X2000Y0*M15*{end}"
    )
}

/// A code, the blocks that hold it and where they stand, and a line that they make: none for what changes nothing.
type Row = (&'static str, usize, &'static str, &'static str);

const HEAD: usize = 0;
const BEFORE: usize = 1;
const AT_START: usize = 2;
const CORNER: usize = 3;
const BEHIND: usize = 4;
const END: usize = 5;

const SILENT: &str = "";
const REPORTED: &str = "iso/ignored-code";

#[rustfmt::skip] // a table: one row a code
const ROWS: &[Row] = &[
    ("A", BEHIND, "A*", SILENT),
    ("B", BEHIND, "X5000Y0*B*X5500Y0*X5500Y900*X5000Y0*M15*", "  from 500 0 to 550 0"),
    ("E", CORNER, "E*", REPORTED),
    ("F", BEFORE, "F300*", "feed-mm-s 127"),
    ("H", HEAD, "H7*", SILENT),
    ("L", CORNER, "L*", "  to 100 100 percent 75"),
    ("N", BEHIND, "N9*X9000Y0*M14*X9500Y0*X9500Y900*X9000Y0*M15*", "piece 9"),
    ("O", CORNER, "O*", SILENT),
    ("Q", END, "QX3000Y0*", SILENT),
    ("R", BEFORE, "X800Y100R*", "drill 80 10 tool 1"),
    ("Z", HEAD, "ZX500*", REPORTED),
    ("D1", BEFORE, "D1*", SILENT),
    ("D2", BEFORE, "D2*", SILENT),
    ("D4", BEFORE, "D4*", SILENT),
    ("G0", CORNER, "G00*", REPORTED),
    ("G1", CORNER, "G01*", SILENT),
    ("G2", AT_START, "G02*", SILENT),
    ("G3", AT_START, "G03*", SILENT),
    ("G4", BEHIND, "G04*", REPORTED),
    ("G70", HEAD, "G70*", "marker unit-mm 0.0254"),
    ("G71", HEAD, "G71*", "marker unit-mm 0.1"),
    ("G90", HEAD, "G90*", SILENT),
    ("G91", HEAD, "G91*", SILENT),
    ("M0", CORNER, "M0*", REPORTED),
    ("M1", BEHIND, "M01*", "event stop"),
    ("M14", BEHIND, "X5000Y0*M14*X5500Y0*X5500Y900*X5000Y0*M15*", "  from 500 0 to 550 0"),
    ("M15", CORNER, "M15*M14*", "  to 100 100 lift"),
    ("M17", BEFORE, "M17*", "  from 0 0 to 100 0 full-advance"),
    ("M18", AT_START, "M18*", "  from 0 0 to 100 0 no-overcut"),
    ("M19", BEFORE, "M19*", "  from 0 0 to 100 0 full-advance no-overcut"),
    ("M20", HEAD, "M20*M19*", SILENT),
    ("M23", CORNER, "M23*", REPORTED),
    ("M25", CORNER, "M25*", "  to 100 100 percent 75"),
    ("M26", CORNER, "M26*", SILENT),
    ("M30", END, "M30*", SILENT),
    ("M31", BEFORE, "X800Y100M31*FRONT*", "label at 80 10"),
    ("M40", BEFORE, "M40*", REPORTED),
    ("M41", BEFORE, "M41*", REPORTED),
    ("M42", BEFORE, "M42*", REPORTED),
    ("M43", BEFORE, "X800Y100M43*", "drill 80 10 tool 1"),
    ("M44", BEFORE, "M44*X800Y100*", "drill 80 10 tool 2"),
    ("M45", BEFORE, "X800Y100*M45*", "drill 80 10 tool 3"),
    ("M46", AT_START, "M46*", "  to 100 100 lift"),
    ("M47", BEFORE, "M47*", REPORTED),
    ("M48", BEFORE, "M48*", REPORTED),
    ("M51", BEFORE, "M51*", REPORTED),
    ("M60", BEFORE, "M60*", "  to 100 100 percent 95"),
    ("M61", BEFORE, "M61*", "  to 100 100 percent 90"),
    ("M62", BEFORE, "M62*", "  to 100 100 percent 85"),
    ("M63", BEFORE, "M63*", "  to 100 100 percent 80"),
    ("M64", BEFORE, "M64*", "  to 100 100 percent 75"),
    ("M65", BEFORE, "M65*", "  to 100 100 percent 70"),
    ("M66", BEFORE, "M66*", "  to 100 100 percent 65"),
    ("M67", BEFORE, "M67*", "  to 100 100 percent 60"),
    ("M68", CORNER, "M68*", REPORTED),
    ("M69", BEHIND, "M69*", "event advance"),
    ("M70", BEHIND, "M70*", REPORTED),
    ("M72", BEFORE, "X800Y100M72*", "drill 80 10 tool 3"),
    ("M73", BEFORE, "X800Y100M73*", "drill 80 10 tool 4"),
];

#[test]
fn every_code_acts_or_is_reported_and_can_be_switched_off() {
    let named: Vec<&str> = ROWS.iter().map(|row| row.0).collect();
    assert_eq!(named, keys::CODE_NAMES);
    for &(code, place, blocks, effect) in ROWS {
        let with = |blocks: &'static str| {
            let mut parts = ["G71*", "", "", "", "", ""];
            if code.starts_with('G') {
                parts[HEAD] = "";
            }
            let whole = [parts[place], blocks].concat();
            parts[place] = &whole;
            file(parts) + "M0*"
        };
        // What the code's own blocks hold beside it goes on without it: only the effect must go.
        // Where the code is that of the default unit, its lack is a finding of its own.
        let read = |text: String, ignored: &[&str]| read(&text, ignored).replace("iso/no-unit\n", "");
        let (plain, obeyed, ignored) = (read(with(""), &[]), read(with(blocks), &[]), read(with(blocks), &[code]));
        assert_eq!(faults(&with(blocks), &[]), [], "{code}");
        assert_eq!(faults(&with(blocks), &[code]), [], "{code} is ignored");
        let has = |text: &str| text.lines().any(|line| line == effect);
        if effect == SILENT {
            assert_eq!(obeyed, plain, "{code}");
            // What the blocks of a text or a place hold must not come to light when their code is ignored.
            assert_eq!(ignored, plain, "{code} is ignored");
        } else {
            assert!(has(&obeyed) && !has(&plain), "{code}: no `{effect}` in\n{obeyed}");
            assert!(!has(&ignored), "{code} is ignored, but there is `{effect}` in\n{ignored}");
        }
    }
}

#[test]
fn a_code_that_is_ignored_leaves_what_is_cut_as_if_it_were_not_there() {
    // Not those whose blocks cut, and not those without which the rest of the file has another meaning.
    for &(code, place, blocks, _) in
        ROWS.iter().filter(|row| !["A", "B", "H", "N", "M0", "M14", "M15"].contains(&row.0))
    {
        let with = |blocks: &'static str| {
            let mut parts = [""; 6];
            parts[place] = blocks;
            file(parts) + "M0*"
        };
        assert_eq!(read(&with(blocks), &[code]), read(&with(""), &[code]), "{code}");
    }
}

#[test]
fn knives_and_pieces_are_switched_off_like_any_other_code() {
    let body = "X0Y0*M14*X1000Y0*X1000Y1000*X0Y0*M15*";
    let whole = format!("H1*G71*M15*N5*{body}M0*");
    assert!(read(&whole, &["M14"]).contains("iso/nothing-to-cut"));
    assert!(read(&whole, &["M15"]).contains("iso/ends-knife-down"));
    assert!(read(&whole, &["M0"]).contains("iso/no-end"));
    assert!(read(&whole, &["N"]).contains("piece 1\n"));
    let lettered = whole.replace("M14", "B").replace("M15", "A");
    assert_eq!(read(&lettered, &[]), read(&whole, &[]));
    assert!(read(&lettered, &["B"]).contains("iso/nothing-to-cut"));
    assert!(read(&lettered, &["A"]).contains("iso/ends-knife-down"));
}

#[test]
fn speeds_last_until_they_are_taken_back_or_the_next_piece() {
    let speeds = |blocks: &[(usize, &'static str)]| {
        let mut parts = ["G71*", "", "", "", "", ""];
        for &(place, text) in blocks {
            parts[place] = text;
        }
        let text = read(&(file(parts) + "M0*"), &[]);
        let percent =
            |line: &str| line.split_once("percent ").map_or(100, |(_, rest)| rest.parse::<u8>().expect("a number"));
        text.lines().filter(|line| line.starts_with("  ")).map(percent).collect::<Vec<u8>>()
    };
    assert_eq!(speeds(&[(BEFORE, "M64*")]), [75, 75, 75, 100, 100, 100]);
    assert_eq!(speeds(&[(BEFORE, "L*")]), [75, 75, 75, 100, 100, 100]);
    assert_eq!(speeds(&[(AT_START, "M25*"), (CORNER, "M26*")]), [75, 100, 100, 100, 100, 100]);
    assert_eq!(speeds(&[(AT_START, "L*"), (CORNER, "O*")]), [75, 100, 100, 100, 100, 100]);
    assert_eq!(speeds(&[(BEFORE, "M67*"), (CORNER, "M25*")]), [60, 45, 45, 100, 100, 100]);
    assert_eq!(speeds(&[(HEAD, "G71*L*")]), [100; 6]);
}

#[test]
fn overlaps_are_asked_for_once() {
    let text = read(&(file(["G71*", "M17*M18*", "", "M15*M14*", "", ""]) + "M0*"), &[]);
    // The plunge at the start is M17's, the lift at the corner M18's, and nothing is left for the next piece.
    assert!(text.contains("  from 0 0 to 100 0 full-advance\n  to 100 100 lift no-overcut\n"), "{text}");
    assert!(text.contains("  from 200 0 to 300 0\n"), "{text}");
    // M19 with the knife up ends with the piece.
    let text = read(&(file(["G71*", "", "", "", "M19*", ""]) + "M0*"), &[]);
    assert!(!text.contains("full-advance") && !text.contains("no-overcut"), "{text}");
}

#[test]
fn events_stand_before_the_piece_that_follows_or_behind_the_last() {
    let text = read(&(file(["G71*", "", "", "M69*", "M01*", "M01*"]) + "M0*"), &[]);
    assert!(text.contains("piece 2\nevent advance\nevent stop\n"), "{text}");
    assert!(text.ends_with("closing stop\n"), "{text}");
}

#[test]
fn what_stands_between_slashes_is_deleted_but_in_texts() {
    let plain = read(&(file(["G71*", "", "", "", "", ""]) + "M0*"), &[]);
    assert_eq!(
        read(&(file(["G71*", "/M67*X5Y5M43*/", "/M46*/", "X10/99/00Y500/*X1*/*", "", ""]) + "M0*"), &[]),
        plain.replace("  to 100 100\n", "  to 100 50\n  to 100 100\n") + "iso/deleted-passage\n"
    );
    let text = read(&(file(["G71*", "X10Y10M31*A/B/C*", "", "", "", ""]) + "M0*"), &[]);
    assert!(text.contains("label at 1 1\n"), "{text}");
}

#[test]
fn an_unknown_code_is_reported_once_and_changes_nothing() {
    let plain = read(&(file(["G71*", "", "", "", "", ""]) + "M0*"), &[]);
    let strange = read(&(file(["G71*", "M99*T5*M99*", "S3*", "", "", ""]) + "M0*"), &[]);
    assert_eq!(strange, plain + "iso/unknown-code\niso/unknown-code\niso/unknown-code\n");
}
