//! Heads at a distance: every edge that can be faced is followed at its speed, and what does not is refused.

mod command;
mod damage;
mod laws;

use std::fmt::Write as _;
use std::io::Cursor;

use cutc::back::TARGETS;
use cutc::diagnostic::{Diagnostics, render};
use cutc::machine::{Job, MachineProfile, load};
use cutc::pipeline::{Choices, Compiled, Product, compile_all, judge_program};
use cutc::source::Source;

use crate::support::damage::names;

fn fixture(name: &str) -> Source {
    let path = format!("{}/fixtures/{name}", env!("CARGO_MANIFEST_DIR"));
    let bytes = std::fs::read(&path).unwrap_or_else(|error| panic!("{path}: {error}"));
    Source::new(name.rsplit('/').next().expect("a name"), bytes).expect("small")
}

/// The head of the fixtures, with some keys set.
fn job(sets: &[&str]) -> Job {
    let sets: Vec<String> = sets.iter().map(ToString::to_string).collect();
    let profile: MachineProfile = load(Some(&fixture("machines/spray.toml")), &sets).expect("a legal profile");
    Job { profile, ..Job::default() }
}

/// A compile to a target with its bytes; or what is said of it.
fn compiled(source: &Source, target: &str, job: &Job) -> Result<(Compiled, Vec<u8>, String), String> {
    let target = TARGETS.iter().find(|row| row.name == target).expect("a target");
    let mut bytes = Cursor::new(Vec::new());
    let mut out = Diagnostics::default();
    let choices = Choices { from: None, verify: true };
    let compiled = compile_all(source, job, choices, &mut [Product::new(target, &mut bytes)], &mut out);
    let said = render(&out, source);
    match compiled.expect("memory takes bytes") {
        Some(compiled) => Ok((compiled, bytes.into_inner(), said)),
        None => Err(said),
    }
}

/// The rules that a program of a source breaks.
fn broken(source: &Source, program: &[u8], job: &Job) -> Vec<&'static str> {
    let mut out = Diagnostics::default();
    let mut program = Cursor::new(program.to_vec());
    let judged = judge_program(&mut program, source, None, job, None, &mut out).expect("memory is readable");
    judged.expect("a source without errors").verdict.broken().map(|finding| finding.rule).collect()
}

/// The study of one polynomial an edge, with tolerances as wide as it asks for.
const STUDY: [&str; 5] = [
    "tool.planner=quintic",
    "quintic.split=false",
    "path.tolerance_mm=40",
    "verify.max_heading_deg=20",
    "tool.edge_speed_percent=50",
];

#[test]
fn every_edge_is_followed_by_either_planner_and_what_is_not_reached_is_said() {
    let mut all = String::new();
    for name in names("spray") {
        let source = fixture(&name);
        for planner in ["optimal", "quintic"] {
            let (_, program, said) = compiled(&source, "csv", &job(&[&format!("tool.planner={planner}")]))
                .unwrap_or_else(|said| panic!("{name} {planner}: {said}"));
            assert!(program.starts_with(b"t_s,x_mm,y_mm,c_deg,vx_mm_s,vy_mm_s,jet,block\n0.000000,-400.000000"));
            if planner == "optimal" {
                let _ = writeln!(all, "{name}\n{said}");
            }
        }
    }
    insta::assert_snapshot!(all);
}

#[test]
fn the_figures_of_the_study_hold_for_a_rectangle_with_one_curved_side() {
    let panel = fixture("spray/panel.csv");
    let edges = |sets: &[&str]| {
        let (compiled, ..) = compiled(&panel, "csv", &job(sets)).unwrap_or_else(|said| panic!("{said}"));
        let edges = compiled.report.edges.expect("a head follows edges");
        assert_eq!(edges.len(), 4, "three straight sides and a curve between four corners");
        (edges, compiled.report.program.time_s.expect("a program takes time"))
    };
    // One polynomial an edge: the figures that were published for a painting head.
    let (plain, _) = edges(&STUDY);
    for (i, edge) in plain.iter().enumerate() {
        let [least, mean, most] = edge.speed_mm_s;
        assert_eq!(edge.pieces.len(), 1);
        if i == 1 {
            assert!(edge.deviation_mm <= 40.0 && least >= 400.0 && most <= 480.0, "{edge:?}");
            assert!((mean - 450.0).abs() < 10.0, "{edge:?}");
        } else {
            assert!(edge.deviation_mm <= 10.0 && (least - 300.0).abs() < 0.5 && (most - 300.0).abs() < 0.5, "{edge:?}");
        }
    }
    // Split, and by the default planner: within the tolerance.
    let (split, _) = edges(&["tool.planner=quintic"]);
    let (optimal, _) = edges(&[]);
    assert!(split.iter().chain(&optimal).all(|edge| edge.deviation_mm <= 0.05));
    assert!(split.iter().zip(&plain).all(|(split, plain)| split.pieces.len() > plain.pieces.len()));
    let condition = |sets: &[&str]| edges(sets).0.iter().map(|edge| edge.pieces[0].condition).fold(0.0, f64::max);
    assert!(condition(&STUDY) < 10.0);
    assert!(condition(&[&STUDY[..], &["quintic.basis=monomial"]].concat()) > 1e12);
}

#[test]
fn a_file_without_an_edge_that_can_be_followed_is_refused() {
    let mut all = String::new();
    for name in names("invalid/spray") {
        let said = compiled(&fixture(&name), "csv", &job(&[])).err();
        let _ = writeln!(all, "{name}\n{}", said.unwrap_or_else(|| panic!("{name} is refused")));
    }
    let panel = fixture("spray/panel.csv");
    for (target, sets) in [
        ("gcode", &[][..]),
        ("csv", &["c.range_deg=[-200, 200]"]),
        ("csv", &["tool.planner=quintic", "quintic.split=false"]),
        ("csv", &["tool.planner=quintic", "axes.c.jerk_deg_s3=100"]),
    ] {
        let said = compiled(&panel, target, &job(sets)).err();
        let _ = writeln!(all, "{target} {sets:?}\n{}", said.unwrap_or_else(|| panic!("{target} {sets:?} is refused")));
    }
    insta::assert_snapshot!(all);
}

#[test]
fn a_picture_shows_edges_course_and_speeds() {
    let (_, picture, _) = compiled(&fixture("spray/panel.csv"), "svg", &job(&[])).expect("a picture");
    let picture = String::from_utf8(picture).expect("text");
    for class in ["part", "course", "way", "air", "aim", "jet"] {
        assert!(picture.contains(&format!("<path class=\"{class}\" d=\"M")), "{class}");
    }
    assert!(!picture.contains("NaN") && !picture.contains("inf"));
}
