//! `cutc info`: what is in a cutter file.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::PathBuf;

use clap::Args;

use super::choices::Format;
use super::options::Reading;
use super::{DONE, FAULTY, Finished, drawn, files, report, summary};
use crate::diagnostic::{Diagnostics, render};
use crate::ir::Marker;
use crate::ir::marker::NotchKind;
use crate::pipeline::{self, Report};
use crate::units::number::fixed;

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
    let job = match arguments.reading.job()? {
        Ok(job) => job,
        Err(refused) => return Ok(refused),
    };
    let mut diagnostics = Diagnostics::default();
    let input = pipeline::read(&source, arguments.reading.from, &job, &mut diagnostics);
    let depths = input.as_ref().map_or(String::new(), |input| depths(&input.marker));
    let report = input.map(|input| Report::of(&input.marker, input.dialect.name));
    let stdout = match (arguments.format, &report) {
        (Format::Json, report) => report::json(report.as_ref(), &diagnostics, &source),
        (Format::Text, Some(report)) => summary::text(report, source.name(), &diagnostics) + &drawn::text(report) + &depths,
        (Format::Text, None) => String::new(),
    };
    let code = if report.is_none() || diagnostics.has_errors() { FAULTY } else { DONE };
    Ok(Finished::text(stdout, render(&diagnostics, &source), code))
}

/// Notches by kind and depth, a line each; nothing when there are none.
fn depths(marker: &Marker) -> String {
    // Depths in tenths of a millimetre: finer ones are rounding of the file.
    let mut counts: BTreeMap<(&str, i64), usize> = BTreeMap::new();
    let tenths = |depth: f64| (depth * 10.0).round() as i64;
    for piece in &marker.pieces {
        for notch in &piece.notches {
            let kind = match notch.kind {
                NotchKind::Slit => "slit",
            };
            *counts.entry((kind, tenths(notch.depth()))).or_default() += 1;
        }
        for vee in &piece.vees {
            *counts.entry(("v", tenths(vee.depth()))).or_default() += 1;
        }
    }
    let mut out = String::new();
    if !counts.is_empty() {
        out.push_str("\n  notch  depth mm  count\n");
    }
    for ((kind, depth), count) in counts {
        // Writing into a `String` cannot fail.
        let _ = writeln!(out, "  {kind:5}  {:>8}  {count:>5}", fixed(depth as f64 / 10.0, 1));
    }
    out
}
