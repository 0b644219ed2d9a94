//! The compiler, each stage named once, in order.

mod judge;
mod place;
mod program;
mod refused;
mod report;
mod spent;
mod toolpaths;

pub use crate::analysis::area;
pub use judge::{about, figures, foreign, judge_program};
pub use report::{Axes, Controller, Drawn, Lines, Notches, Peak, Peaks, Program, Report, Sides, significant};
pub use spent::{Spent, word};

pub use crate::verify::{RULES, Rule, Verdict};

use std::io::{self, BufWriter, Read, Seek, Write};
use std::path::Path;

use tempfile::SpooledTempFile;

use self::program::{Sink, Written};
use self::toolpaths::Toolpaths;
use crate::back::{Context, Emit, Proof, SETPOINTS, Target};
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::front::{self, Dialect, Read as Reader};
use crate::ir::{Finding, Marker, check, text};
use crate::machine::{Job, plot};
use crate::pass::marker::{MARKER_PASSES, MarkerPass};
use crate::pass::toolpath::{Scene, TOOLPATH_PASSES, trace};
use crate::plan;
use crate::recognise;
use crate::source::Source;
use crate::verify::{Census, Ground, Works};

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
    /// Whether the source was read without errors: then there is something to show, whatever passes say of it.
    pub is_whole: bool,
}

/// An input that programs are judged against.
#[derive(Debug)]
pub struct Judged {
    /// What is cut.
    pub input: Input,
    /// What is known of how it was read.
    pub reading: Reading,
}

/// What a file says in all, as it was read, and what passes kept of that.
#[derive(Debug)]
pub struct Reading {
    /// Before any pass.
    pub census: Census,
    /// Whether all of it is still cut behind them.
    pub kept: Finding,
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

/// What is chosen for a compile to several programs.
#[derive(Debug, Clone, Copy)]
pub struct Choices {
    /// What the source is read as; `None` = what its content looks like.
    pub from: Option<&'static Dialect>,
    /// Whether the programs are read back and judged.
    pub verify: bool,
}

/// One of the programs that a compile writes.
pub struct Product<'a> {
    /// What is written.
    pub target: &'static Target,
    /// Where it goes.
    pub out: &'a mut dyn Medium,
    /// Set where the compile fails and this is a picture of what was refused: it is worth keeping, a program is not.
    pub shows_refusal: bool,
}

