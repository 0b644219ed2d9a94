//! Many files, each with its place below one folder.

use std::path::PathBuf;

use super::arguments::{Arguments, Making};
use super::made::{Compile, Drafted, Ended};
use super::one;
use super::overview::{Overview, page_of};
use crate::back::{TARGETS, Target};
use crate::cli::batch::{
    self, Columns, Found, Input, Line, Made, Manifest, Outcome, Programs, Row, Standing, State, Telling, Work, rounded,
};
use crate::cli::choices::Format;
use crate::cli::destination::{not_of_another, targets_of_many};
use crate::cli::draft::Whole;
use crate::cli::finished::{Console, Finished};
use crate::cli::options::{Messages, remarks};
use crate::cli::report;
use crate::diagnostic::{Diagnostics, render_with};
use crate::machine::{Job, sha256_hex};
use crate::pipeline::{Advance, Compiled, Report};
use crate::source::Source;

pub(super) fn run(
    arguments: &Arguments,
    inputs: &[Input],
    threads: usize,
    console: &mut Console,
) -> anyhow::Result<Finished> {
    let Arguments { making, messages, format, chosen, .. } = arguments;
    let out = making.place();
    let targets = &targets_of_many(out, TARGETS, &making.targets)?[..];
    making.check_remarks(targets)?;
    let job = match making.job()? {
        Ok(job) => job,
        Err(refused) => return Ok(refused),
    };
    let places = &batch::places(out, targets, inputs)?[..];
    // The overview is written by the run over all parts.
    let overview = Overview::of(out, targets, places.iter().map(Vec::as_slice)).filter(|_| chosen.shard.is_none());
    if let Some(overview) = overview.as_ref().filter(|_| !making.force) {
        overview.may_be_written()?;
    }
    let telling = Telling { columns: Columns::Planned, quiet: messages.quiet, json: *format == Format::Json };
    let work = Work {
        made: |input: &Input, source: &Source| made(making, targets, &job, (input, source)),
        draft: |manifest: &Manifest, input: &Input, source: Source, (made, paths): (Made, &[PathBuf])| {
            Many { making, targets, job: &job, manifest }.draft(input, source, made, paths)
        },
        settle: |manifest: &Manifest, input: &Input, one: One| {
            let published = Many { making, targets, job: &job, manifest }.publish(one);
            published.outcome(input, &job, *messages, *format)
        },
    };
    let programs = Programs { inputs, out, places, chosen: *chosen, threads, telling };
    programs.make(console, work, |ended| {
        let page = page_of(targets)?;
        let rows: Vec<_> = ended.rows.iter().zip(places).map(|(row, places)| (row, places[page].as_path())).collect();
        overview.map(|overview| overview.write(&rows, &job))
    })
}

/// Ingredients of the programs of an input.
pub(in crate::cli) fn made(
    making: &Making,
    targets: &[&'static Target],
    job: &Job,
    (input, source): (&Input, &Source),
) -> Made {
    let mut options = vec![job.typed(), remarks(job)];
    options.extend(making.reading.from.map(|dialect| format!("--from {}", dialect.name)));
    let centre = job.centre.iter().map(|centre| &centre.source);
    let beside = centre.chain(job.marks.iter().map(|marks| marks.source()));
    options.extend(beside.map(|source| format!("(sha256 {})", sha256_hex(source.bytes()))));
    options.extend(making.no_verify.then(|| "--no-verify".to_owned()));
    Made::of((input, source), targets.iter().map(|target| target.name), &job.profile, options)
}

/// Common data of all files of a batch or a hot folder.
#[derive(Clone, Copy)]
pub(in crate::cli) struct Many<'a> {
    pub(in crate::cli) making: &'a Making,
    pub(in crate::cli) targets: &'a [&'static Target],
    pub(in crate::cli) job: &'a Job,
    pub(in crate::cli) manifest: &'a Manifest,
}

