//! Many files, each to its place below one folder.

use std::path::PathBuf;

use super::arguments::{Arguments, Making};
use super::made::{Compile, Drafted, Ended, Whole};
use super::one;
use super::overview::{Overview, page_of};
use crate::back::{TARGETS, Target};
use crate::cli::batch::{
    self, Batch, Columns, Input, Line, Made, Manifest, Outcome, Output, Row, Stages, Standing, State, Telling,
    refuse_collisions,
};
use crate::cli::choices::Format;
use crate::cli::destination::{below, not_of_another, targets_of_many};
use crate::cli::draft::{self, MadeFolders};
use crate::cli::finished::{Console, Finished, USAGE, say};
use crate::cli::options::{Messages, remarks, typed};
use crate::cli::{files, report};
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
    let Arguments { making, messages, format, changed, shard, .. } = arguments;
    let out = making.place();
    let targets = targets_of_many(out, TARGETS, &making.targets)?;
    making.check_remarks(&targets)?;
    let job = match making.job()? {
        Ok(job) => job,
        Err(refused) => return Ok(refused),
    };
    let extensions: Vec<&str> = targets.iter().map(|target| target.extension).collect();
    let places: Vec<Vec<PathBuf>> = inputs.iter().map(|input| below(out, &input.name, &extensions)).collect();
    refuse_collisions(inputs, &places)?;
    // A part of the files leaves it to the run over all.
    let overview = Overview::of(out, &targets, places.iter().map(Vec::as_slice)).filter(|_| shard.is_none());
    if let Some(overview) = overview.as_ref().filter(|_| !making.force) {
        overview.may_be_written()?;
    }
    let manifest_at = Manifest::place(out, *shard);
    let mut folder = MadeFolders::of([manifest_at.as_path()])?;
    // Behind another run that may take folders away that it left empty.
    let manifest = Manifest::open(out, *shard, console)?;
    draft::sweep_folders(places.iter().flatten().map(PathBuf::as_path));
    let mut folders = MadeFolders::of(places.iter().flatten().map(PathBuf::as_path))?;
    if shard.is_some() {
        // What this part does not need another may be about to write to.
        folder.keep();
        folders.keep();
    }
    let many = Many { making, targets: &targets, job: &job, manifest: &manifest };
    let work = |i: usize, input: &Input| {
        let source = match files::read(&input.path) {
            Ok(source) => source,
            Err(error) => return Step::Over(Box::new(Outcome::failed(input, &error))),
        };
        let made = many.made(input, &source);
        if shard.is_some_and(|shard| !shard.has(&made.source_sha256)) {
            return Step::Over(Box::new(Outcome::elsewhere()));
        }
        match many.manifest.standing(&made).filter(|_| *changed) {
            Some(line) => Step::Over(Box::new(many.unchanged(input, line))),
            None => Step::Drafted(Box::new(many.draft(input, source, made, &places[i]))),
        }
    };
    let settle = |i: usize, step: Step| match step {
        Step::Over(outcome) => *outcome,
        Step::Drafted(one) => many.publish(*one).outcome(&inputs[i], many.job, *messages, *format),
    };
    let telling = Telling { columns: Columns::Planned, quiet: messages.quiet, json: *format == Format::Json };
    let ended = Batch { inputs, threads, telling }.run_in_stages(console, Stages { work, settle });
    let page = page_of(&targets).unwrap_or_default();
    let rows: Vec<_> = ended.rows.iter().zip(&places).map(|(row, places)| (row, places[page].as_path())).collect();
    let seen = overview.map(|overview| overview.write(&rows));
    let mut finished = ended.finished(telling);
    let path = manifest.path().display().to_string();
    for written in seen.into_iter().chain([manifest.finish().map(|()| path)]) {
        tell(written, messages.quiet, &mut finished);
    }
    Ok(finished)
}

/// Tells the place of a file about all programs, or why it could not be written.
fn tell(written: anyhow::Result<String>, quiet: bool, finished: &mut Finished) {
    match written {
        Ok(path) if !quiet => say(&mut finished.stderr, format_args!("wrote `{path}`")),
        Ok(_) => {}
        Err(error) => {
            say(&mut finished.stderr, format_args!("error: {error:#}"));
            finished.code = USAGE;
        }
    }
}

/// How far one of many files is when it was worked on.
enum Step {
    /// There is no more to do.
    Over(Box<Outcome>),
    /// It was compiled, but is not yet in its places.
    Drafted(Box<One>),
}

/// What all files of a batch or a hot folder share.
#[derive(Clone, Copy)]
pub(in crate::cli) struct Many<'a> {
    pub(in crate::cli) making: &'a Making,
    pub(in crate::cli) targets: &'a [&'static Target],
    pub(in crate::cli) job: &'a Job,
    pub(in crate::cli) manifest: &'a Manifest,
}

