//! The compiler of the cutter, each stage named once, in order.
//!
//! Receives a source and a job, promises programs that are written whole and judged, or diagnostics. Never prints, and decides
//! nothing about the cut. Other machines have compilers of their own, rows of [`MACHINES`](crate::machines::MACHINES).

mod advance;
mod bites;
mod input;
mod judge;
mod off_table;
mod overreach;
mod place;
mod product;
mod program;
mod refusals;
mod refused;
mod report;
mod rivals;
mod rounded;
mod savings;
mod sound;
mod spent;
mod swings;
mod told;
mod toolpaths;

pub use self::advance::Advance;
pub use self::bites::Bite;
pub use crate::analysis::area;
pub use crate::analysis::waits::{Waits, waits};
pub use crate::back::Limit;
pub use input::{Input, Judged, Reading, marker_of, read, read_for, read_to_judge};
pub use judge::{audited, both, figures, foreign, judge_program, report};
pub use place::place;
pub use product::{Medium, Product};
pub use report::{
    Axes, Common, Controller, Drawn, Estimated, Limited, Lines, Notches, Other, Peak, Peaks, Program, Report, Sides,
};
pub use rivals::TIE_SHARE;
pub use rounded::significant;
pub use savings::Savings;
pub use spent::Spent;
pub use told::{Explained, Line, Told, quote, told};

pub use crate::ir::verdict::Verdict;
pub use crate::spray::{Edge, Piece};
pub use crate::verify::Declared;
pub(crate) use crate::verify::rules;

use std::io::{self, BufWriter, Write};

use tempfile::SpooledTempFile;

pub use self::input::make_cuts;
use self::input::{read_alone, run_passes};
use self::judge::Asked;
use self::program::{Plan, Sink, Written};
use self::toolpaths::Toolpaths;
use crate::analysis::declare;
use crate::back::{Beside, Context, Emit, Estimate, Outcome, PageWriter, Proof, SETPOINTS, TARGETS, Target};
use crate::diagnostic::{Diagnostic, Diagnostics};
use crate::front::Dialect;
use crate::ir::declaration::Declaration;
use crate::ir::declaration::Total;
use crate::ir::{Finding, text};
use crate::machine::{Job, blake3_of};
use crate::pass::marker::MARKER_PASSES;
use crate::pass::toolpath::{Scene, TOOLPATH_PASSES, trace};
use crate::plan;
use crate::source::Source;
use crate::verify::Ground;

/// Size of setpoints up to which they are kept in memory when they are made only to be judged, bytes; more go to a temporary
/// file.
const SCRATCH_BYTES: usize = 64 << 20;

/// Options of a compile to one program, beside the job.
#[derive(Debug, Clone, Copy)]
pub struct Order {
    /// Dialect of the source; `None` = by its content.
    pub from: Option<&'static Dialect>,
    /// Target that is written.
    pub target: &'static Target,
    /// True if the program is read back and judged.
    pub verify: bool,
}

/// Options of a compile to several programs.
#[derive(Debug, Clone, Copy)]
pub struct Choices<'a> {
    /// Dialect of the source; `None` = by its content.
    pub from: Option<&'static Dialect>,
    /// True if the programs are read back and judged.
    pub verify: bool,
    /// Progress of the compile.
    pub advance: &'a Advance,
}

/// Result of a compile.
#[derive(Debug)]
pub struct Compiled {
    /// The figures of the program.
    pub report: Report,
    /// The verdict on it; `None` without judgement.
    pub verdict: Option<Verdict>,
    /// Deviations from the drawing that the program declares.
    pub declared: Vec<Declaration>,
}

/// Compiles a source to a program in `out`, reads that back and judges it. `None` when the diagnostics hold errors: the content
/// of `out` must then be thrown away.
pub fn compile(
    source: &Source,
    job: &Job,
    order: Order,
    out: &mut dyn Medium,
    diagnostics: &mut Diagnostics,
) -> io::Result<Option<Compiled>> {
    let Order { from, target, verify } = order;
    let choices = Choices { from, verify, advance: &Advance::default() };
    compile_all(source, job, choices, &mut [Product::new(target, out)], diagnostics)
}

