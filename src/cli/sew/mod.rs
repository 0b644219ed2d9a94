//! `cutc sew`: patterns and stitch files to feed pulses, queues and stitch files of a pattern-sewing machine.

mod arguments;
mod made;
mod place;
mod summary;

pub(super) use arguments::Arguments;

use std::path::PathBuf;

use self::made::{Made, Written};
use super::choices::Format;
use super::draft::MadeFolders;
use super::files;
use super::finished::{DONE, FAULTY, Finished, Stdout, failure, say};
use super::options::counted;
use crate::diagnostic::{Diagnostic, Diagnostics, Severity, code, render_with};
use crate::machine::Job;
use crate::sew::{self, Asked, Fifo, Program};
use crate::source::Source;

pub(super) fn run(arguments: &Arguments) -> anyhow::Result<Finished> {
    let targets = place::targets(arguments)?;
    let is_stdout = arguments.out.as_deref().is_some_and(files::is_dash);
    if is_stdout && (arguments.format == Format::Json || targets.len() > 1) {
        return Err(failure(
            "`-o -` is one place for one program, without `--format json`",
            "write to files with -o DIRECTORY",
        ));
    }
    let paths = if is_stdout { Vec::new() } else { place::paths(arguments, &targets)? };
    let source = files::read(&arguments.file)?;
    let job = match arguments.machine.job()? {
        Ok(job) => arguments.of(job),
        Err(mut refused) => {
            // A slip in an argument is no verdict on the program that is there.
            if refused.code == FAULTY {
                refused.stderr.extend(paths.iter().map(|path| files::move_aside(path)));
            }
            return Ok(refused);
        }
    };
    let _made = MadeFolders::of(paths.iter().map(PathBuf::as_path))?;
    let asked = arguments.asked();
    let mut diagnostics = Diagnostics::default();
    let planned = planned(&source, &asked, &job, &mut diagnostics);
    let made = Made { targets: &targets, source: &source, job: &job, asked: &asked, verify: !arguments.no_verify };
    let Some((program, fifo)) = planned else {
        return Ok(refused(arguments, &source, &paths, &diagnostics, &job));
    };
    let written = made.write(&program, &paths, &mut diagnostics)?;
    if diagnostics.has_errors() {
        return Ok(refused(arguments, &source, &paths, &diagnostics, &job));
    }
    let mut said = render_with(&diagnostics, &source, arguments.messages.detail(arguments.format));
    let figures = summary::Figures::of(&program, fifo, &job, &written.verdicts);
    let text = summary::text(&source, &figures, arguments.messages.quiet);
    let Written { stdout, .. } = written;
    let stdout = match (arguments.format, stdout) {
        (_, Some(spool)) => {
            said.push_str(&text);
            Stdout::Program(spool)
        }
        (Format::Json, None) => Stdout::Text(summary::json(figures, &diagnostics, &source, &job)),
        (Format::Text, None) => Stdout::Text(text),
    };
    for path in paths.iter().filter(|_| !arguments.messages.quiet) {
        say(&mut said, format_args!("wrote `{}`", path.display()));
    }
    Ok(Finished { stdout, stderr: said, code: DONE })
}

/// What is sewn, and how the queue fares.
fn planned(source: &Source, asked: &Asked, job: &Job, out: &mut Diagnostics) -> Option<(Program, Fifo)> {
    let program = sew::plan(source, asked, job, out)?;
    let fifo = sew::simulate(&program, job);
    if fifo.underruns > 0 {
        let message = format!(
            "a queue of {} entries, filled at {} a second, runs dry {} times from entry {} on; the machine waits {:.1} s",
            fifo.depth, fifo.producer_hz, fifo.underruns, fifo.first_underrun, fifo.waited_s
        );
        let hint = format!("a host of {:.0} entries a second keeps up (`sewing.producer_hz`)", fifo.needed_hz.ceil());
        out.push(Diagnostic::new(&code::SEW_UNDERRUN, message).hint(hint));
    }
    Some((program, fifo))
}

/// What is said when nothing is written. Older programs of these names are moved aside.
fn refused(
    arguments: &Arguments,
    source: &Source,
    paths: &[PathBuf],
    diagnostics: &Diagnostics,
    job: &Job,
) -> Finished {
    let mut said = render_with(diagnostics, source, arguments.messages.detail(arguments.format));
    let errors = counted(diagnostics.count(Severity::Error), "error");
    let warnings = counted(diagnostics.count(Severity::Warning), "warning");
    say(&mut said, format_args!("{}: {errors}, {warnings}; no program was written", source.name()));
    said.extend(paths.iter().map(|path| files::move_aside(path)));
    let stdout = match arguments.format {
        Format::Json => summary::json(summary::nothing(), diagnostics, source, job),
        Format::Text => String::new(),
    };
    Finished::text(stdout, said, FAULTY)
}
