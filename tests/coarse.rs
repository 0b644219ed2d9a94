//! Programs of G-code in few decimals, or of straight lines alone: what a compile makes passes its own verifier.

use std::fmt::Write as _;
use std::io::Cursor;
use std::path::Path;

use cutc::back::TARGETS;
use cutc::diagnostic::Diagnostics;
use cutc::machine::{Job, load};
use cutc::pipeline::{self, Order};
use cutc::source::Source;

/// Fewest programs that the files of the project make with all jobs together: nine of ten are sound.
const PROGRAMS_MIN: usize = 400;

/// A contour that is drawn so finely that its points are rounded to a staircase of 0.1 mm.
fn staircase() -> Source {
    let mut text = String::from("N1*G71*");
    let count = 1800;
    for i in 0..=count {
        let angle = f64::from(i % count) * std::f64::consts::TAU / f64::from(count);
        let radius = 800.0 + 40.0 * (4.0 * angle).sin();
        let [x, y] = [angle.cos(), angle.sin()].map(|part| (1000.0 + radius * part + 0.5).floor());
        // Writing into a `String` cannot fail.
        let _ = write!(text, "X{x}Y{y}*{}", if i == 0 { "M14*" } else { "" });
    }
    Source::new("staircase.cut", format!("{text}M15*M0*").into_bytes()).expect("it is small")
}

fn jobs() -> Vec<Job> {
    let job = |profile| Job { profile, ..Job::default() };
    let with = |set: &str| job(load(None, &[set.to_owned()]).expect("a legal profile"));
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/machines/fluidnc.toml");
    let table = Source::new("fluidnc.toml", std::fs::read(path).expect("readable")).expect("it is small");
    let fluidnc = job(load(Some(&table), &[]).expect("a legal profile"));
    vec![with("gcode.decimals=3"), with("gcode.arcs=false"), fluidnc]
}

/// Whether a source makes a program; the verifier refuses none.
fn compiles(source: &Source, job: &Job) -> bool {
    let (mut out, mut said) = (Cursor::new(Vec::new()), Diagnostics::default());
    let target = TARGETS.iter().find(|target| target.name == "gcode").expect("a target");
    let order = Order { from: None, target, verify: true };
    let compiled = pipeline::compile(source, job, order, &mut out, &mut said).expect("memory takes it");
    let is_broken = said.iter().any(|said| said.code.name == "verify/broken");
    assert!(!is_broken, "{}: {said:?}, {}", source.name(), compiled.is_some());
    compiled.is_some()
}

#[test]
fn what_a_verifier_refuses_is_not_made_of_the_files_of_the_project() {
    let fixtures = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures");
    let mut programs = 0;
    for folder in ["markers", "iso", "hpgl"] {
        let files = std::fs::read_dir(fixtures.join(folder)).expect("a folder");
        for path in files.map(|file| file.expect("readable").path()) {
            let source = Source::new(path.to_string_lossy(), std::fs::read(&path).expect("readable")).expect("small");
            for job in jobs() {
                programs += usize::from(compiles(&source, &job));
            }
        }
    }
    assert!(programs >= PROGRAMS_MIN, "{programs} programs");
}

#[test]
fn a_staircase_of_rounded_points_is_cut_as_the_curve_that_it_was() {
    for job in jobs() {
        assert!(compiles(&staircase(), &job), "{:?}", job.profile.gcode);
    }
}
