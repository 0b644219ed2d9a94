//! Heads over a conveyor: what is planned, what is written, and what it is worth.

mod damage;
mod files;
mod laws;

use std::io::{BufRead, Cursor};

use cutc::diagnostic::{Diagnostics, render};
use cutc::flow::verify::{self, Bytes, Ground};
use cutc::flow::{self, Emit, Program, Speed, TARGETS, Target};
use cutc::ir::Marker;
use cutc::ir::verdict::Verdict;
use cutc::machine::{Job, load};
use cutc::pipeline;
use cutc::source::Source;

/// The bytes of a fixture.
fn fixture(name: &str) -> Vec<u8> {
    let path = format!("{}/fixtures/{name}", env!("CARGO_MANIFEST_DIR"));
    std::fs::read(&path).unwrap_or_else(|error| panic!("{path}: {error}"))
}

/// The machine of the fixtures, with some keys set.
fn job(sets: &[&str]) -> Job {
    let source = Source::new("flow.toml", fixture("machines/flow.toml")).expect("small");
    let sets: Vec<String> = sets.iter().map(|set| (*set).to_owned()).collect();
    Job { profile: load(Some(&source), &sets).expect("a legal profile"), ..Job::default() }
}

/// A marker, and how it is cut.
struct Planned {
    marker: Marker,
    program: Program,
}

/// What is planned of a fixture, and what is said of it.
fn plan(name: &str, speed: Speed, job: &Job) -> (Option<Planned>, String) {
    let source = Source::new(name.rsplit('/').next().expect("a name"), fixture(name)).expect("small");
    let mut out = Diagnostics::default();
    let input = pipeline::read(&source, None, job, &mut out);
    let planned = input.and_then(|mut input| {
        pipeline::make_cuts(&mut input, &source, job, &mut out);
        let program = flow::plan(&input.marker, speed, job, &mut out)?;
        Some(Planned { marker: input.marker, program })
    });
    (planned.filter(|_| !out.has_errors()), render(&out, &source))
}

/// What is planned of a fixture that can be cut.
fn planned(name: &str, speed: f64, job: &Job) -> Planned {
    let (planned, said) = plan(name, Speed::Of(speed), job);
    planned.unwrap_or_else(|| panic!("{name}: {said}"))
}

/// A target by its name.
fn target(name: &str) -> &'static Target {
    TARGETS.iter().find(|target| target.name == name).expect("a target")
}

/// The plan and the programs of all heads, as they are written.
fn written(planned: &Planned, job: &Job, name: &str) -> (String, Vec<Vec<u8>>) {
    let Planned { marker, program } = planned;
    let plan = serde_json::to_string(&flow::describe(program, marker, &job.profile)).expect("plain data");
    let Emit::Heads(write) = target(name).emit else { panic!("{name} is no program") };
    let head = |head: &flow::Head| {
        let mut bytes = Vec::new();
        write(program, head, &mut bytes).expect("a vector takes bytes");
        bytes
    };
    (plan, program.heads.iter().map(head).collect())
}

/// What some bytes are worth.
fn judged(marker: &Marker, job: &Job, plan: &str, bytes: Bytes, heads: &[Vec<u8>]) -> Verdict {
    let ground = Ground { marker, profile: &job.profile };
    let open = |i: usize| -> std::io::Result<Box<dyn BufRead>> { Ok(Box::new(Cursor::new(heads[i].clone()))) };
    verify::judge(plan, (bytes, &open), &ground).expect("memory is readable")
}

/// The rules that the programs of a plan break, with what breaks them.
fn broken(planned: &Planned, job: &Job) -> Vec<String> {
    let (plan, heads) = written(planned, job, "csv");
    let verdict = judged(&planned.marker, job, &plan, Bytes::Rows, &heads);
    verdict.broken().map(|finding| format!("{finding:?}")).chain(verdict.unread.clone()).collect()
}