impl<'a> Many<'a> {
    /// What programs of an input are made from.
    pub(in crate::cli) fn made(&self, input: &Input, source: &Source) -> Made {
        let mut options = vec![typed(self.job), remarks(self.job)];
        options.extend(self.making.reading.from.map(|dialect| format!("--from {}", dialect.name)));
        let centre = self.job.centre.iter().map(|centre| &centre.source);
        let beside = centre.chain(self.job.marks.iter().map(|marks| marks.source()));
        options.extend(beside.map(|source| format!("(sha256 {})", sha256_hex(source.bytes()))));
        options.extend(self.making.no_verify.then(|| "--no-verify".to_owned()));
        options.retain(|option| !option.is_empty());
        Made {
            source: input.key(),
            targets: self.targets.iter().map(|target| target.name.to_owned()).collect(),
            source_sha256: sha256_hex(source.bytes()),
            profile_sha256: self.job.profile.digest(),
            options: options.join(" "),
            version: env!("CARGO_PKG_VERSION").to_owned(),
        }
    }

    /// The compile of a file; how far it is nobody watches.
    fn of(&self, source: &'a Source, advance: &'a Advance) -> Compile<'a> {
        Compile { making: self.making, targets: self.targets, source, job: self.job, advance }
    }

    /// Compiles a file to drafts of what belongs in its places.
    pub(in crate::cli) fn draft(&self, input: &Input, source: Source, made: Made, paths: &[PathBuf]) -> One {
        let others = paths.iter().filter(|_| !self.making.force);
        let drafted = match others.map(|path| not_of_another(path, &input.path)).find_map(Result::err) {
            Some(error) => Err(error),
            None => Ok(Many::of(self, &source, &Advance::default()).draft(paths)),
        };
        One { source, made, drafted }
    }

    /// Puts what was compiled in its places, and its line in the manifest.
    pub(in crate::cli) fn publish(&self, One { source, made, drafted }: One) -> Published {
        let record = |compiled: Option<&Compiled>, diagnostics: &Diagnostics, whole: Vec<Whole>| {
            let output = |Whole { path, sha256 }| Output { path: self.manifest.name_of(&path), sha256 };
            let report = compiled.map(|compiled| &compiled.report);
            let verdict = match compiled {
                None => Standing::Refused,
                Some(Compiled { verdict: None, .. }) => Standing::Unverified,
                Some(Compiled { verdict: Some(_), .. }) => Standing::Verified,
            };
            self.manifest.add(Line {
                made: made.clone(),
                verdict,
                outputs: whole.into_iter().map(output).collect(),
                pieces: report.map(|report| report.pieces),
                cut_m: report.map(|report| rounded(report.cut_m)),
                time_s: report.and_then(Report::time_s).map(rounded),
                worst: batch::worst(diagnostics).map(str::to_owned),
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

    /// A file of which everything still stands.
    fn unchanged(&self, input: &Input, line: Line) -> Outcome {
        Outcome { row: Some(self.kept(input, line)), said: String::new(), json: None }
    }

    /// The row of a file for which nothing was to do, whose line is kept.
    pub(in crate::cli) fn kept(&self, input: &Input, line: Line) -> Row {
        let state = if line.verdict == Verdict::Refused { State::Failed } else { State::Unchanged };
        let row = Row {
            pieces: line.pieces,
            cut_m: line.cut_m,
            time_s: line.time_s,
            worst: line.worst.clone().unwrap_or_default(),
            ..Row::new(&input.path, state)
        };
        self.manifest.keep(line);
        row
    }
}

/// One of many files, compiled, but not yet in its places.
pub(in crate::cli) struct One {
    source: Source,
    made: Made,
    /// Why nothing was compiled, else what was.
    drafted: anyhow::Result<Drafted>,
}

/// What became of one of many files.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::cli) enum Became {
    /// Its programs.
    Program,
    /// Nothing, and another try would not help: it has errors, or its place is that of a program of another file.
    Refused,
    /// Nothing could be written: a disk is full.
    Unwritten,
}

/// How the compile of one of many files ended.
pub(in crate::cli) struct Published {
    source: Source,
    became: Became,
    ended: Ended,
}

impl Published {
    /// What became of the file.
    pub(in crate::cli) fn became(&self) -> Became {
        self.became
    }

    /// Its row, and what is said about it.
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
            ..Row::new(&input.path, if compiled.is_some() { State::Done } else { State::Failed })
        };
        Outcome { row: Some(row), said: said + &beside, json }
    }
}

/// Micrometres of a metre, microseconds of a second: far below what a machine resolves.
fn rounded(value: f64) -> f64 {
    (value * 1e6).round() / 1e6
}