impl<'a> Product<'a> {
    /// A program that is not written yet.
    pub fn new(target: &'static Target, out: &'a mut dyn Medium) -> Self {
        Self { target, out, shows_refusal: false }
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
    run_passes(marker_passes()[0], &mut input.marker, (source, job), diagnostics);
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
    let (census, works) = rayon::join(|| Census::of(&input.marker), || Works::of(&input.marker));
    run_passes(marker_passes()[0], &mut input.marker, (source, job), diagnostics);
    let kept = works.kept(&input.marker, &job.profile);
    Some(Judged { input, reading: Reading { census, kept } })
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
    let marker = marker_of(dialect, source, job, diagnostics);
    // Only a drawing leaves it to others which of its lines are cut.
    if marker.drawing.is_none() && job.lines != plot::Lines::default() && !diagnostics.has_errors() {
        let message = "`--cut-pens`, `--inner` and `--cut-all` choose among the lines of a plot, and this is none: all of it is cut";
        let finding = Diagnostic::new(&code::SOURCE_NO_PLOT, message);
        diagnostics.push(finding.hint("leave them out; `--pieces` and `--skip` choose pieces of any file"));
    }
    place::place(diagnostics, 0, (&marker, source, job));
    Some(Input { dialect, marker, is_whole: !diagnostics.has_errors() })
}

/// What a source says is cut, as a dialect reads it, or as it is recognised in what the dialect says is drawn.
pub fn marker_of(dialect: &Dialect, source: &Source, job: &Job, diagnostics: &mut Diagnostics) -> Marker {
    match dialect.read {
        Reader::Marker(read) => read(source, job, diagnostics),
        Reader::Drawing(read) => {
            let drawing = read(source, job, diagnostics);
            // What is not read to its end would only be recognised wrongly.
            if diagnostics.has_errors() { Marker::default() } else { recognise::marker(drawing, job, diagnostics) }
        }
    }
}

/// The passes that say what is drawn, and the one that makes cuts of it: only programs need these.
fn marker_passes() -> [&'static [MarkerPass]; 2] {
    let (last, first) = MARKER_PASSES.split_last().expect("there are passes");
    [first, std::slice::from_ref(last)]
}

/// Makes the cuts of what was read.
fn make_cuts(input: &mut Input, source: &Source, job: &Job, diagnostics: &mut Diagnostics) {
    run_passes(marker_passes()[1], &mut input.marker, (source, job), diagnostics);
}

/// Runs marker passes. What they find is placed before a pass can take it away.
fn run_passes(
    passes: &[MarkerPass],
    marker: &mut Marker,
    (source, job): (&Source, &Job),
    diagnostics: &mut Diagnostics,
) {
    for pass in passes {
        if diagnostics.has_errors() {
            break;
        }
        let known = diagnostics.iter().len();
        (pass.run)(marker, job, diagnostics);
        place::place(diagnostics, known, (marker, source, job));
        assert_sound(pass.name, || check::marker(marker));
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
    compile_all(source, job, Choices { from, verify }, &mut [Product::new(target, out)], diagnostics)
}

/// Compiles a source to several programs at once: each stage runs once for all of them. `None` when the diagnostics hold
/// errors: then all that was written must be thrown away, but for pictures that show what was refused.
pub fn compile_all(
    source: &Source,
    job: &Job,
    choices: Choices,
    products: &mut [Product],
    diagnostics: &mut Diagnostics,
) -> io::Result<Option<Compiled>> {
    let Choices { from, verify } = choices;
    let judged = if verify {
        read_to_judge(source, from, job, diagnostics).map(|Judged { input, reading }| (input, Some(reading)))
    } else {
        read(source, from, job, diagnostics).map(|input| (input, None))
    };
    let Some((mut input, reading)) = judged else { return Ok(None) };
    let proofs = Proofs::of(products, verify);
    if proofs.beside || products.iter().any(|product| product.target.emit.needs_toolpaths()) {
        make_cuts(&mut input, source, job, diagnostics);
    }
    let context = Context { source, job, marker: &input.marker };
    if diagnostics.has_errors() {
        if input.is_whole {
            refused::draw(&context, products, diagnostics)?;
        }
        return Ok(None);
    }
    let known = diagnostics.iter().len();
    let mut scratch = SpooledTempFile::new(SCRATCH_BYTES);
    let mut audit = Vec::new();
    let written = rayon::in_place_scope(|scope| {
        // The source is looked at beside all that is done with what was read of it.
        scope.spawn(|_| {
            let audited = |reading| judge::audited(source, (input.dialect, reading), job);
            audit.extend(reading.into_iter().flat_map(audited));
        });
        write(&context, products, proofs.beside.then_some(&mut scratch), diagnostics)
    })?;
    let mut report = Report::of(&input.marker, input.dialect.name);
    report.program = written.program;
    report.controller = written.estimate.map(Controller::from);
    let mut verdict: Option<Verdict> = None;
    if verify && !diagnostics.has_errors() {
        verdict = proofs.judge(&context, &audit, products, &mut scratch)?;
    }
    if let Some(verdict) = &verdict {
        judge::report(verdict, (&input.marker, job), diagnostics);
    }
    place::place(diagnostics, known, (&input.marker, source, job));
    finish(&context, products, verdict.as_ref(), diagnostics)?;
    Ok((!diagnostics.has_errors()).then_some(Compiled { report, verdict }))
}

/// Writes all programs but the tails of those that show a verdict; `beside` takes the setpoints that are only judged.
fn write(
    context: &Context,
    products: &mut [Product],
    beside: Option<&mut SpooledTempFile>,
    diagnostics: &mut Diagnostics,
) -> io::Result<Written> {
    let mut sinks: Vec<Sink> =
        products.iter_mut().filter_map(|product| Sink::new(&product.target.emit, context, &mut *product.out)).collect();
    if let Some(beside) = beside {
        sinks.push(Sink::of_motion(&SETPOINTS, beside));
    }
    let written = if sinks.is_empty() {
        Written::default()
    } else {
        let toolpaths = Toolpaths::new(context.marker, context.job);
        program::write(toolpaths, &mut sinks, (context, false), diagnostics)?
    };
    drop(sinks);
    for Product { target, out, .. } in products {
        if let Emit::Marker(emit) = target.emit {
            let mut out = BufWriter::new(&mut **out);
            emit(context, &mut out, diagnostics)?;
            out.flush()?;
        }
    }
    Ok(written)
}

/// Ends the programs that show the verdict, and says which of them show what was refused.
fn finish(
    context: &Context,
    products: &mut [Product],
    verdict: Option<&Verdict>,
    diagnostics: &Diagnostics,
) -> io::Result<()> {
    let mut findings = refused::findings(diagnostics);
    findings.extend(verdict.iter().flat_map(|verdict| verdict.findings.iter().cloned()));
    for Product { target, out, shows_refusal } in products {
        *shows_refusal = diagnostics.has_errors() && refused::is_picture(target);
        if let Emit::Toolpath(parts) = &target.emit {
            let mut out = BufWriter::new(&mut **out);
            (parts.tail)(context, &findings, &mut out)?;
            out.flush()?;
        }
        out.flush()?;
    }
    Ok(())
}

/// How the programs of a compile are judged.
#[derive(Debug, Clone, Copy)]
struct Proofs {
    /// Whether setpoints are made only to be judged. A target that cannot be judged by its own bytes shows the verdict on
    /// setpoints; when no target's own bytes are those, they are made beside the others, so that a picture can show the worst
    /// places.
    beside: bool,
    /// Whether any program is judged by how it moves.
    by_motion: bool,
}

impl Proofs {
    fn of(products: &[Product], verify: bool) -> Self {
        let has = |proof: Proof| products.iter().any(|product| product.target.proof == proof);
        let beside = verify && has(Proof::None) && !has(Proof::Setpoints);
        Self { beside, by_motion: beside || has(Proof::Setpoints) || has(Proof::Positions) }
    }

    /// The verdict on all programs.
    fn judge(
        self,
        context: &Context,
        audit: &[Finding],
        products: &mut [Product],
        scratch: &mut SpooledTempFile,
    ) -> io::Result<Option<Verdict>> {
        let Context { source, job, marker } = *context;
        let ground = (self.by_motion && job.mode.cuts()).then(|| Ground::new(marker, &job.profile));
        let judged_alone = products.iter_mut().filter(|product| product.target.proof != Proof::None);
        let programs = judged_alone.map(|product| &mut *product.out);
        let scratch: Option<&mut dyn Medium> = if self.beside { Some(scratch) } else { None };
        let mut verdict: Option<Verdict> = None;
        for program in programs.chain(scratch) {
            let next = judge::judge(source, (marker, ground.as_ref(), audit), job, program)?;
            verdict = Some(match verdict {
                Some(verdict) => judge::both(verdict, next),
                None => next,
            });
        }
        Ok(verdict)
    }
}

/// The figures of the program that an input would become, nothing written and nothing judged; when it cannot be planned
/// the diagnostics say why.
pub fn estimate(input: &mut Input, source: &Source, job: &Job, diagnostics: &mut Diagnostics) -> io::Result<Program> {
    make_cuts(input, source, job, diagnostics);
    if diagnostics.has_errors() {
        return Ok(Program::default());
    }
    let toolpaths = Toolpaths::new(&input.marker, job);
    let context = Context { job, marker: &input.marker, source };
    let known = diagnostics.iter().len();
    let written = program::write(toolpaths, &mut [], (&context, true), diagnostics)?;
    place::place(diagnostics, known, (&input.marker, source, job));
    Ok(written.program)
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
    let last = MARKER_PASSES.iter().position(|marker_pass| marker_pass.name == pass);
    let passes = &MARKER_PASSES[..last.map_or(MARKER_PASSES.len(), |last| last + 1)];
    run_passes(passes, &mut input.marker, (source, job), diagnostics);
    if diagnostics.has_errors() {
        return None;
    }
    if last.is_some() {
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

/// In tests and debug builds a pass that breaks an invariant is found at once.
fn assert_sound(pass: &str, faults: impl FnOnce() -> check::Faults) {
    if cfg!(debug_assertions) {
        let faults = faults();
        assert!(faults.is_empty(), "after pass {pass}: {faults:?}");
    }
}
