//! `cutc check`: everything that is wrong with some cutter files.

use std::path::{Path, PathBuf};

use clap::Args;
use serde::Serialize;

use super::batch::{self, Batch, Columns, Input, Inputs, Outcome, Row, State, Telling, Threads};
use super::choices::Format;
use super::files;
use super::finished::{Console, DONE, FAULTY, Finished, USAGE, say};
use super::options::{LeftOut, Messages, Reading, counted};
use super::report::{Findings, pretty};
use super::setup;
use crate::diagnostic::{Diagnostics, Severity, render_with};
use crate::ir::Marker;
use crate::machine::{Job, OrderPolicy};
use crate::pipeline;
use crate::source::Source;
use crate::units::MM_PER_M;

/// Arguments of `cutc check`.
#[derive(Debug, Args)]
pub(super) struct Arguments {
    /// Cutter files to check, folders of such, or patterns as 'in/**/*.cut'; `-` for standard input
    #[arg(required = true, value_name = "FILE")]
    files: Vec<PathBuf>,

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

/// What is said about one file, as JSON.
#[derive(Serialize)]
struct Listing {
    file: String,
    dialect: Option<&'static str>,
    #[serde(flatten)]
    findings: Findings,
}

/// A file as it was found to be.
struct Checked {
    source: Source,
    diagnostics: Diagnostics,
    dialect: Option<&'static str>,
    /// The marker of a good file.
    marker: Option<Marker>,
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

/// One file, with a line on how much is wrong with it.
fn one(arguments: &Arguments, file: &Path, job: &Job) -> Finished {
    let (mut said, mut verdicts, mut code) = (String::new(), Vec::new(), DONE);
    match arguments.checked(file, job) {
        Ok(checked) => {
            let Checked { source, diagnostics, dialect, marker } = &checked;
            if marker.is_none() {
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
    fn checked(&self, file: &Path, job: &Job) -> anyhow::Result<Checked> {
        let source = files::read(file)?;
        let mut diagnostics = Diagnostics::default();
        // Whatever the order, the same is wrong with a file.
        let mut job = job.clone();
        job.profile.order.policy = OrderPolicy::File;
        let input = pipeline::check(&source, self.reading.from, &job, &mut diagnostics);
        let dialect = input.as_ref().map(|input| input.dialect.name);
        let marker = input.filter(|_| !diagnostics.has_errors()).map(|input| input.marker);
        Ok(Checked { source, diagnostics, dialect, marker })
    }

    /// What is said of a file.
    fn said(&self, Checked { source, diagnostics, .. }: &Checked) -> String {
        render_with(diagnostics, source, self.messages.detail(self.format))
    }

    /// What becomes of one of many files.
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

impl Checked {
    /// Its row in the table of many files.
    fn row(&self) -> Row {
        let Self { source, diagnostics, marker, .. } = self;
        Row {
            pieces: marker.as_ref().map(|marker| marker.pieces.len()),
            cut_m: marker.as_ref().map(|marker| marker.cut_length() / MM_PER_M),
            worst: batch::worst(diagnostics).unwrap_or_default().to_owned(),
            ..Row::new(Path::new(source.name()), if marker.is_some() { State::Done } else { State::Failed })
        }
    }

    fn listing(&self) -> Listing {
        let Self { source, diagnostics, dialect, .. } = self;
        Listing { file: source.name().to_owned(), dialect: *dialect, findings: Findings::of(diagnostics, source) }
    }
}