impl<'a> Many<'a> {
    /// The compile of a file; its progress is not shown.
    fn of(&self, source: &'a Source, advance: &'a Advance) -> Compile<'a> {
        Compile { making: self.making, targets: self.targets, source, job: self.job, advance }
    }

    /// Compiles a file to drafts.
    pub(in crate::cli) fn draft(&self, input: &Input, source: Source, made: Made, paths: &[PathBuf]) -> One {
        let others = paths.iter().filter(|_| !self.making.force);
        let drafted = match others.map(|path| not_of_another(path, &input.path)).find_map(Result::err) {
            Some(error) => Err(error),
            None => Ok(Many::of(self, &source, &Advance::default()).draft(paths)),
        };
        One { source, made, drafted }
    }

    /// Moves drafts to their places, and adds the line to the manifest.
    pub(in crate::cli) fn publish(&self, One { source, made, drafted }: One) -> Published {
        let record = |compiled: Option<&Compiled>, diagnostics: &Diagnostics, whole: Vec<Whole>| {
            let report = compiled.map(|compiled| &compiled.report);
            let verdict = standing(compiled);
            self.manifest.add(Line {
                pieces: report.map(|report| report.pieces),
                cut_m: report.map(|report| rounded(report.cut_m)),
                time_s: report.and_then(Report::time_s).map(rounded),
                ..self.manifest.line(made.clone(), verdict, whole, diagnostics)
            })
        };
        let is_taken = drafted.is_err();
        let ended = match drafted {
            Ok(drafted) => drafted.publish(Some(&record)),
            Err(error) => Ended::failed(error),
        };
        let became = match &ended.compiled {
            Ok(Some(_)) => Became::Program,
            Ok(None) => Became::Refused,
            Err(_) if is_taken => Became::Refused,
            Err(_) => Became::Unwritten,
        };
        Published { source, became, ended }
    }
}

/// Verdict on the programs of a file.
fn standing(compiled: Option<&Compiled>) -> Standing {
    match compiled {
        None => Standing::Refused,
        Some(Compiled { verdict: None, .. }) => Standing::Unverified,
        Some(Compiled { verdict: Some(_), .. }) => Standing::Verified,
    }
}

/// One of many files, compiled, but not yet in its places.
pub(in crate::cli) struct One {
    source: Source,
    made: Made,
    /// The drafts, or the reason that there are none.
    drafted: anyhow::Result<Drafted>,
}

/// Outcome of one of many files.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::cli) enum Became {
    /// Programs.
    Program,
    /// Refused, and another try would not help: it has errors, or its place is that of a program of another file.
    Refused,
    /// Not written, as when a disk is full.
    Unwritten,
}

/// End of the compile of one of many files.
pub(in crate::cli) struct Published {
    source: Source,
    became: Became,
    ended: Ended,
}

impl Published {
    /// Outcome of the file.
    pub(in crate::cli) fn became(&self) -> Became {
        self.became
    }

    /// Its row and its messages.
    pub(in crate::cli) fn outcome(self, input: &Input, job: &Job, messages: Messages, format: Format) -> Outcome {
        let Self { source, ended, .. } = self;
        let Ended { compiled, diagnostics, programs, beside } = ended;
        let mut said = render_with(&diagnostics, &source, messages.detail(format));
        let compiled = match compiled {
            Ok(compiled) => compiled,
            Err(error) => {
                let Outcome { row, said: failed, .. } = Outcome::failed(input, &error);
                return Outcome { row, said: said + &failed + &beside, json: None };
            }
        };
        let report = compiled.as_ref().map(|compiled| &compiled.report);
        if compiled.is_none() {
            said.push_str(&one::refused(&source, &programs, &diagnostics));
        }
        let json =
            (format == Format::Json).then(|| report::json_of_file(&input.path, report, &diagnostics, &source, job));
        let row = Row {
            pieces: report.map(|report| report.pieces),
            cut_m: report.map(|report| report.cut_m),
            time_s: report.and_then(Report::time_s),
            worst: batch::worst(&diagnostics).unwrap_or_default().to_owned(),
            found: Found::of(&diagnostics),
            verdict: Some(standing(compiled.as_ref())),
            ..Row::new(&input.path, if compiled.is_some() { State::Done } else { State::Failed })
        };
        Outcome { row: Some(row), said: said + &beside, json }
    }
}