/// Compiles a source to several programs at once: each stage runs once for all of them. `None` when the diagnostics hold
/// errors: everything written must then be thrown away, except pictures of the refused program.
pub fn compile_all(
    source: &Source,
    job: &Job,
    choices: Choices,
    products: &mut [Product],
    diagnostics: &mut Diagnostics,
) -> io::Result<Option<Compiled>> {
    let Choices { from, verify, advance } = choices;
    let Some((mut input, reading)) = read_for((from, verify), source, job, diagnostics) else { return Ok(None) };
    let proofs = Proofs::of(products, verify);
    // A cut file has the cuts of pieces that windows of a conveyor split.
    let is_split = input.marker.pieces.iter().any(|piece| piece.section.is_some());
    if is_split || proofs.beside || products.iter().any(|product| product.target.emit.needs_toolpaths()) {
        make_cuts(&mut input, source, job, diagnostics);
        overreach::check(&input.marker, source, job, diagnostics);
    }
    advance.read(input.marker.cuts.len());
    let context = Context { source, job, marker: &input.marker };
    if diagnostics.has_errors() {
        if input.is_whole {
            refused::draw(&context, products, diagnostics)?;
        }
        return Ok(None);
    }
    let known = diagnostics.iter().len();
    let mut scratch = SpooledTempFile::new(SCRATCH_BYTES);
    let mut pages = Pages::of(products, &context);
    let mut audit = Vec::new();
    let written = rayon::in_place_scope(|scope| {
        // The audit of the source runs in parallel with everything that uses its marker.
        scope.spawn(|_| {
            let audited = |reading| judge::audited(source, input.dialect, reading, job);
            audit.extend(reading.into_iter().flat_map(audited));
        });
        let beside = proofs.beside.then_some(&mut scratch);
        write(&context, (products, &mut pages), (beside, advance), diagnostics)
    })?;
    let mut report = Report::of(&input.marker, input.dialect.name).planned(written.program, &input.marker);
    report.declared = declare::totals(&written.declared, &input.marker);
    report.controller = written.estimate.clone().map(Controller::from);
    let mut verdict: Option<Verdict> = None;
    if verify && !diagnostics.has_errors() {
        let declared = Declared::new(written.declared.clone());
        verdict = proofs.judge(&context, &audit, &declared, products, &mut scratch)?;
    }
    if let Some(verdict) = &verdict {
        judge::report(verdict, &input.marker, job, diagnostics);
    }
    place::place(diagnostics, known, &input.marker, source, job);
    let (declared, deviations, controller) =
        (&report.declared[..], &written.declared[..], written.estimate.as_ref().filter(|_| !diagnostics.has_errors()));
    let known = Known { verdict: verdict.as_ref(), declared, deviations, controller };
    finish(&context, (products, &mut pages), known, diagnostics)?;
    Ok((!diagnostics.has_errors()).then_some(Compiled { report, verdict, declared: written.declared }))
}

/// Pages about the programs of a compile under construction, one for each product.
struct Pages<'a>(Vec<Option<Box<dyn PageWriter + 'a>>>);

impl<'a> Pages<'a> {
    fn of(products: &[Product], context: &Context<'a>) -> Self {
        let begin = |product: &Product| match product.target.emit {
            Emit::Page(begin) => Some(begin(context)),
            Emit::Marker(_) | Emit::Toolpath(_) | Emit::Picture(_) | Emit::Arcs(_) | Emit::Motion(_) => None,
        };
        Self(products.iter().map(begin).collect())
    }
}

