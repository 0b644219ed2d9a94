//! Many files: a row each, and their sum.

use super::arguments::Arguments;
use super::sheet;
use crate::cli::batch::{self, Batch, Columns, Input, Outcome, Row, State, Telling};
use crate::cli::choices::{Format, Sheet};
use crate::cli::files;
use crate::cli::finished::{Console, Finished};
use crate::diagnostic::{Diagnostics, render_with};
use crate::machine::Job;
use crate::machines;
use crate::pipeline::{self, Report};

pub(super) fn run(
    arguments: &Arguments,
    inputs: &[Input],
    threads: usize,
    console: &mut Console,
) -> anyhow::Result<Finished> {
    let job = match arguments.job()? {
        Ok(job) => job,
        Err(refused) => return Ok(refused),
    };
    let quiet = arguments.messages.quiet;
    let price = arguments.pricing.price();
    let telling = Telling { columns: Columns::Counted(price), quiet, json: false };
    let work = |_, input: &Input| arguments.outcome(input, &job).unwrap_or_else(|error| Outcome::failed(input, &error));
    let ended = Batch { inputs, threads, telling }.run(console, work);
    let counts = if quiet { String::new() } else { batch::counts(&ended.rows) };
    let (stdout, stderr) = match arguments.format {
        // The figures are printed even with `--quiet`.
        Sheet::Text => (batch::text(&ended.rows, Telling { quiet: false, ..telling }), String::new()),
        Sheet::Json => (sheet::json(&ended.rows, price), counts),
        Sheet::Csv => (sheet::csv(&ended.rows, price), counts),
    };
    Ok(Finished::text(stdout, stderr, ended.code()))
}

impl Arguments {
    /// Outcome of one of many files.
    fn outcome(&self, input: &Input, job: &Job) -> anyhow::Result<Outcome> {
        let source = files::read(&input.path)?;
        let mut diagnostics = Diagnostics::default();
        let read = pipeline::read(&source, self.reading.from, job, &mut diagnostics);
        let (mut row, mut doubts) = (Row::new(source.name().as_ref(), State::Failed), String::new());
        if let Some(mut read) = read.filter(|_| !diagnostics.has_errors()) {
            let tool = machines::tool_of(job);
            (tool.cuts)(&mut read, &source, job, &mut diagnostics);
            let estimated = (tool.estimate)(&mut read, &source, job, &mut diagnostics)?;
            let report = Report::of(&read.marker, read.dialect.name).estimated(estimated, &read.marker);
            if !diagnostics.has_errors() {
                row.state = State::Done;
                row.pieces = Some(report.pieces);
                row.cut_m = Some(report.cut_m);
                row.time_s = report.time_s();
                row.figures = Some(self.figures(Some(&read.marker), &report, job));
                doubts = self.doubts(source.name(), &report);
            }
        }
        batch::worst(&diagnostics).unwrap_or_default().clone_into(&mut row.worst);
        // No list holds the findings, so they are printed with every format of the figures.
        let mut said = render_with(&diagnostics, &source, self.messages.detail(Format::Text));
        if !self.messages.quiet {
            said.push_str(&doubts);
        }
        Ok(Outcome { row: Some(row), said, json: None })
    }
}
