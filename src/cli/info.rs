//! `cutc info`: what is in a cutter file.

use std::path::PathBuf;

use clap::Args;

use super::choices::Format;
use super::options::Reading;
use super::{DONE, FAULTY, Finished, files, report, summary};
use crate::diagnostic::{Diagnostics, render};
use crate::pipeline::{self, Report};

/// Arguments of `cutc info`.
#[derive(Debug, Args)]
pub(super) struct Arguments {
    /// Cutter file to look into
    file: PathBuf,

    #[command(flatten)]
    reading: Reading,

    /// How to give the figures
    ///
    /// JSON has the keys of `cutc compile`, with null for what only planning knows.
    #[arg(long, value_enum, default_value = "text")]
    format: Format,
}

pub(super) fn run(arguments: &Arguments) -> anyhow::Result<Finished> {
    let source = files::read(&arguments.file)?;
    let job = match arguments.reading.machine.job()? {
        Ok(job) => job,
        Err(refused) => return Ok(refused),
    };
    let mut diagnostics = Diagnostics::default();
    let input = pipeline::read(&source, arguments.reading.from, &job, &mut diagnostics);
    let report = input.map(|input| Report::of(&input.marker, input.dialect.name));
    let stdout = match (arguments.format, &report) {
        (Format::Json, report) => report::json(report.as_ref(), &diagnostics, &source),
        (Format::Text, Some(report)) => summary::text(report, source.name(), &diagnostics),
        (Format::Text, None) => String::new(),
    };
    let code = if report.is_none() || diagnostics.has_errors() { FAULTY } else { DONE };
    Ok(Finished::text(stdout, render(&diagnostics, &source), code))
}