/// Writes all programs except the tails of those that show a verdict; `beside` takes the setpoints that are only judged.
fn write(
    context: &Context,
    (products, pages): (&mut [Product], &mut Pages),
    (beside, advance): (Option<&mut SpooledTempFile>, &Advance),
    diagnostics: &mut Diagnostics,
) -> io::Result<Written> {
    let choices: Vec<_> = products.iter().map(|product| product.target.emit.choices(context.job)).collect();
    let mut sinks: Vec<Sink> = Vec::new();
    for ((product, page), choices) in products.iter_mut().zip(&mut pages.0).zip(&choices) {
        match page {
            Some(page) => sinks.push(Sink::of_page(&mut **page, &mut *product.out)),
            None => sinks.extend(Sink::new(&product.target.emit, context, choices, &mut *product.out)),
        }
    }
    if let Some(beside) = beside {
        sinks.push(Sink::of_motion(&SETPOINTS, beside));
    }
    let written = if sinks.is_empty() {
        Written::default()
    } else {
        let toolpaths = Toolpaths::new(context.marker, context.job);
        program::write(toolpaths, &mut sinks, context, Plan { motion: false, advance }, diagnostics)?
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

/// Data for the tails of programs.
#[derive(Clone, Copy)]
struct Known<'a> {
    verdict: Option<&'a Verdict>,
    declared: &'a [Total],
    deviations: &'a [Declaration],
    controller: Option<&'a Estimate>,
}

/// Writes the tails of programs that show the verdict, and marks those that show a refused program.
fn finish(
    context: &Context,
    (products, pages): (&mut [Product], &mut Pages),
    Known { verdict, declared, deviations, controller }: Known,
    diagnostics: &Diagnostics,
) -> io::Result<()> {
    let findings = verdict.map_or(&[][..], |verdict| &verdict.findings);
    let (refusals, doubts) = (&refused::errors(diagnostics)[..], &refused::doubts(diagnostics)[..]);
    let messages: &[&Diagnostic] = &diagnostics.iter().collect::<Vec<_>>();
    let is_judged = verdict.is_some();
    let has_page = pages.0.iter().any(Option::is_some);
    let programs = if has_page && !diagnostics.has_errors() { beside(products)? } else { Vec::new() };
    let outcome = Outcome {
        findings,
        refusals,
        declared,
        doubts,
        messages,
        deviations,
        is_judged,
        programs: &programs,
        controller,
    };
    for (Product { target, out, shows_refusal, .. }, page) in products.iter_mut().zip(&mut pages.0) {
        *shows_refusal = diagnostics.has_errors() && refused::is_picture(target);
        if let Some(page) = page {
            let mut out = BufWriter::new(&mut **out);
            page.write(outcome, &mut out)?;
            out.flush()?;
        }
        if let Emit::Toolpath(parts) | Emit::Picture(parts) = &target.emit {
            let mut out = BufWriter::new(&mut **out);
            (parts.tail)(context, outcome, &mut out)?;
            out.flush()?;
        }
        out.flush()?;
    }
    Ok(())
}

/// The complete programs among products, for a page that names them.
fn beside(products: &mut [Product]) -> io::Result<Vec<Beside>> {
    let programs = products.iter_mut().filter(|product| product.target.proof.is_some() && !product.name.is_empty());
    let digest = |Product { name, out, .. }: &mut Product| {
        out.rewind()?;
        Ok(Beside { name: name.clone(), blake3: blake3_of(&mut **out)? })
    };
    programs.map(digest).collect()
}

/// Ways to judge the programs of a compile.
#[derive(Debug, Clone, Copy)]
struct Proofs {
    /// True if setpoints are made only to be judged. A target that cannot be judged by its own bytes shows the verdict on
    /// setpoints. If no product is setpoints, they are made in addition, so that a picture can show the worst places.
    beside: bool,
    /// True if any program is judged by its motion.
    by_motion: bool,
}

impl Proofs {
    fn of(products: &[Product], verify: bool) -> Self {
        let has = |proof: Option<Proof>| products.iter().any(|product| product.target.proof == proof);
        let beside = verify && has(None) && !has(Some(Proof::Setpoints));
        Self { beside, by_motion: beside || has(Some(Proof::Setpoints)) || has(Some(Proof::Positions)) }
    }

    /// The verdict on all programs.
    fn judge(
        self,
        context: &Context,
        audit: &[Finding],
        declared: &Declared,
        products: &mut [Product],
        scratch: &mut SpooledTempFile,
    ) -> io::Result<Option<Verdict>> {
        let Context { source, job, marker } = *context;
        let ground = (self.by_motion && job.mode.cuts()).then(|| Ground::new(marker, &job.profile));
        let judged_alone = products.iter_mut().filter(|product| product.target.proof.is_some());
        let programs = judged_alone.map(|product| &mut *product.out);
        let scratch: Option<&mut dyn Medium> = if self.beside { Some(scratch) } else { None };
        let mut verdict: Option<Verdict> = None;
        for program in programs.chain(scratch) {
            let next = judge::judge(
                Asked { source, marker, ground: ground.as_ref(), declared: Some(declared), job },
                audit,
                program,
            )?;
            verdict = Some(match verdict {
                Some(verdict) => judge::both(verdict, next),
                None => next,
            });
        }
        Ok(verdict)
    }
}

/// Figures of the program of an input, without writing or judging it; if it cannot be planned the diagnostics tell why.
pub fn estimate(input: &mut Input, source: &Source, job: &Job, diagnostics: &mut Diagnostics) -> io::Result<Estimated> {
    if diagnostics.has_errors() {
        return Ok(Estimated::default());
    }
    let toolpaths = Toolpaths::new(&input.marker, job);
    let context = Context { job, marker: &input.marker, source };
    let known = diagnostics.iter().len();
    let written =
        program::write(toolpaths, &mut [], &context, Plan { motion: true, advance: &Advance::default() }, diagnostics)?;
    place::place(diagnostics, known, &input.marker, source, job);
    let controller = if diagnostics.has_errors() { None } else { estimated_there(&context)? };
    Ok(Estimated { program: written.program, controller })
}

/// The program on the controller of a profile with keys of such a one; `None` if the target cannot express the job.
fn estimated_there(context: &Context) -> io::Result<Option<Controller>> {
    let mut unread = SpooledTempFile::new(SCRATCH_BYTES);
    let is_asked = context.job.origin.is_for_gcode();
    let arcs = TARGETS.iter().find(|target| is_asked && matches!(target.emit, Emit::Arcs(_)));
    let choices = arcs.map(|target| target.emit.choices(context.job)).unwrap_or_default();
    let sink = arcs.and_then(|target| Sink::new(&target.emit, context, &choices, &mut unread));
    let Some(sink) = sink else { return Ok(None) };
    let (mut refused, plan) = (Diagnostics::default(), Plan { motion: false, advance: &Advance::default() });
    let toolpaths = Toolpaths::new(context.marker, context.job);
    let written = program::write(toolpaths, &mut [sink], context, plan, &mut refused)?;
    Ok(written.estimate.map(Controller::from).filter(|_| !refused.has_errors()))
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
    run_passes(passes, &mut input.marker, source, job, diagnostics);
    if diagnostics.has_errors() {
        return None;
    }
    if last.is_some() {
        return Some(text::print_marker(&input.marker));
    }
    let last = TOOLPATH_PASSES.iter().position(|p| p.name == pass)?;
    let mut text = String::new();
    let scene = Scene::new(&input.marker, job);
    let mut pose = plan::home_over(input.marker.moved_on, job);
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
