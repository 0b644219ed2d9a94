//! The compiler, each stage named once, in order.

mod judge;
mod program;
mod report;
mod spent;

pub use judge::{about, figures, foreign, judge_program};
pub use report::{Axes, Controller, Drawn, Lines, Notches, Peak, Peaks, Program, Report, Sides, significant};
pub use spent::{Spent, word};

pub use crate::verify::{RULES, Verdict};

use std::io::{self, BufWriter, Read, Seek, Write};
use std::path::Path;

use rayon::prelude::*;
use tempfile::SpooledTempFile;

use self::program::Sink;
use crate::back::{Context, Emit, Estimate, Fitted, Proof, SETPOINTS, Target};
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::front::{self, Dialect};
use crate::ir::{Finding, Marker, Toolpath, check, text};
use crate::machine::{Job, Mode, plot};
use crate::pass::marker::MARKER_PASSES;
use crate::pass::toolpath::{Scene, TOOLPATH_PASSES, check_depths, frame, trace};
use crate::plan;
use crate::source::Source;
use crate::verify::Census;

/// Bytes of setpoints that are kept in memory when they are made only to be judged; more go to a temporary file.
const SCRATCH_BYTES: usize = 64 << 20;

/// Where a program is written, and read back from.
pub trait Medium: Read + Write + Seek {}

impl<T: Read + Write + Seek> Medium for T {}

/// A file as read and passed: what is cut, in which order.
#[derive(Debug)]
pub struct Input {
    /// What it was read as.
    pub dialect: &'static Dialect,
    /// What it says, as far as the job wants it cut.
    pub marker: Marker,
}

/// An input that programs are judged against.
#[derive(Debug)]
pub struct Judged {
    /// What is cut.
    pub input: Input,
    /// What the file says in all, as it was read: before any pass.
    pub read: Census,
}

/// What is asked of a compile beside the job.
#[derive(Debug, Clone, Copy)]
pub struct Order {
    /// What the source is read as; `None` = what its content looks like.
    pub from: Option<&'static Dialect>,
    /// What is written.
    pub target: &'static Target,
    /// Whether the program is read back and judged.
    pub verify: bool,
}

/// One of the programs that a compile writes.
pub struct Product<'a> {
    /// What is written.
    pub target: &'static Target,
    /// Where it goes.
    pub out: &'a mut dyn Medium,
}

impl Product<'_> {
    /// The way in for motion, when the target is made from that.
    fn sink(&mut self) -> Option<Sink<'_>> {
        match &self.target.emit {
            Emit::Motion(parts) => Some(Sink { parts, out: &mut *self.out }),
            Emit::Marker(_) | Emit::Toolpath(_) | Emit::Fit(_) => None,
        }
    }
}

/// What a compile gives.
#[derive(Debug)]
pub struct Compiled {
    /// The figures of the program.
    pub report: Report,
    /// What it is worth; `None` when nobody asked.
    pub verdict: Option<Verdict>,
}

/// Reads a source as `from`, or as what its content looks like, and runs the marker passes. `None` when nothing can be
/// read; faults of the data are diagnostics.
pub fn read(
    source: &Source,
    from: Option<&'static Dialect>,
    job: &Job,
    diagnostics: &mut Diagnostics,
) -> Option<Input> {
    let mut input = read_alone(source, from, job, diagnostics)?;
    run_passes(&mut input.marker, job, None, diagnostics);
    Some(input)
}

/// The same, with what it takes to judge a program.
pub fn read_to_judge(
    source: &Source,
    from: Option<&'static Dialect>,
    job: &Job,
    diagnostics: &mut Diagnostics,
) -> Option<Judged> {
    let mut input = read_alone(source, from, job, diagnostics)?;
    let read = Census::of(&input.marker);
    run_passes(&mut input.marker, job, None, diagnostics);
    Some(Judged { input, read })
}

/// The marker as the source says it, before any pass.
fn read_alone(
    source: &Source,
    from: Option<&'static Dialect>,
    job: &Job,
    diagnostics: &mut Diagnostics,
) -> Option<Input> {
    let extension = Path::new(source.name()).extension().and_then(|e| e.to_str());
    let dialect = from.or_else(|| front::detect(source, extension, diagnostics))?;
    let marker = (dialect.read)(source, job, diagnostics);
    // Only a plot leaves it to others which of its lines are cut.
    if marker.drawing.is_none() && job.lines != plot::Lines::default() && !diagnostics.has_errors() {
        let message = "`--cut` and `--cut-pens` choose among the lines of a plot, and this is none: all of it is cut";
        let finding = Diagnostic::new(&code::SOURCE_NO_PLOT, message);
        diagnostics.push(finding.hint("leave them out; `--pieces` and `--skip` choose pieces of any file"));
    }
    Some(Input { dialect, marker })
}

