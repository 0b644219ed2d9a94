//! `cutc check`: everything that is wrong with some cutter files.

use std::path::PathBuf;

use clap::Args;
use serde::Serialize;

use super::choices::Format;
use super::files;
use super::options::{Messages, Reading, counted};
use super::report::{Findings, pretty};
use super::{DONE, FAULTY, Finished, USAGE, say};
use crate::diagnostic::{Diagnostics, Severity, render_with};
use crate::pipeline;

/// Arguments of `cutc check`.
#[derive(Debug, Args)]
pub(super) struct Arguments {
    /// Cutter files to check; `-` for standard input
    #[arg(required = true, value_name = "FILE")]
    files: Vec<PathBuf>,

    #[command(flatten)]
    reading: Reading,

    #[command(flatten)]
    messages: Messages,

    /// How to give the findings
    #[arg(long, value_enum, default_value = "text")]
    format: Format,
}

/// What is said about one file, as JSON.
#[derive(Serialize)]
struct Verdict {
    file: String,
    dialect: Option<&'static str>,
    #[serde(flatten)]
    findings: Findings,
}

pub(super) fn run(arguments: &Arguments) -> anyhow::Result<Finished> {
    let job = match arguments.reading.job()? {
        Ok(job) => job,
        Err(refused) => return Ok(refused),
    };
    let (mut said, mut verdicts, mut code) = (String::new(), Vec::new(), DONE);
    for file in &arguments.files {
        let source = match files::read(file) {
            Ok(source) => source,
            Err(error) => {
                say(&mut said, format_args!("error: {error:#}"));
                code = USAGE;
                continue;
            }
        };
        let mut diagnostics = Diagnostics::default();
        let input = pipeline::read(&source, arguments.reading.from, &job, &mut diagnostics);
        if diagnostics.has_errors() || input.is_none() {
            code = code.max(FAULTY);
        }
        let dialect = input.map(|input| input.dialect.name);
        said.push_str(&render_with(&diagnostics, &source, arguments.messages.detail(arguments.format)));
        if !arguments.messages.quiet || diagnostics.has_errors() {
            let errors = counted(diagnostics.count(Severity::Error), "error");
            let warnings = counted(diagnostics.count(Severity::Warning), "warning");
            say(&mut said, format_args!("{}: {}, {errors}, {warnings}", source.name(), dialect.unwrap_or("unknown")));
        }
        verdicts.push(Verdict {
            file: source.name().to_owned(),
            dialect,
            findings: Findings::of(&diagnostics, &source),
        });
    }
    let stdout = match arguments.format {
        Format::Text => String::new(),
        Format::Json => pretty(&verdicts),
    };
    Ok(Finished::text(stdout, said, code))
}
