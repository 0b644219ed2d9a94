//! Files that are cut short, and files with groups that are lost, doubled or changed.

use std::panic::{AssertUnwindSafe, catch_unwind};

use cutc::geom::Point;
use cutc::ir::Marker;
use cutc::machine::Job;
use fastrand::Rng;

use super::audit::broken;
use super::{as_read, fixtures, source};

/// Damages of each file.
const DAMAGES: usize = 150;

/// Lines of a file, which end with line feeds or with carriage returns alone.
fn lines_of(bytes: &[u8]) -> Vec<&[u8]> {
    let end = if bytes.contains(&b'\n') { b'\n' } else { b'\r' };
    bytes.split(|&byte| byte == end).collect()
}

/// Reads what is damaged: nothing panics, and what is read without errors the second reading finds as well. Gives the rules
/// that are broken, and the file.
fn check(lines: &[&[u8]], what: &str) -> Option<String> {
    let source = source(lines.join(&b'\n'));
    let outcome = catch_unwind(AssertUnwindSafe(|| {
        let (marker, _) = as_read(&source, &Job::default());
        if marker.contours().count() > 0 { broken(&source, &marker, &Job::default()) } else { Vec::new() }
    }));
    let broken = outcome.unwrap_or_else(|_| panic!("{what} panics"));
    (!broken.is_empty()).then(|| format!("{what}: {broken:?}\n{}", source.bytes().escape_ascii()))
}

#[test]
fn a_file_cut_short_at_any_line_is_refused() {
    for (path, bytes) in fixtures() {
        let lines: Vec<&[u8]> = lines_of(&bytes);
        // Behind the last line stands nothing.
        for count in (0..lines.len() - 2).step_by(if lines.len() > 500 { 17 } else { 1 }) {
            let source = source(lines[..count].join(&b'\n'));
            let (marker, found) = as_read(&source, &Job::default());
            let is_refused = marker.pieces.is_empty() && !found.is_empty();
            assert!(is_refused, "{} behind line {count}: {found:?}", path.display());
        }
    }
}

/// Whether the value behind a code decides where or what the knife cuts, when it stands in an entity that is cut.
fn is_number_of_a_cut(kind: &[u8], code: &[u8]) -> bool {
    match kind {
        b"POLYLINE" | b"SEQEND" => code == b"70",
        b"VERTEX" => matches!(code, b"10" | b"20" | b"42" | b"70"),
        b"LWPOLYLINE" => matches!(code, b"10" | b"20" | b"42" | b"70" | b"90" | b"230"),
        b"LINE" => matches!(code, b"10" | b"20" | b"11" | b"21"),
        b"ARC" | b"CIRCLE" => matches!(code, b"10" | b"20" | b"40" | b"50" | b"51"),
        b"POINT" => matches!(code, b"10" | b"20" | b"30" | b"39" | b"50"),
        b"INSERT" => matches!(code, b"10" | b"20" | b"41" | b"42" | b"50" | b"70" | b"71"),
        b"BLOCK" => matches!(code, b"10" | b"20"),
        _ => false,
    }
}

/// All places that a marker cuts and drills.
fn cuts(marker: &Marker) -> Vec<Vec<Point>> {
    let lines = marker.contours().map(|(_, contour)| marker.points(contour));
    let notches = marker.pieces.iter().flat_map(|piece| &piece.notches).map(|notch| vec![notch.root, notch.tip]);
    let holes = marker.pieces.iter().flat_map(|piece| &piece.drills).map(|drill| vec![drill.at]);
    lines.chain(notches).chain(holes).collect()
}

#[test]
fn one_damaged_number_of_what_is_cut_refuses_the_file_or_changes_nothing() {
    for (path, bytes) in fixtures() {
        let lines: Vec<&[u8]> = lines_of(&bytes).into_iter().map(<[u8]>::trim_ascii).collect();
        let (whole, _) = as_read(&source(bytes.clone()), &Job::default());
        let mut kind: &[u8] = b"";
        let mut tried = 0;
        for pair in (0..lines.len() - 1).step_by(2) {
            if lines[pair] == b"0" {
                kind = lines[pair + 1];
            }
            if !is_number_of_a_cut(kind, lines[pair]) {
                continue;
            }
            tried += 1;
            // Of long files some are enough: they repeat the same entities.
            if tried > 60 && tried % 23 != 0 {
                continue;
            }
            let mut damaged = lines.clone();
            damaged[pair + 1] = b"1O";
            let (marker, found) = as_read(&source(damaged.join(&b'\n')), &Job::default());
            let is_refused = marker.contours().count() == 0 && !found.is_empty();
            assert!(is_refused || cuts(&marker) == cuts(&whole), "{} line {}: {found:?}", path.display(), pair + 2);
        }
        assert!(tried > 3, "{}", path.display());
    }
}

#[test]
fn damaged_groups_never_panic_and_what_is_read_all_the_same_is_what_stands_there() {
    let mut faults: Vec<String> = Vec::new();
    for (path, bytes) in fixtures() {
        let lines: Vec<&[u8]> = lines_of(&bytes);
        let mut random = Rng::with_seed(bytes.len() as u64);
        for k in 0..DAMAGES {
            let mut damaged = lines.clone();
            let pair = 2 * random.usize(..lines.len() / 2);
            let other = 2 * random.usize(..lines.len() / 2);
            match random.u8(..6) {
                0 => _ = damaged.drain(pair..pair + 2),
                1 => damaged.splice(pair..pair, lines[other..other + 2].iter().copied()).for_each(drop),
                2 => damaged.swap(pair + 1, other + 1),
                3 => _ = damaged.remove(random.usize(..lines.len())),
                4 => damaged[pair + 1] = [&b"1"[..], b"-40", b"6", b"1e9", b"x", b"", b"11"][random.usize(..7)],
                _ => damaged[pair] = [&b"  0"[..], b" 10", b" 42", b" 70", b"8", b" 50"][random.usize(..6)],
            }
            faults.extend(check(&damaged, &format!("{} damage {k}", path.display())));
        }
    }
    assert!(faults.is_empty(), "{} files are read wrongly\n{}", faults.len(), faults.join("\n"));
}
