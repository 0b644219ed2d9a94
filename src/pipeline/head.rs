//! A head at a distance in the place of the knife: what was read goes to its pipeline, and its programs to its verifier.

use std::io::{self, BufReader, BufWriter, Cursor, Write};

use super::input::{Input, Judged, read, read_to_judge};
use super::product::{BLOCK, Medium, Product};
use super::report::{self, Axes, Report};
use super::told::{Explained, quote, told};
use super::{judge, place};
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::front::Dialect;
use crate::ir::verdict::Verdict;
use crate::ir::{Finding, Marker};
use crate::machine::Job;
use crate::plan::Peaks;
use crate::source::Source;
use crate::spray::{self, Program, Reader, TARGETS, Target};
use crate::verify::spray::Ground;

/// Compiles a source, read as a dialect, to several programs of a head, as [`super::compile_all`] does for a knife: its
/// figures, and with `verify` what it is worth.
pub(super) fn compile(
    source: &Source,
    job: &Job,
    (from, verify): (Option<&'static Dialect>, bool),
    products: &mut [Product],
    diagnostics: &mut Diagnostics,
) -> io::Result<Option<(Report, Option<Verdict>)>> {
    let all = if verify {
        read_to_judge(source, from, job, diagnostics).map(|Judged { input, reading }| (input, Some(reading)))
    } else {
        read(source, from, job, diagnostics).map(|input| (input, None))
    };
    let Some((input, reading)) = all else { return Ok(None) };
    let targets = targets(products, diagnostics);
    if diagnostics.has_errors() {
        return Ok(None);
    }
    let known = diagnostics.iter().len();
    let planned = spray::plan(&input.marker, job, diagnostics);
    place::place(diagnostics, known, &input.marker, source, job);
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
        let audit = judge::audited(source, input.dialect, reading, job);
        let judged = verdict_of(&program, products, &input, job, audit)?;
        judge::report(&judged, &input.marker, job, diagnostics);
        verdict = Some(judged);
    }
    Ok((!diagnostics.has_errors()).then_some((report, verdict)))
}

/// Says what of the edges of an input a head cannot follow.
pub(super) fn check(input: &Input, source: &Source, job: &Job, diagnostics: &mut Diagnostics) {
    let known = diagnostics.iter().len();
    spray::check(&input.marker, job, diagnostics);
    place::place(diagnostics, known, &input.marker, source, job);
}

/// The figures of the program that a marker would become, as [`super::estimate`] has them of a knife.
pub(super) fn estimate(marker: &Marker, job: &Job, diagnostics: &mut Diagnostics) -> report::Program {
    let planned = spray::plan(marker, job, diagnostics);
    planned.map_or_else(report::Program::default, |(program, peaks)| figures(&program, &peaks))
}

/// The figures of a program.
fn figures(program: &Program, peaks: &Peaks) -> report::Program {
    report::Program { time_s: Some(program.duration()), axes: Some(Axes::new(peaks)), ..report::Program::default() }
}

/// The targets of the products; one that tells of a knife is an error.
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

/// The verdict on the setpoints: those that were written, or else some that are made to be judged.
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

/// The verdict on the bytes of a program, with what is known of its source.
fn judged(program: &mut dyn Medium, input: &Input, job: &Job, audit: Vec<Finding>) -> io::Result<Verdict> {
    program.rewind()?;
    let ground = Ground::new(&input.marker, &job.profile);
    let mut bytes = BufReader::with_capacity(BLOCK, program);
    let mut verdict = (setpoints().1)(&mut bytes, &ground, job)?;
    verdict.findings.extend(audit);
    Ok(verdict)
}

/// Judges a program of a head against a source, as [`super::judge_program`] does for a knife.
pub(super) fn judge_program(
    program: &mut dyn Medium,
    source: &Source,
    from: Option<&'static Dialect>,
    job: &Job,
    diagnostics: &mut Diagnostics,
) -> io::Result<Option<Explained>> {
    let Some(Judged { input, reading }) = read_to_judge(source, from, job, diagnostics) else { return Ok(None) };
    if diagnostics.has_errors() {
        return Ok(None);
    }
    let audit = judge::audited(source, input.dialect, reading, job);
    let verdict = judged(program, &input, job, audit)?;
    let mut told = told(&verdict, &input.marker, source, job);
    quote(&mut told, program)?;
    Ok(Some(Explained { verdict, told }))
}
