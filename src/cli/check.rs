//! `cutc check`: finds all faults of cutter files.

use std::path::{Path, PathBuf};

use clap::Args;
use serde::Serialize;

use super::batch::{self, Batch, Columns, Input, Inputs, Outcome, Row, State, Telling, Threads};
use super::choices::{self, Format};
use super::files;
use super::finished::{Console, DONE, FAULTY, Finished, USAGE, failure, say};
use super::options::{LeftOut, Messages, Reading, counted};
use super::report::{Findings, pretty};
use super::setup;
use crate::diagnostic::{Diagnostics, Severity, render_with};
use crate::machine::{Job, OrderPolicy};
use crate::machines::{self, Checked, Machine};
use crate::sew::Asked;
use crate::source::Source;

/// Arguments of `cutc check`.
#[derive(Debug, Args)]
pub(super) struct Arguments {
    /// Cutter files to check, folders of such, or patterns as 'in/**/*.cut'; `-` for standard input
    #[arg(required = true, value_name = "FILE")]
    files: Vec<PathBuf>,

    /// Machine that the files are for, which may not be able to do what they say; without it that of the profile's tool
    #[arg(long = "for", value_name = "MACHINE", value_parser = choices::machines())]
    machine: Option<&'static Machine>,

    #[command(flatten)]
    reading: Reading,

    #[command(flatten)]
    left_out: LeftOut,

    #[command(flatten)]
    messages: Messages,

    #[command(flatten)]
    threads: Threads,

    /// How to give the findings
    #[arg(long, value_enum, default_value = "text")]
    format: Format,
}

/// Findings about one file, as JSON.
#[derive(Serialize)]
struct Listing {
    file: String,
    dialect: Option<&'static str>,
    #[serde(flatten)]
    findings: Findings,
}

/// A file with its faults.
struct Found {
    source: Source,
    diagnostics: Diagnostics,
    dialect: Option<&'static str>,
    /// Contents of a good file.
    contents: Option<Checked>,
}

pub(super) fn run(arguments: &Arguments, console: &mut Console) -> anyhow::Result<Finished> {
    let threads = arguments.threads.set();
    let inputs = batch::find(&arguments.files, batch::is_cutter_file, &batch::hint())?;
    let job = match arguments.reading.job()? {
        Ok(job) => arguments.left_out.of(job),
        Err(refused) => return Ok(refused),
    };
    match inputs {
        Inputs::One(file) => Ok(one(arguments, &file, &job)),
        Inputs::Many(inputs) => {
            let Arguments { messages: Messages { quiet, .. }, format, .. } = *arguments;
            if !quiet {
                batch::tell_passed_over(&arguments.files, console);
            }
            let telling = Telling { columns: Columns::Read, quiet, json: format == Format::Json };
            let work = |_, input: &Input| arguments.outcome(input, &job);
            let batch = Batch { inputs: &inputs, threads, telling };
            Ok(batch.run(console, work).finished(telling))
        }
    }
}

/// Checks one file, with a line about the number of findings.
fn one(arguments: &Arguments, file: &Path, job: &Job) -> Finished {
    let (mut said, mut verdicts, mut code) = (String::new(), Vec::new(), DONE);
    match arguments.checked(file, job) {
        Ok(checked) => {
            let Found { source, diagnostics, dialect, contents } = &checked;
            if contents.is_none() {
                code = FAULTY;
            }
            said.push_str(&arguments.said(&checked));
            if !arguments.messages.quiet || diagnostics.has_errors() {
                let errors = counted(diagnostics.count(Severity::Error), "error");
                let warnings = counted(diagnostics.count(Severity::Warning), "warning");
                let dialect = dialect.unwrap_or("unknown");
                say(&mut said, format_args!("{}: {dialect}, {errors}, {warnings}", source.name()));
                said.push_str(&setup::sheet(job));
            }
            verdicts.push(checked.listing());
        }
        Err(error) => {
            say(&mut said, format_args!("error: {error:#}"));
            code = USAGE;
        }
    }
    let stdout = match arguments.format {
        Format::Text => String::new(),
        Format::Json => pretty(&verdicts),
    };
    Finished::text(stdout, said, code)
}

impl Arguments {
    fn checked(&self, file: &Path, job: &Job) -> anyhow::Result<Found> {
        let source = files::read(file)?;
        let mut diagnostics = Diagnostics::default();
        // The findings do not depend on the order of cutting.
        let mut job = job.clone();
        job.profile.order.policy = OrderPolicy::File;
        let machine = self.machine.unwrap_or_else(|| machines::of(&job));
        if let Some([what, hint]) = (machine.refusal)(&job) {
            return Err(failure(what, hint));
        }
        let asked = Asked { from: self.reading.from.map(|dialect| dialect.name.to_owned()), ..Asked::default() };
        let checked = (machine.check)(&source, &asked, &job, &mut diagnostics);
        let dialect = checked.as_ref().map(|checked| checked.format);
        let contents = checked.filter(|_| !diagnostics.has_errors());
        Ok(Found { source, diagnostics, dialect, contents })
    }

    /// Messages about a file.
    fn said(&self, Found { source, diagnostics, .. }: &Found) -> String {
        render_with(diagnostics, source, self.messages.detail(self.format))
    }

    /// Outcome of one of many files.
    fn outcome(&self, input: &Input, job: &Job) -> Outcome {
        match self.checked(&input.path, job) {
            Ok(checked) => {
                let json = (self.format == Format::Json).then(|| pretty(&checked.listing()));
                Outcome { said: self.said(&checked), json, row: Some(checked.row()) }
            }
            Err(error) => Outcome::failed(input, &error),
        }
    }
}

impl Found {
    /// Its row in the table of many files.
    fn row(&self) -> Row {
        let Self { source, diagnostics, contents, .. } = self;
        Row {
            pieces: contents.as_ref().and_then(|contents| contents.pieces),
            cut_m: contents.as_ref().and_then(|contents| contents.cut_m),
            worst: batch::worst(diagnostics).unwrap_or_default().to_owned(),
            ..Row::new(Path::new(source.name()), if contents.is_some() { State::Done } else { State::Failed })
        }
    }

    fn listing(&self) -> Listing {
        let Self { source, diagnostics, dialect, .. } = self;
        Listing { file: source.name().to_owned(), dialect: *dialect, findings: Findings::of(diagnostics, source) }
    }
}