/// Runs the marker passes up to and with `last`; `None` = all.
fn run_passes(marker: &mut Marker, job: &Job, last: Option<&str>, diagnostics: &mut Diagnostics) {
    for pass in MARKER_PASSES {
        if diagnostics.has_errors() {
            break;
        }
        (pass.run)(marker, job, diagnostics);
        assert_sound(pass.name, || check::marker(marker));
        if last == Some(pass.name) {
            break;
        }
    }
}

/// Compiles a source to a program in `out`, reads that back and judges it. `None` when the diagnostics hold errors: what
/// `out` then holds must be thrown away.
pub fn compile(
    source: &Source,
    job: &Job,
    order: Order,
    out: &mut dyn Medium,
    diagnostics: &mut Diagnostics,
) -> io::Result<Option<Compiled>> {
    let Order { from, target, verify } = order;
    compile_all(source, job, (from, verify), &mut [Product { target, out }], diagnostics)
}

/// Compiles a source to several programs at once: each stage runs once for all of them. `read` is the dialect, if not
/// what the content looks like, and whether the programs are judged. `None` when the diagnostics hold errors: then all
/// that was written must be thrown away.
pub fn compile_all(
    source: &Source,
    job: &Job,
    (from, verify): (Option<&'static Dialect>, bool),
    products: &mut [Product],
    diagnostics: &mut Diagnostics,
) -> io::Result<Option<Compiled>> {
    let Some(judged) = read_to_judge(source, from, job, diagnostics) else { return Ok(None) };
    if diagnostics.has_errors() {
        return Ok(None);
    }
    let Input { dialect, marker } = &judged.input;
    let mut report = Report::of(marker, dialect.name);
    let context = Context { source, job, marker };
    // A target that cannot be judged by its own bytes shows the verdict on setpoints.
    let has = |products: &[Product], proof: Proof| products.iter().any(|product| product.target.proof == proof);
    let wants_setpoints = verify && has(products, Proof::None);
    let needs_toolpaths =
        wants_setpoints || products.iter().any(|product| !matches!(product.target.emit, Emit::Marker(_)));
    let toolpaths = if needs_toolpaths { toolpaths(marker, job, diagnostics) } else { Vec::new() };

    // When no target's own bytes are setpoints, those are made beside them to be judged, so that a picture can show the
    // worst places.
    let mut scratch = SpooledTempFile::new(SCRATCH_BYTES);
    let beside = wants_setpoints && !has(products, Proof::Setpoints);
    let mut sinks: Vec<Sink> = products.iter_mut().filter_map(Product::sink).collect();
    if beside {
        sinks.push(Sink { parts: &SETPOINTS, out: &mut scratch });
    }
    if !sinks.is_empty() {
        report.program = program::write(&toolpaths, &mut sinks, &context, diagnostics)?;
    }
    drop(sinks);

    let mut verdict: Option<Verdict> = None;
    let mut judge = |program: &mut dyn Medium| -> io::Result<()> {
        let next = judge::judge(source, &judged, job, program)?;
        verdict = Some(match verdict.take() {
            Some(verdict) => judge::both(verdict, next),
            None => next,
        });
        Ok(())
    };
    if verify && !diagnostics.has_errors() {
        for product in products.iter_mut().filter(|product| product.target.proof == Proof::Setpoints) {
            judge(&mut *product.out)?;
        }
        if beside {
            judge(&mut scratch)?;
        }
    }
    let by_itself = |product: &&mut Product| matches!(product.target.proof, Proof::Marker | Proof::Positions);
    for Product { target, out } in products.iter_mut().filter(by_itself) {
        let estimate = write_untimed(&target.emit, &toolpaths, &[], (&context, diagnostics), *out)?;
        report.controller = estimate.map(Controller::from).or(report.controller);
        if verify && !diagnostics.has_errors() {
            judge(&mut **out)?;
        }
    }
    let findings = verdict.as_ref().map_or(&[][..], |verdict| &verdict.findings);
    for Product { target, out } in products {
        if target.proof == Proof::None {
            write_untimed(&target.emit, &toolpaths, findings, (&context, diagnostics), *out)?;
        }
        out.flush()?;
    }
    if let Some(verdict) = &verdict {
        judge::report(verdict, marker, diagnostics);
    }
    Ok((!diagnostics.has_errors()).then_some(Compiled { report, verdict }))
}

/// The figures of the program that an input would become, nothing written and nothing judged; when it cannot be planned
/// the diagnostics say why.
pub fn estimate(input: &Input, source: &Source, job: &Job, diagnostics: &mut Diagnostics) -> io::Result<Program> {
    let toolpaths = toolpaths(&input.marker, job, diagnostics);
    let context = Context { job, marker: &input.marker, source };
    program::write(&toolpaths, &mut [], &context, diagnostics)
}

/// Writes a target that needs no timed motion; those that do are written by then. Says what a controller that plans for
/// itself makes of it.
fn write_untimed(
    emit: &Emit,
    toolpaths: &[Toolpath],
    findings: &[Finding],
    (context, diagnostics): (&Context, &mut Diagnostics),
    out: &mut dyn Medium,
) -> io::Result<Option<Estimate>> {
    let mut out = BufWriter::new(out);
    let mut estimate = None;
    match emit {
        Emit::Marker(emit) => emit(context, &mut out, diagnostics)?,
        Emit::Toolpath(parts) => {
            (parts.head)(context, &mut out)?;
            for toolpath in toolpaths {
                (parts.body)(toolpath, context, &mut out)?;
            }
            (parts.tail)(context, findings, &mut out)?;
        }
        Emit::Fit(fit) => {
            let ways: Vec<_> = toolpaths.par_iter().map(|toolpath| (fit.ways)(toolpath, context.job)).collect();
            let mut sound = Vec::with_capacity(ways.len());
            for ways in ways {
                match ways {
                    Ok(ways) => sound.push(ways),
                    Err(refused) => refused.into_iter().for_each(|diagnostic| diagnostics.push(diagnostic)),
                }
            }
            if sound.len() == toolpaths.len() {
                estimate = Some((fit.write)(context, &Fitted { toolpaths, ways: &sound }, &mut out)?);
            }
        }
        Emit::Motion(_) => {}
    }
    out.flush()?;
    Ok(estimate)
}

/// The form after a pass, as text; `None` when no pass has that name or nothing could be read.
pub fn dump(
    source: &Source,
    from: Option<&'static Dialect>,
    job: &Job,
    pass: &str,
    diagnostics: &mut Diagnostics,
) -> Option<String> {
    let mut input = read_alone(source, from, job, diagnostics)?;
    run_passes(&mut input.marker, job, Some(pass), diagnostics);
    if diagnostics.has_errors() {
        return None;
    }
    if MARKER_PASSES.iter().any(|marker_pass| marker_pass.name == pass) {
        return Some(text::print_marker(&input.marker));
    }
    let last = TOOLPATH_PASSES.iter().position(|p| p.name == pass)?;
    let mut text = String::new();
    let scene = Scene::new(&input.marker, job);
    let mut pose = plan::home(job);
    for mut toolpath in trace(&input.marker, job) {
        toolpath.entry = pose;
        for toolpath_pass in &TOOLPATH_PASSES[..=last] {
            (toolpath_pass.run)(&mut toolpath, &scene, diagnostics);
        }
        pose = toolpath.exit();
        text.push_str(&text::print_toolpath(&toolpath));
    }
    Some(text)
}

/// The toolpath of every drill, notch and contour after all passes, in cut order.
fn toolpaths(marker: &Marker, job: &Job, diagnostics: &mut Diagnostics) -> Vec<Toolpath> {
    let mut pose = plan::home(job);
    match job.mode {
        Mode::Cut | Mode::Dry => {}
        Mode::Frame => {
            let frame = frame(marker, pose, job, diagnostics);
            assert_sound("frame", || check::toolpath(&frame));
            return vec![frame];
        }
    }
    let scene = Scene::new(marker, job);
    check_depths(marker, &scene, diagnostics);
    let pass = |mut toolpath: Toolpath| {
        toolpath.entry = pose;
        for pass in TOOLPATH_PASSES {
            (pass.run)(&mut toolpath, &scene, diagnostics);
            assert_sound(pass.name, || check::toolpath(&toolpath));
        }
        pose = toolpath.exit();
        toolpath
    };
    trace(marker, job).map(pass).collect()
}

/// In tests and debug builds a pass that breaks an invariant is found at once.
fn assert_sound(pass: &str, faults: impl FnOnce() -> check::Faults) {
    if cfg!(debug_assertions) {
        let faults = faults();
        assert!(faults.is_empty(), "after pass {pass}: {faults:?}");
    }
}
