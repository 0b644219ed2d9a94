//! The head that follows edges at a distance, in the place of the knife.

use std::io::{self, BufReader, BufWriter, Cursor, Write as _};

use super::machine::{Checked, Machine, Tool, Written, dialect, listed};
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::ir::Finding;
use crate::ir::verdict::Verdict;
use crate::machine::{Job, ToolKind};
use crate::pipeline::{self, Axes, Choices, Compiled, Explained, Input, Judged, Medium, Product, Report, place};
use crate::plan::Peaks;
use crate::sew::Asked;
use crate::source::Source;
use crate::spray::{self, Program, Reader, TARGETS, Target};
use crate::verify::spray::{Ground, RULES};

pub(super) const MACHINE: Machine = Machine {
    name: "spray",
    about: "a head that follows edges at a distance: a spray gun, a torch, a nozzle",
    works: "follows",
    tool: Some(Tool { kinds: &[ToolKind::Spray], compile, cuts: |_, _, _, _| {}, estimate }),
    targets: || listed(TARGETS),
    rules: RULES,
    is_sewn: false,
    claims: |_| false,
    refusal: |_| None,
    parts: None,
    check,
    judge: Some(judge),
};

/// Bytes that are read back at a time.
const BLOCK_BYTES: usize = 1 << 16;

/// Compiles a source to several programs of a head.
fn compile(
    source: &Source,
    job: &Job,
    choices: Choices,
    products: &mut [Product],
    diagnostics: &mut Diagnostics,
) -> io::Result<Option<Compiled>> {
    let read = pipeline::read_for((choices.from, choices.verify), source, job, diagnostics);
    let Some((input, reading)) = read else { return Ok(None) };
    let targets = targets(products, diagnostics);
    if diagnostics.has_errors() {
        return Ok(None);
    }
    let known = diagnostics.iter().len();
    let planned = spray::plan(&input.marker, job, diagnostics);
    place(diagnostics, known, &input.marker, source, job);
    let Some((mut program, peaks)) = planned else { return Ok(None) };
    if targets.iter().any(|target| target.emit.compares) {
        program = spray::beside_optimal(program, &input.marker, job);
    }
    for (product, target) in products.iter_mut().zip(&targets) {
        let mut out = BufWriter::new(&mut *product.out);
        (target.emit.write)(&program, &mut out)?;
        out.flush()?;
    }
    let mut report = Report::of(&input.marker, input.dialect.name);
    report.program = figures(&program, &peaks);
    report.edges = Some(program.figures.clone()).filter(|edges| !edges.is_empty());
    let mut verdict = None;
    if let Some(reading) = reading {
        let audit = pipeline::audited(source, input.dialect, reading, job);
        let judged = verdict_of(&program, products, &input, job, audit)?;
        pipeline::report(&judged, &input.marker, job, diagnostics);
        verdict = Some(judged);
    }
    Ok((!diagnostics.has_errors()).then_some(Compiled { report, verdict, declared: Vec::new() }))
}

/// Reads a source, and finds the edges that a head cannot follow.
fn check(source: &Source, asked: &Asked, job: &Job, diagnostics: &mut Diagnostics) -> Option<Checked> {
    let input = pipeline::read(source, dialect(asked), job, diagnostics)?;
    if !diagnostics.has_errors() {
        let known = diagnostics.iter().len();
        spray::check(&input.marker, job, diagnostics);
        place(diagnostics, known, &input.marker, source, job);
    }
    Some(Checked::of(&input))
}

/// The figures of the program that an input would become.
#[allow(clippy::unnecessary_wraps, reason = "a row of the table of machines: the knife's may fail to write")]
fn estimate(
    input: &mut Input,
    _: &Source,
    job: &Job,
    diagnostics: &mut Diagnostics,
) -> io::Result<pipeline::Estimated> {
    if diagnostics.has_errors() {
        return Ok(pipeline::Estimated::default());
    }
    let planned = spray::plan(&input.marker, job, diagnostics);
    let program = planned.map_or_else(pipeline::Program::default, |(program, peaks)| figures(&program, &peaks));
    Ok(pipeline::Estimated { program, controller: None })
}

/// The figures of a program.
fn figures(program: &Program, peaks: &Peaks) -> pipeline::Program {
    let (time_s, axes) = (Some(program.duration()), Some(Axes::new(peaks)));
    pipeline::Program { time_s, axes, ..pipeline::Program::default() }
}

/// The targets of the products; a target for knives is an error.
fn targets(products: &[Product], diagnostics: &mut Diagnostics) -> Vec<&'static Target> {
    let mut targets = Vec::new();
    for name in products.iter().map(|product| product.target.name) {
        if let Some(target) = TARGETS.iter().find(|target| target.name == name) {
            targets.push(target);
        } else {
            let message = format!("the target `{name}` tells of a knife, but `tool.kind` is \"spray\"");
            let known: Vec<&str> = TARGETS.iter().map(|target| target.name).collect();
            let hint = format!("take `{}`", known.join("` or `"));
            diagnostics.push(Diagnostic::new(&code::SPRAY_TARGET, message).hint(hint));
        }
    }
    targets
}

/// Target that is judged, with its reader.
fn setpoints() -> (&'static Target, Reader) {
    let judged = TARGETS.iter().find_map(|target| Some((target, target.proof?)));
    judged.expect("setpoints are a target")
}

/// The verdict on the setpoints: those that were written, or temporary ones.
fn verdict_of(
    program: &Program,
    products: &mut [Product],
    input: &Input,
    job: &Job,
    audit: Vec<Finding>,
) -> io::Result<Verdict> {
    let (setpoints, _) = setpoints();
    let written = products.iter_mut().find(|product| product.target.name == setpoints.name);
    if let Some(product) = written {
        return judged(&mut *product.out, input, job, audit);
    }
    let mut bytes = Cursor::new(Vec::new());
    (setpoints.emit.write)(program, &mut bytes)?;
    judged(&mut bytes, input, job, audit)
}

/// The verdict on the bytes of a program, with the findings about its source.
fn judged(program: &mut dyn Medium, input: &Input, job: &Job, audit: Vec<Finding>) -> io::Result<Verdict> {
    program.rewind()?;
    let ground = Ground::new(&input.marker, &job.profile);
    let mut bytes = BufReader::with_capacity(BLOCK_BYTES, program);
    let mut verdict = (setpoints().1)(&mut bytes, &ground, job)?;
    verdict.findings.extend(audit);
    Ok(verdict)
}

/// Judges a program of a head against a source.
fn judge(
    program: &mut Written,
    source: &Source,
    asked: &Asked,
    job: &Job,
    diagnostics: &mut Diagnostics,
) -> io::Result<Option<Explained>> {
    let read = pipeline::read_to_judge(source, dialect(asked), job, diagnostics);
    let Some(Judged { input, reading }) = read.filter(|_| !diagnostics.has_errors()) else { return Ok(None) };
    let audit = pipeline::audited(source, input.dialect, reading, job);
    let verdict = judged(program.bytes, &input, job, audit)?;
    let mut told = pipeline::told(&verdict, &input.marker, source, job);
    pipeline::quote(&mut told, program.bytes, job)?;
    Ok(Some(Explained { verdict, told }))
}
