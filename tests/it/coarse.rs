//! Programs of G-code in few decimals, of straight lines alone, or truer than the chords of the file: what a compile makes
//! passes its own verifier.

use std::fmt::Write as _;
use std::io::Cursor;
use std::path::Path;

use cutc::back::TARGETS;
use cutc::diagnostic::Diagnostics;
use cutc::machine::{Job, Shipped, load};
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

fn job(keys: &[&str]) -> Job {
    let keys: Vec<String> = keys.iter().map(|&key| key.to_owned()).collect();
    Job { profile: load(None, &keys).expect("a legal profile"), ..Job::default() }
}

fn jobs() -> Vec<Job> {
    let table = Shipped::find("fluidnc").expect("it ships").source();
    let fluidnc = Job { profile: load(Some(&table), &[]).expect("a legal profile"), ..Job::default() };
    vec![job(&["gcode.decimals=3"]), job(&["gcode.arcs=false"]), fluidnc]
}

/// The files of the project.
fn files() -> impl Iterator<Item = Source> {
    let folders =
        ["markers", "iso", "hpgl"].map(|name| Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures").join(name));
    let paths = folders.into_iter().flat_map(|folder| std::fs::read_dir(folder).expect("a folder"));
    paths
        .map(|file| file.expect("readable").path())
        .map(|path| Source::new(path.to_string_lossy(), std::fs::read(&path).expect("readable")).expect("small"))
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
    let jobs = jobs();
    let made = |source: &Source| jobs.iter().filter(|job| compiles(source, job)).count();
    let programs: usize = files().map(|source| made(&source)).sum();
    assert!(programs >= PROGRAMS_MIN, "{programs} programs");
}

#[test]
fn a_staircase_of_rounded_points_is_cut_as_the_curve_that_it_was() {
    for job in jobs() {
        assert!(compiles(&staircase(), &job), "{:?}", job.profile.gcode);
    }
}

#[test]
fn what_can_be_cut_can_be_cut_truer_than_the_chords_of_the_file() {
    let fine = [job(&["path.tolerance_mm=0.02"]), job(&["path.tolerance_mm=0.005"])];
    for source in files().filter(|source| compiles(source, &Job::default())) {
        assert!(fine.iter().all(|job| compiles(&source, job)), "{}", source.name());
    }
}
