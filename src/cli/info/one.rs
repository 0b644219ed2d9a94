//! Contents of one file.

use std::fmt::Write as _;
use std::path::Path;

use serde::Serialize;

use super::arguments::{Arguments, DIGITS};
use super::sheet::Costs;
use crate::cli::batch::{Figures, Row, State};
use crate::cli::choices::{Format, Sheet};
use crate::cli::facts::Facts;
use crate::cli::finished::{DONE, FAULTY, Finished};
use crate::cli::labels::{self, Labelled};
use crate::cli::times::{self, Timed};
use crate::cli::{drawn, files, report, setup, summary};
use crate::diagnostic::{Diagnostics, render_with};
use crate::ir::Marker;
use crate::machine::Job;
use crate::machines;
use crate::pipeline::{self, Report, significant};
use crate::source::Source;
use crate::units::number::fixed;

pub(super) fn run(arguments: &Arguments, file: &Path) -> anyhow::Result<Finished> {
    let source = files::read(file)?;
    let job = match arguments.job()? {
        Ok(job) => job,
        Err(refused) => return Ok(refused),
    };
    let mut diagnostics = Diagnostics::default();
    let tool = machines::tool_of(&job);
    let input = pipeline::read(&source, arguments.reading.from, &job, &mut diagnostics);
    let mut known = None;
    if let Some(mut input) = input {
        if !diagnostics.has_errors() {
            (tool.cuts)(&mut input, &source, &job, &mut diagnostics);
        }
        let report = Report::of(&input.marker, input.dialect.name);
        let figures = arguments.figures(Some(&input.marker).filter(|_| !diagnostics.has_errors()), &report, &job);
        let mut all = Known::of(report, Facts::of(&input.marker), figures);
        if arguments.labels {
            all.labels_by_piece = Some(labels::of(&input.marker, &source, &job));
        }
        let is_planned = arguments.time || arguments.pricing.price().is_some();
        if is_planned && !diagnostics.has_errors() {
            let estimated = (tool.estimate)(&mut input, &source, &job, &mut diagnostics)?;
            all.report = all.report.estimated(estimated, &input.marker);
            all.time_by_piece = arguments.time.then(|| times::of(&all.report.program, &input.marker, &job.profile));
        }
        all.price(arguments);
        known = Some(all);
    }
    let format = match arguments.format {
        Sheet::Json => Format::Json,
        Sheet::Text | Sheet::Csv => Format::Text,
    };
    let stdout = match (format, &known) {
        (Format::Json, Some(known)) => report::json_of(known, &diagnostics, &source, &job),
        (Format::Json, None) => {
            let (nothing, report) = (Marker::default(), Report::of(&Marker::default(), ""));
            let mut blank = Known::of(report.clone(), Facts::of(&nothing), arguments.figures(None, &report, &job));
            blank.price(arguments);
            report::json_of(report::nothing(&blank), &diagnostics, &source, &job)
        }
        (Format::Text, Some(known)) => known.text(&source, &job, &diagnostics),
        (Format::Text, None) => String::new(),
    };
    let mut said = render_with(&diagnostics, &source, arguments.messages.detail(format));
    if let Some(known) = known.as_ref().filter(|_| !arguments.messages.quiet) {
        said.push_str(&arguments.doubts(source.name(), &known.report));
    }
    let code = if known.is_none() || diagnostics.has_errors() { FAULTY } else { DONE };
    Ok(Finished::text(stdout, said, code))
}

/// Figures of a file.
#[derive(Debug, Serialize)]
struct Known {
    #[serde(flatten)]
    report: Report,
    #[serde(flatten)]
    facts: Facts,
    #[serde(flatten)]
    used: Used,
    /// Present only on request.
    #[serde(skip_serializing_if = "Option::is_none")]
    labels_by_piece: Option<Vec<Labelled>>,
    /// Present only on request.
    #[serde(skip_serializing_if = "Option::is_none")]
    time_by_piece: Option<Vec<Timed>>,
    /// Present only on request.
    #[serde(flatten)]
    costs: Option<Costs>,
    #[serde(skip)]
    figures: Figures,
}

/// Use of the cloth.
#[derive(Debug, Serialize)]
struct Used {
    /// Null for a file with errors, or when it is unknown.
    area_m2: Option<f64>,
    cloth_length_mm: f64,
    cloth_width_mm: f64,
    /// Null without cloth.
    utilisation_percent: Option<f64>,
}

impl Used {
    fn of(figures: &Figures) -> Self {
        Self {
            area_m2: figures.area_m2.map(|area| significant(area, DIGITS)),
            cloth_length_mm: significant(figures.cloth.length_mm, DIGITS),
            cloth_width_mm: significant(figures.cloth.width_mm, DIGITS),
            utilisation_percent: figures.utilisation_percent().map(|used| significant(used, DIGITS)),
        }
    }
}

impl Known {
    /// Figures that need no more work.
    fn of(report: Report, facts: Facts, figures: Figures) -> Self {
        let used = Used::of(&figures);
        Self { report, facts, used, labels_by_piece: None, time_by_piece: None, costs: None, figures }
    }

    /// Adds the costs, if they are requested and the time is known.
    fn price(&mut self, arguments: &Arguments) {
        let row = Row {
            pieces: Some(self.report.pieces),
            time_s: self.report.time_s(),
            ..Row::new(Path::new(""), State::Done)
        };
        self.costs = arguments.pricing.price().map(|price| Costs::of(&row, price));
    }

    fn text(&self, source: &Source, job: &Job, diagnostics: &Diagnostics) -> String {
        let text = summary::text(&self.report, source.name(), diagnostics);
        // The table of the axes stays last.
        let (head, axes) = text.split_at(text.find(summary::AXES).unwrap_or(text.len()));
        let mut out = head.to_owned();
        if self.time_by_piece.is_none() {
            out += &setup::sheet(job);
        }
        out += &self.cloth();
        out += axes;
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

    /// Lines about the cloth and the costs.
    fn cloth(&self) -> String {
        let Figures { area_m2, cloth, .. } = &self.figures;
        let mut out = String::new();
        // Writing into a `String` cannot fail, so the results of `writeln!` are dropped throughout.
        if let Some(area) = area_m2 {
            let _ = writeln!(out, "  area       {} m2 of parts", fixed(*area, 4));
        }
        if let Some(used) = self.figures.utilisation_percent() {
            let [length, width] = [cloth.length_mm, cloth.width_mm].map(|side| fixed(side, 1));
            let _ = writeln!(out, "  used       {} % of {length} x {width} mm of cloth", fixed(used, 1));
        }
        out + &self.costs.as_ref().map_or_else(String::new, Costs::text)
    }
}
