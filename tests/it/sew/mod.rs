//! The pattern-sewing machine: what is read, what is sewn how fast, and what is written.

mod damage;
mod files;
mod laws;

use cutc::diagnostic::{Diagnostics, render};
use cutc::machine::Job;
use cutc::sew::{self, Asked, Program, TARGETS, Target};
use cutc::source::Source;

/// The bytes of a fixture.
fn fixture(name: &str) -> Vec<u8> {
    let path = format!("{}/fixtures/{name}", env!("CARGO_MANIFEST_DIR"));
    std::fs::read(&path).unwrap_or_else(|error| panic!("{path}: {error}"))
}

/// What is planned of some bytes, and what is said of them.
fn plan(name: &str, bytes: Vec<u8>, job: &Job) -> (Option<Program>, String, Diagnostics) {
    let source = Source::new(name.rsplit('/').next().expect("a name"), bytes).expect("small");
    let mut out = Diagnostics::default();
    let program = sew::plan(&source, &Asked::default(), job, &mut out);
    let said = render(&out, &source);
    (program, said, out)
}

/// What is planned of a fixture.
fn planned(name: &str, job: &Job) -> Program {
    let (program, said, _) = plan(name, fixture(name), job);
    program.unwrap_or_else(|| panic!("{name}: {said}"))
}

/// A target by its name.
fn target(name: &str) -> &'static Target {
    TARGETS.iter().find(|target| target.name == name).expect("a target")
}

/// The bytes of a program.
fn written(program: &Program, job: &Job, name: &str) -> Vec<u8> {
    let mut bytes = Vec::new();
    (target(name).write)(program, job, &mut bytes).expect("a vector takes bytes");
    bytes
}

/// The codes of the rules that some bytes break, of a program that was made from others.
fn broken(program: &Program, original: &[u8], job: &Job, (name, bytes): (&str, &[u8])) -> Vec<&'static str> {
    let source = Source::new("original", original.to_vec()).expect("small");
    let verdict = sew::judge(program, &source, job, target(name).proof, &mut &bytes[..]).expect("memory is readable");
    verdict.expect("the target is judged").broken().map(|finding| finding.rule).collect()
}
