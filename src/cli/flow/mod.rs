//! `cutc flow`: a marker to the programs of heads that cut it while a conveyor moves it.

mod arguments;
mod earlier;
mod judged;
mod made;
mod summary;

pub(super) use arguments::Arguments;
pub(super) use judged::{doubts, judge};

use std::sync::Arc;

use self::made::Made;
use super::choices::Format;
use super::destination::{not_of_another, writable};
use super::draft::MadeFolders;
use super::files::{self, PLAN};
use super::finished::{DONE, FAULTY, Finished, Stdout, failure, say};
use super::options::counted;
use super::report;
use crate::diagnostic::{Diagnostics, Severity, render_with};
use crate::flow::{self, Program, Speed, TARGETS, Target};
use crate::front::Dialect;
use crate::ir::{Finding, Marker};
use crate::machine::{Centre, Job, Mode, ToolKind};
use crate::pipeline::{self, Judged};
use crate::source::Source;

pub(super) fn run(arguments: &Arguments) -> anyhow::Result<Finished> {
    let targets = targets(arguments)?;
    let plan = arguments.out.join(PLAN);
    let [centre, _] = arguments.choice.beside();
    let inputs = [Some(&*arguments.file), arguments.reading.machine.profile.as_deref(), centre];
    let inputs: Vec<_> = inputs.into_iter().flatten().filter(|path| !files::is_dash(path)).collect();
    writable(&plan, &inputs)?;
    if !arguments.force {
        not_of_another(&plan, &arguments.file)?;
    }
    let source = files::read(&arguments.file)?;
    let job = match arguments.choice.job(&arguments.reading)? {
        Ok(job) => job,
        Err(mut refused) => {
            // A slip in an argument is no verdict on the programs that are there.
            if refused.code == FAULTY {
                refused.stderr.push_str(&earlier::move_aside(&arguments.out, &[]));
            }
            return Ok(refused);
        }
    };
    refuse_others(&job)?;
    let job = on_cloth(job, arguments.reading.from, &source);
    let _made = MadeFolders::of([plan.as_path()])?;
    let mut diagnostics = Diagnostics::default();
    let Some(Planned { marker, program, audit }) = planned(arguments, &source, &job, &mut diagnostics) else {
        return Ok(refused(arguments, &source, &diagnostics, &job));
    };
    let verify = !arguments.no_verify;
    let made = Made { targets: &targets, source: &source, job: &job, marker: &marker, verify, audit: &audit };
    let written = made.write(&program, &arguments.out, &mut diagnostics)?;
    if diagnostics.has_errors() {
        return Ok(refused(arguments, &source, &diagnostics, &job));
    }
    let mut said = render_with(&diagnostics, &source, arguments.messages.detail(arguments.format));
    said.push_str(&written.said);
    if !arguments.messages.quiet {
        let count = counted(written.files, "file");
        say(&mut said, format_args!("wrote `{}` and {count} beside it", plan.display()));
    }
    let figures = summary::Figures::of(&program, written);
    let stdout = match arguments.format {
        Format::Json => report::json_by_profile(figures, &diagnostics, &source, &job),
        Format::Text => summary::text(&source, &figures, arguments.messages.quiet),
    };
    Ok(Finished { stdout: Stdout::Text(stdout), stderr: said, code: DONE })
}

/// Refusal of jobs that heads over a conveyor cannot do: dry runs, frames and spray tools.
fn refuse_others(job: &Job) -> anyhow::Result<()> {
    if job.mode != Mode::Cut {
        return Err(failure(
            "heads over a conveyor have no dry run and no frame",
            "leave `--dry-run` and `--frame` out",
        ));
    }
    if job.marks.is_some() {
        return Err(failure(
            "`--map` lays a drawing on a table, and cloth on a conveyor moves",
            "leave `--map` out; `--centre` follows cloth that wanders",
        ));
    }
    if job.profile.bite.length_mm.is_some() {
        return Err(failure(
            "`bite.length_mm` cuts cloth that lies still, and heads over a conveyor cut cloth that moves",
            "leave `bite.length_mm` out",
        ));
    }
    if job.profile.tool.kind == ToolKind::Spray {
        return Err(failure(
            "`tool.kind` is \"spray\", and heads over a conveyor follow lines with a tool that touches the cloth",
            "take a profile of another tool, or `cutc compile` for the spray head",
        ));
    }
    Ok(())
}

/// What is written: what was typed, else the default.
fn targets(arguments: &Arguments) -> anyhow::Result<Vec<&'static Target>> {
    let typed = &arguments.targets;
    if let Some(twice) = typed.iter().enumerate().find(|(i, t)| typed[..*i].iter().any(|u| u.name == t.name)) {
        return Err(failure(format!("the target `{}` is named twice", twice.1.name), "name each target once"));
    }
    Ok(if typed.is_empty() { vec![&TARGETS[0]] } else { typed.clone() })
}

/// What is cut, by which heads, and what is known of it against the bytes of the file.
struct Planned {
    marker: Marker,
    program: Program,
    audit: Vec<Finding>,
}

fn planned(arguments: &Arguments, source: &Source, job: &Job, out: &mut Diagnostics) -> Option<Planned> {
    let Judged { mut input, reading } = pipeline::read_to_judge(source, arguments.reading.from, job, out)?;
    pipeline::make_cuts(&mut input, source, job, out);
    if out.has_errors() {
        return None;
    }
    let program = flow::plan(&input.marker, arguments.speed.unwrap_or(Speed::Profile), job, out)?;
    let audit = pipeline::audited(source, input.dialect, reading, job);
    Some(Planned { marker: input.marker, program, audit })
}

/// The job with its centre line by places of the cloth: the front of the marker comes under the rulers first.
fn on_cloth(job: Job, from: Option<&'static Dialect>, source: &Source) -> Job {
    let Some(centre) = &job.centre else { return job };
    // What is found about the file is said where it is read for good; no place moves along the feed until then.
    let plain = Job { centre: None, ..job.clone() };
    let input = pipeline::read(source, from, &plain, &mut Diagnostics::default());
    let extent = input.map(|input| input.marker.extent()).filter(|extent| !extent.is_empty());
    let Some(extent) = extent else { return job };
    let rulers = extent.max.x + job.profile.flow.rulers_mm;
    let line = centre.line.on_cloth(rulers);
    let centre = Centre { line, source: Arc::clone(&centre.source), rulers: Some(rulers) };
    Job { centre: Some(Arc::new(centre)), ..job }
}

/// What is said when nothing is written. Older programs are moved aside.
fn refused(arguments: &Arguments, source: &Source, diagnostics: &Diagnostics, job: &Job) -> Finished {
    let mut said = render_with(diagnostics, source, arguments.messages.detail(arguments.format));
    let errors = counted(diagnostics.count(Severity::Error), "error");
    let warnings = counted(diagnostics.count(Severity::Warning), "warning");
    say(&mut said, format_args!("{}: {errors}, {warnings}; no program was written", source.name()));
    said.push_str(&earlier::move_aside(&arguments.out, &[]));
    let stdout = match arguments.format {
        Format::Json => report::json_by_profile(summary::nothing(), diagnostics, source, job),
        Format::Text => String::new(),
    };
    Finished::text(stdout, said, FAULTY)
}
