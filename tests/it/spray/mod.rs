//! Heads at a distance: every edge that can be faced is followed at its speed, and what does not is refused.

mod command;
mod damage;
mod laws;
mod shapes;

use std::fmt::Write as _;
use std::io::Cursor;

use cutc::back::TARGETS;
use cutc::diagnostic::{Diagnostics, render};
use cutc::machine::{Job, MachineProfile, load};
use cutc::machines::{self, Claim, Written};
use cutc::pipeline::{Advance, Choices, Compiled, Product};
use cutc::sew::Asked;
use cutc::source::Source;

use crate::support::damage::names;

fn fixture(name: &str) -> Source {
    let path = format!("{}/fixtures/{name}", env!("CARGO_MANIFEST_DIR"));
    let bytes = std::fs::read(&path).unwrap_or_else(|error| panic!("{path}: {error}"));
    Source::new(name.rsplit('/').next().expect("a name"), bytes).expect("small")
}

/// The head of the fixtures, with some keys set.
fn job(sets: &[&str]) -> Job {
    job_of("machines/spray.toml", sets)
}

/// The head of a profile, with some keys set.
fn job_of(profile: &str, sets: &[&str]) -> Job {
    let sets: Vec<String> = sets.iter().map(ToString::to_string).collect();
    let profile: MachineProfile = load(Some(&fixture(profile)), &sets).expect("a legal profile");
    Job { profile, ..Job::default() }
}

/// The profile of the study of one polynomial an edge.
const PLAIN: &str = "machines/spray-plain.toml";

/// A compile to a target with its bytes; or what is said of it.
fn compiled(source: &Source, target: &str, job: &Job) -> Result<(Compiled, Vec<u8>, String), String> {
    let target = TARGETS.iter().find(|row| row.name == target).expect("a target");
    let mut bytes = Cursor::new(Vec::new());
    let mut out = Diagnostics::default();
    let choices = Choices { from: None, verify: true, advance: &Advance::default() };
    let compile = machines::tool_of(job).compile;
    let compiled = compile(source, job, choices, &mut [Product::new(target, &mut bytes)], &mut out);
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
    let open =
        |name: &str| -> std::io::Result<Box<dyn std::io::BufRead>> { unreachable!("{name}: a program is one file") };
    let claim = Claim { name: "program.csv", target: None };
    let mut written = Written { claim, bytes: &mut program, open: &open, declared: None };
    let judge = machines::of(job).judge.expect("its programs are judged");
    let judged = judge(&mut written, source, &Asked::default(), job, &mut out).expect("memory is readable");
    judged.expect("a source without errors").verdict.broken().map(|finding| finding.rule.name).collect()
}

#[test]
fn every_edge_is_followed_by_either_planner_and_what_is_not_reached_is_said() {
    let mut all = String::new();
    for name in names("spray") {
        let source = fixture(&name);
        for planner in ["optimal", "quintic"] {
            let (_, program, said) = compiled(&source, "csv", &job(&[&format!("tool.planner={planner}")]))
                .unwrap_or_else(|said| panic!("{name} {planner}: {said}"));
            assert!(program.starts_with(b"t_s,x_mm,y_mm,c_deg,vx_mm_s,vy_mm_s,jet,block\n0.000000,-400.000000"));
            let _ = writeln!(all, "{name} {planner}\n{said}");
        }
    }
    insta::assert_snapshot!(all);
}

#[test]
fn the_figures_of_the_study_hold_for_a_rectangle_with_one_curved_side() {
    let panel = fixture("spray/panel.csv");
    let edges = |job: &Job| {
        let (compiled, ..) = compiled(&panel, "csv", job).unwrap_or_else(|said| panic!("{said}"));
        let edges = compiled.report.edges.expect("a head follows edges");
        assert_eq!(edges.len(), 4, "three straight sides and a curve between four corners");
        edges
    };
    // One polynomial an edge: the figures that were published for a painting head.
    let plain = edges(&job_of(PLAIN, &[]));
    for (i, edge) in plain.iter().enumerate() {
        let [least, mean, most] = edge.speed_mm_s;
        assert_eq!(edge.pieces.len(), 1);
        if i == 1 {
            assert!(edge.deviation_mm <= 40.0 && least >= 400.0 && most <= 480.0, "{edge:?}");
            assert!((mean - 450.0).abs() < 1.0, "{edge:?}");
        } else {
            assert!(edge.deviation_mm <= 10.0 && (least - 300.0).abs() < 0.5 && (most - 300.0).abs() < 0.5, "{edge:?}");
        }
    }
    // Split, and by the default planner: within the tolerance, and on the curve as fast from its first centimetre on.
    let (split, optimal) = (edges(&job(&["tool.planner=quintic"])), edges(&job(&[])));
    assert!(split.iter().chain(&optimal).all(|edge| edge.deviation_mm <= 0.05));
    assert!(split.iter().zip(&plain).all(|(split, plain)| split.pieces.len() > plain.pieces.len()));
    for edges in [split, optimal] {
        let [least, _, most] = edges[1].speed_mm_s;
        assert!(least >= 395.0 && most <= 480.0, "{least} to {most} mm/s on the curve");
    }
    let condition =
        |sets: &[&str]| edges(&job_of(PLAIN, sets)).iter().map(|edge| edge.pieces[0].condition).fold(0.0, f64::max);
    assert!(condition(&[]) < 10.0);
    assert!(condition(&["quintic.basis=monomial"]) > 1e12);
}

