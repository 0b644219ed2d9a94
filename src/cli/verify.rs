//! `cutc verify`: does a program cut what its cutter file says?

use std::path::PathBuf;

use clap::Args;

use super::choices::Format;
use super::options::{Choice, Messages, Reading, counted};
use super::verdict::{self, Judgement};
use super::{DONE, FAULTY, Finished, failure, files, provenance, say};
use crate::diagnostic::{Diagnostics, Severity, render_with};
use crate::pipeline::{self, Verdict};

/// Arguments of `cutc verify`.
///
/// The program is simulated row by row and judged under every rule: whether all is cut, once and nothing else, how far
/// the tip leaves the path, and whether the axes keep their limits. The exit code is 0 when every rule holds, 1 when one
/// is broken, the file is no program, or the cutter file has errors.
#[derive(Debug, Args)]
pub(super) struct Arguments {
    /// Program to judge: what `cutc compile` writes with a target of timed setpoints, with gcode or with iso
    program: PathBuf,

    /// Cutter file that the program must cut; `-` for standard input
    #[arg(long, value_name = "FILE")]
    source: PathBuf,

    #[command(flatten)]
    reading: Reading,

    #[command(flatten)]
    messages: Messages,

    /// What the program was compiled with
    #[command(flatten)]
    choice: Choice,

    /// How to give the verdict
    ///
    /// JSON has `verdict` ("pass" or "fail") and `rules`, each with `code`, `worst`, `limit`, `unit`, `where` and
    /// `holds`. A `worst` of null is beyond measure, a `limit` of null is only reported, a `block` of 0 is none. When
    /// the cutter file has errors, or the program is none, the verdict is "fail" without rules. When rows cannot be read,
    /// `unread` says which, and no rule is there that needs them. G-code tells no times: `untimed` then lists the
    /// rules on these.
    #[arg(long, value_enum, default_value = "text")]
    format: Format,
}

pub(super) fn run(arguments: &Arguments) -> anyhow::Result<Finished> {
    let name = arguments.program.display().to_string();
    let mut program = files::open(&arguments.program)?;
    let cannot = |error| failure(format!("cannot read `{name}`: {error}"), "check the disk that it is on");
    if let Some([what, hint]) = pipeline::foreign(&mut program).map_err(cannot)? {
        let stdout = match arguments.format {
            Format::Json => verdict::json(None),
            Format::Text => String::new(),
        };
        let first =
            "first comes what `cutc compile` wrote with a target that is judged, then its cutter file as --source";
        let not = failure(format!("not a program: `{name}`: {what}"), format!("{hint}; {first}"));
        return Ok(Finished::text(stdout, format!("error: {not}\n"), FAULTY));
    }
    let source = files::read(&arguments.source)?;
    let job = match arguments.reading.job()? {
        Ok(job) => arguments.choice.of(job),
        Err(refused) => return Ok(refused),
    };
    let mut diagnostics = Diagnostics::default();
    let judged = pipeline::judge_program(&mut program, &source, arguments.reading.from, &job, &mut diagnostics)
        .map_err(cannot)?;
    let mut said = render_with(&diagnostics, &source, arguments.messages.detail(arguments.format));
    if !arguments.messages.quiet {
        said.push_str(&provenance::doubts(&arguments.program, &source, &job));
    }
    if judged.is_none() {
        let errors = counted(diagnostics.count(Severity::Error), "error");
        say(&mut said, format_args!("{}: {errors}; `{name}` was not judged", source.name()));
    }
    let stdout = match (arguments.format, &judged) {
        (Format::Json, judged) => verdict::json(judged.as_ref()),
        (Format::Text, Some(verdict)) => {
            verdict::text(&Judgement { verdict, mode: job.mode, program: &name, source: source.name() })
        }
        (Format::Text, None) => String::new(),
    };
    let code = if judged.is_some_and(|judged| Verdict::passes(&judged)) { DONE } else { FAULTY };
    Ok(Finished::text(stdout, said, code))
}
