//! The second reading agrees with the first, and sees what is changed.

use cutc::back::TARGETS;
use cutc::diagnostic::{Diagnostics, render};
use cutc::geom::{Point, Vector};
use cutc::ir::Marker;
use cutc::ir::marker::Contour;
use cutc::machine::Job;
use cutc::machine::patterns::{Patterns, Sizes};
use cutc::pipeline::{self, Order};
use cutc::source::{Source, Span};
use cutc::verify::{CutPlaces, pattern_audit};
use std::io::Cursor;

use super::{as_read, fixtures, source};

/// The rules of the audit that do not hold.
pub(super) fn broken(source: &Source, marker: &Marker, job: &Job) -> Vec<&'static str> {
    let findings = pattern_audit(source.bytes(), &CutPlaces::of(marker), job);
    assert_eq!(findings.len(), 4);
    findings.iter().filter(|finding| !finding.holds()).map(|finding| finding.rule.name).collect()
}

#[test]
fn every_fixture_is_read_twice_alike_in_all_of_its_sizes() {
    for (path, bytes) in fixtures() {
        let source = source(bytes);
        for sizes in [None, Some(Sizes::All)] {
            let job = Job { patterns: Patterns { sizes, ..Patterns::default() }, ..Job::default() };
            let (marker, _) = as_read(&source, &job);
            assert!(marker.contours().count() > 0, "{}", path.display());
            assert_eq!(broken(&source, &marker, &job), [""; 0], "{}", path.display());
        }
    }
}

#[test]
fn every_fixture_becomes_programs_that_are_verified() {
    for (path, bytes) in fixtures() {
        let source = source(bytes);
        for name in ["csv", "gcode", "iso"] {
            let target = TARGETS.iter().find(|target| target.name == name).expect("a target");
            let mut found = Diagnostics::default();
            let order = Order { from: None, target, verify: true };
            let compiled = pipeline::compile(&source, &Job::default(), order, &mut Cursor::new(Vec::new()), &mut found);
            let is_made = compiled.expect("memory takes everything").is_some();
            assert!(is_made, "{} {name}: {}", path.display(), render(&found, &source));
        }
    }
}

#[test]
fn pieces_of_other_sizes_are_seen_whatever_letters_keys_are_written_in() {
    let names = ["keys-in-gbk", "keys-in-windows-1252", "keys-with-codes-of-letters"];
    for (path, bytes) in
        fixtures().into_iter().filter(|(path, _)| names.iter().any(|name| path.ends_with(format!("{name}.dxf"))))
    {
        let source = source(bytes);
        let all = Job { patterns: Patterns { sizes: Some(Sizes::All), ..Patterns::default() }, ..Job::default() };
        let (of_all, of_one) = (as_read(&source, &all).0, as_read(&source, &Job::default()).0);
        assert_eq!([of_all.pieces.len(), of_one.pieces.len()], [6, 2], "{}", path.display());
        assert_eq!(broken(&source, &of_one, &Job::default()), [""; 0], "{}", path.display());
        assert_eq!(broken(&source, &of_all, &all), [""; 0], "{}", path.display());
        assert!(!broken(&source, &of_all, &Job::default()).is_empty(), "{}", path.display());
    }
}

/// What is changed, and the rule that must see it.
type Change = (&'static str, fn(&mut Marker));

#[test]
fn what_the_reader_would_lose_or_move_is_seen() {
    let changes: [Change; 10] = [
        ("source/points", |marker| marker.list.move_points(|at| at + Vector::new(0.01, 0.0))),
        ("source/points", |marker| marker.list.move_points(|at| Point::new(-at.x, at.y))),
        ("source/points", |marker| _ = marker.pieces[0].contours.remove(0)),
        ("source/length", |marker| {
            let again = marker.pieces[0].contours[0];
            marker.pieces[0].contours.push(again);
        }),
        ("source/drills", |marker| _ = marker.pieces[0].drills.pop()),
        ("source/drills", |marker| marker.pieces[0].drills[0].at.x += 0.01),
        ("source/notches", |marker| _ = marker.pieces[0].notches.pop()),
        ("source/notches", |marker| marker.pieces[0].notches[0].root.y += 2.0),
        ("source/notches", |marker| marker.pieces[0].notches[0].tip.x -= 1.0),
        ("source/notches", |marker| marker.pieces[0].notches[0].span.block += 1),
    ];
    check("half-piece.dxf", &changes);
}

#[test]
fn a_notch_that_the_outline_makes_is_missed_and_so_is_a_corner_beside_it() {
    let changes: [Change; 3] = [
        // A notch of the outline is lost when its way is no longer of its block.
        ("source/notches", |marker| {
            for k in 0..marker.pieces[0].contours.len() {
                let contour = marker.pieces[0].contours[k];
                let kept: Vec<(Point, Span)> = outline_without_a_notch(marker, contour);
                let (points, spans): (Vec<Point>, Vec<Span>) = kept.into_iter().unzip();
                let range = marker.list.append_line(&points, &spans).expect("a line");
                marker.pieces[0].contours[k] = Contour { range, ..contour };
            }
        }),
        ("source/notches", |marker| marker.pieces[0].notches.clear()),
        ("source/notches", |marker| {
            let account = marker.drawing.as_mut().expect("an account");
            account.notches_left_out.clear();
            marker.pieces[0].notches.clear();
        }),
    ];
    check("notches-of-all-kinds.dxf", &changes);
}

/// The places of a contour without those of the notch whose way is longest.
fn outline_without_a_notch(marker: &Marker, contour: Contour) -> Vec<(Point, Span)> {
    let all: Vec<(Point, Span)> = marker.list.vertices(contour.range).collect();
    let longest = all.chunk_by(|a, b| a.1 == b.1).max_by_key(|run| run.len()).map(|run| run[0].1);
    all.into_iter().filter(|(_, span)| Some(*span) != longest).collect()
}

/// Each change of what is read of a fixture breaks its rule.
fn check(fixture: &str, changes: &[Change]) {
    let (_, bytes) = fixtures().into_iter().find(|(path, _)| path.ends_with(fixture)).expect("a fixture");
    let (source, job) = (source(bytes), Job::default());
    for (k, (rule, change)) in changes.iter().enumerate() {
        let (mut marker, _) = as_read(&source, &job);
        change(&mut marker);
        let broken = broken(&source, &marker, &job);
        assert!(broken.contains(rule), "{fixture}, change {k}: {broken:?}");
    }
}

#[test]
fn of_two_layouts_that_a_file_may_mean_the_nearer_is_reported() {
    let name = "inserts-that-are-no-places.dxf";
    let (_, bytes) = fixtures().into_iter().find(|(path, _)| path.ends_with(name)).expect("a fixture");
    let (source, job) = (source(bytes), Job::default());
    let (mut marker, _) = as_read(&source, &job);
    let contour = marker.pieces[0].contours[0];
    let (mut points, spans): (Vec<Point>, Vec<Span>) = marker.list.vertices(contour.range).unzip();
    points[1].x += 0.5;
    let range = marker.list.append_line(&points, &spans).expect("a line");
    marker.pieces[0].contours[0] = Contour { range, ..contour };
    let findings = pattern_audit(source.bytes(), &CutPlaces::of(&marker), &job);
    // The pieces lie in a row, where a vertex is missing and another is too many. Few would be where INSERTs put them.
    let points = findings.iter().find(|finding| finding.rule.name == "source/points").expect("a rule");
    assert_eq!(points.worst.to_bits(), 2.0_f64.to_bits(), "{}", points.worst);
}