/// A ring of points as a file.
fn drawing(name: &str, points: impl Iterator<Item = [f64; 2]>) -> Source {
    let mut points: Vec<[f64; 2]> = points.collect();
    points.push(points[0]);
    let rows: Vec<String> = points.iter().map(|[x, y]| format!("{x:.4},{y:.4}\n")).collect();
    Source::new(name, format!("x_mm,y_mm\n{}", rows.concat()).into_bytes()).expect("small")
}

#[test]
fn curves_of_coarse_chords_are_followed_as_curves_by_either_planner() {
    // Circles and ellipses whose chords leave them by up to half a millimetre, as CAD systems write them.
    for (long, short, count) in [(100.0, 100.0, 33), (250.0, 250.0, 51), (600.0, 600.0, 110), (500.0, 400.0, 90)] {
        let at = |i: usize| {
            let (sin, cos) = (std::f64::consts::TAU * i as f64 / f64::from(count)).sin_cos();
            [1000.0 + long * cos, 800.0 + short * sin]
        };
        let source = drawing("round.csv", (0..count as usize).map(at));
        for planner in ["optimal", "quintic"] {
            let (compiled, _, said) = compiled(&source, "csv", &job(&[&format!("tool.planner={planner}")]))
                .unwrap_or_else(|said| panic!("{long} x {short}, {planner}: {said}"));
            assert!(!said.contains("spray/coarse"), "{long} x {short}, {planner}: {said}");
            let edges = compiled.report.edges.expect("edges");
            assert!(edges.iter().all(|edge| edge.deviation_mm <= 0.05), "{edges:?}");
        }
    }
    // Coarser than the profile says: that is told, with what to change.
    let hexagon = |i: usize| {
        let (sin, cos) = (std::f64::consts::TAU * i as f64 / 24.0).sin_cos();
        [1000.0 + 100.0 * cos, 800.0 + 100.0 * sin]
    };
    let source = drawing("coarse.csv", (0..24).map(hexagon));
    let mut out = Diagnostics::default();
    (machines::of(&job(&[])).check)(&source, &Asked::default(), &job(&[]), &mut out);
    let said = render(&out, &source);
    assert!(said.contains("spray/coarse") && said.contains("`path.chord_sag_max_mm` = 0.9"), "{said}");
}

#[test]
fn a_way_of_half_a_millimetre_between_two_stops_is_driven() {
    let slot = [[0.0, 0.0], [2000.0, 0.0], [2000.0, 1200.0], [1300.25, 1200.0], [1300.25, 200.0], [699.75, 200.0]];
    let slot = drawing("slot.csv", slot.into_iter().chain([[699.75, 1200.0], [0.0, 1200.0]]));
    for planner in ["optimal", "quintic"] {
        let (_, program, _) = compiled(&slot, "csv", &job(&[&format!("tool.planner={planner}")]))
            .unwrap_or_else(|said| panic!("{planner}: {said}"));
        assert!(!String::from_utf8_lossy(&program).contains("NaN"));
    }
}

#[test]
fn a_frame_goes_round_the_box_of_the_way_without_a_jet() {
    let panel = fixture("spray/panel.csv");
    let frame = Job { mode: cutc::machine::Mode::Frame, ..job(&[]) };
    let (_, program, _) = compiled(&panel, "csv", &frame).unwrap_or_else(|said| panic!("{said}"));
    let rows: Vec<Vec<f64>> = String::from_utf8(program)
        .expect("text")
        .lines()
        .skip(1)
        .map(|row| row.split(',').map(|field| field.parse().expect("a number")).collect())
        .collect();
    let range = |column: usize| {
        let values = rows.iter().map(|row| row[column]);
        values.fold([f64::INFINITY, f64::NEG_INFINITY], |[least, most], value| [least.min(value), most.max(value)])
    };
    // The head runs 300 mm around a part of 980.4 x 600 mm, from home at -400, -400.
    for (column, expected) in [(1, [-400.0, 1280.4]), (2, [-400.0, 900.0]), (3, [0.0; 2]), (6, [0.0; 2])] {
        let [least, most] = range(column);
        assert!((least - expected[0]).abs() < 0.1 && (most - expected[1]).abs() < 0.1, "{column}: {least} to {most}");
    }
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
        ("csv", &["table.x_mm=[-200, 3000]"]),
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
