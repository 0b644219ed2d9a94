//! `cutc info`: what is in a cutter file.

use std::path::PathBuf;

use clap::Args;
use serde::Serialize;

use super::choices::Format;
use super::facts::Facts;
use super::labels::{self, Labelled};
use super::options::{Messages, Reading};
use super::times::{self, Timed};
use super::{DONE, FAULTY, Finished, drawn, files, report, setup, summary};
use crate::diagnostic::{Diagnostics, render_with};
use crate::ir::Marker;
use crate::machine::Job;
use crate::pipeline::{self, Report};
use crate::source::Source;

/// Arguments of `cutc info`.
#[derive(Debug, Args)]
pub(super) struct Arguments {
    /// Cutter file to look into; `-` for standard input
    file: PathBuf,

    #[command(flatten)]
    reading: Reading,

    #[command(flatten)]
    messages: Messages,

    /// Also list the labels of each piece: place, angle, text, and the fields of the list behind M0
    ///
    /// Texts that are no UTF-8 are read in the encoding `labels.encoding` of the profile, as in `--set
    /// labels.encoding=windows-1251`.
    #[arg(long)]
    labels: bool,

    /// Also plan the program: what it takes, piece by piece, and what keeps it from being faster
    ///
    /// Nothing is written and nothing is verified.
    #[arg(long)]
    time: bool,

    /// How to give the figures
    ///
    /// JSON has the keys of `cutc compile`, `profile` and `knife` among them, with null for what only planning knows, and `notch_depths`, `speeds` and
    /// `events`; with --labels also `labels_by_piece`, with --time what planning knows, and `time_by_piece`.
    #[arg(long, value_enum, default_value = "text")]
    format: Format,
}

pub(super) fn run(arguments: &Arguments) -> anyhow::Result<Finished> {
    let source = files::read(&arguments.file)?;
    let job = match arguments.reading.job()? {
        Ok(job) => job,
        Err(refused) => return Ok(refused),
    };
    let mut diagnostics = Diagnostics::default();
    let input = pipeline::read(&source, arguments.reading.from, &job, &mut diagnostics);
    let mut known = None;
    if let Some(input) = input {
        let mut all = Known::of(&input.marker, input.dialect.name);
        if arguments.labels {
            all.labels_by_piece = Some(labels::of(&input.marker, &source, &job));
        }
        if arguments.time && !diagnostics.has_errors() {
            all.report.program = pipeline::estimate(&input, &source, &job, &mut diagnostics)?;
            all.time_by_piece = Some(times::of(&all.report.program));
        }
        known = Some(all);
    }
    let stdout = match (arguments.format, &known) {
        (Format::Json, Some(known)) => report::json_of(known, &diagnostics, (&source, &job)),
        (Format::Json, None) => {
            let blank = Known::of(&Marker::default(), "");
            report::json_of(report::nothing(&blank), &diagnostics, (&source, &job))
        }
        (Format::Text, Some(known)) => known.text((&source, &job), &diagnostics),
        (Format::Text, None) => String::new(),
    };
    let code = if known.is_none() || diagnostics.has_errors() { FAULTY } else { DONE };
    Ok(Finished::text(stdout, render_with(&diagnostics, &source, arguments.messages.detail(arguments.format)), code))
}

/// What is known of a file.
#[derive(Debug, Serialize)]
struct Known {
    #[serde(flatten)]
    report: Report,
    #[serde(flatten)]
    facts: Facts,
    /// Only when it was asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    labels_by_piece: Option<Vec<Labelled>>,
    /// Likewise.
    #[serde(skip_serializing_if = "Option::is_none")]
    time_by_piece: Option<Vec<Timed>>,
}

impl Known {
    fn of(marker: &Marker, dialect: &'static str) -> Self {
        Self {
            report: Report::of(marker, dialect),
            facts: Facts::of(marker),
            labels_by_piece: None,
            time_by_piece: None,
        }
    }

    fn text(&self, (source, job): (&Source, &Job), diagnostics: &Diagnostics) -> String {
        let mut out = summary::text(&self.report, source.name(), diagnostics);
        out += &drawn::text(&self.report);
        out += &self.facts.text();
        if let Some(labels) = &self.labels_by_piece {
            out += &labels::text(labels);
        }
        if let Some(times) = &self.time_by_piece {
            out += &setup::text(job);
            out += &times::text(times);
        }
        out
    }
}
