//! Compile of one file, with detailed messages.

use std::path::{Path, PathBuf};

use tempfile::SpooledTempFile;

use super::arguments::{Arguments, Making};
use super::made::{Compile, Emitted, Ended};
use super::shown::Shown;
use crate::back::TARGETS;
use crate::cli::choices::Format;
use crate::cli::destination::{Asked, Destination, Place};
use crate::cli::draft;
use crate::cli::draft::MadeFolders;
use crate::cli::finished::{DONE, FAULTY, Finished, Stdout, USAGE, failure, say};
use crate::cli::options::counted;
use crate::cli::{files, report, setup, summary};
use crate::diagnostic::{Diagnostics, Severity, code, render_with};
use crate::pipeline::Compiled;
use crate::source::Source;

/// Size of a program for standard output up to which it is kept in memory, bytes; a longer one goes to a temporary file.
const SPOOL_BYTES: usize = 64 << 20;

/// Greatest number of lines about the data for which the whole summary is printed.
const MOST_LINES: usize = 10;

pub(super) fn run(arguments: &Arguments, file: &Path) -> anyhow::Result<Finished> {
    let Making { out, targets, force, .. } = &arguments.making;
    let beside = arguments.making.beside();
    let asked = Asked { all: TARGETS, out: out.as_deref(), targets, input: file, beside, force: *force };
    let Destination { targets, place } = asked.destination()?;
    arguments.making.check_remarks(&targets)?;
    place.refuse_json(arguments.format)?;
    if arguments.making.meta.is_some() && place != Place::Stdout {
        return Err(failure("`--meta` goes with `-o -`", "beside a file the `.meta.json` is written by itself"));
    }
    let source = files::read(file)?;
    let job = match arguments.making.job()? {
        Ok(job) => job,
        Err(refused) => return Ok(place.refused(refused)),
    };
    let shown = Shown::new(arguments.messages.quiet);
    let making = &arguments.making;
    let compile = Compile { making, targets: &targets, source: &source, job: &job, advance: shown.advance() };
    match place {
        Place::Stdout => to_stdout(&compile, arguments),
        Place::Files(paths) => {
            let _made = MadeFolders::of(paths.iter().map(PathBuf::as_path))?;
            Ok(told(&compile, arguments, compile.draft(&paths).publish(None)))
        }
    }
}

fn to_stdout(compile: &Compile, arguments: &Arguments) -> anyhow::Result<Finished> {
    let mut spool = SpooledTempFile::new(SPOOL_BYTES);
    let mut diagnostics = Diagnostics::default();
    let Emitted { compiled, pictures } =
        compile.emit(vec![(String::new(), &mut spool)], &mut diagnostics).map_err(|error| {
            failure(format!("cannot spool the program: {error}"), "make room for temporary files, or write to a file")
        })?;
    let shows_refusal = compiled.is_none() && pictures[0];
    if let (Some(path), Some(compiled)) = (&arguments.making.meta, &compiled) {
        let meta = compile.meta(path, &mut spool, (compile.targets[0], Some(compiled)))?;
        draft::publish(vec![meta], || Ok(()))?;
    }
    let ended = Ended { compiled: Ok(compiled), diagnostics, programs: Vec::new(), beside: String::new() };
    let is_program = matches!(ended.compiled, Ok(Some(_))) || shows_refusal;
    let mut finished = told(compile, arguments, ended);
    if is_program {
        finished.stdout = Stdout::Program(spool);
    }
    Ok(finished)
}

/// Messages about the data and the program, which goes to files or to standard output.
fn told(compile: &Compile, arguments: &Arguments, ended: Ended) -> Finished {
    let Ended { compiled, diagnostics, programs, beside } = ended;
    let mut said = render_with(&diagnostics, compile.source, arguments.messages.detail(arguments.format));
    let compiled = match compiled {
        Ok(compiled) => compiled,
        Err(error) => return Finished::text(String::new(), format!("{said}error: {error:#}\n{beside}"), USAGE),
    };
    let stdout = match arguments.format {
        Format::Json => report::json(compiled.as_ref().map(|c| &c.report), &diagnostics, compile.source, compile.job),
        Format::Text => String::new(),
    };
    match (&compiled, arguments.format) {
        (Some(Compiled { report, verdict, .. }), Format::Text) if !arguments.messages.quiet => {
            let text = summary::text(report, compile.source.name(), &diagnostics);
            // After many lines about the data, the table of the axes is printed on request only.
            let is_long = said.lines().count() > MOST_LINES && !arguments.messages.all;
            said.push_str(if is_long { text.split(summary::AXES).next().unwrap_or(&text) } else { &text });
            said.push_str(&setup::text(compile.job));
            said.push_str(&summary::choice(compile.job));
            said.push_str(&summary::verdict(verdict.as_ref()));
        }
        (Some(_), Format::Json | Format::Text) => {}
        (None, Format::Text | Format::Json) => said.push_str(&refused(compile.source, &programs, &diagnostics)),
    }
    for path in programs.iter().filter(|_| compiled.is_some()) {
        if let Some(line) = files::wrote(path, arguments.messages.quiet) {
            say(&mut said, format_args!("{line}"));
        }
    }
    said.push_str(&beside);
    Finished::text(stdout, said, if compiled.is_some() { DONE } else { FAULTY })
}

/// A line about the reason that there is no program.
pub(super) fn refused(source: &Source, programs: &[PathBuf], diagnostics: &Diagnostics) -> String {
    let errors = counted(diagnostics.count(Severity::Error), "error");
    let warnings = counted(diagnostics.count(Severity::Warning), "warning");
    let broken = diagnostics.iter().filter(|d| d.code == &code::VERIFY_BROKEN).count();
    let why = match broken {
        0 => format!("{errors}, {warnings}"),
        n => format!("the program breaks {} of its verification", counted(n, "rule")),
    };
    let places: Vec<_> = programs.iter().map(|path| format!("`{}`", path.display())).collect();
    let place = if places.is_empty() { String::new() } else { format!(" to {}", places.join(" or ")) };
    format!("{}: {why}; no program was written{place}\n", source.name())
}
