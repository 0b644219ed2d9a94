//! `cutc compile`: a cutter file to a machine program.

use std::io::{self, Write as _};
use std::path::PathBuf;

use clap::Args;
use tempfile::SpooledTempFile;

use super::choices::{self, Format};
use super::files::{self, Asked, Destination, Draft, MadeDirectory, Place};
use super::options::{Choice, Messages, Reading, counted};
use super::provenance::{self, Made, Verified};
use super::{DONE, FAULTY, Finished, Stdout, USAGE, failure, report, say, setup, summary};
use crate::back::Target;
use crate::diagnostic::{Diagnostics, Severity, code, render_with};
use crate::machine::Job;
use crate::pipeline::{self, Compiled, Medium, Product};
use crate::source::Source;

/// Arguments of `cutc compile`.
#[derive(Debug, Args)]
pub(super) struct Arguments {
    /// Cutter file to compile; `-` for standard input, then with -o
    file: PathBuf,

    /// Where the program goes: a file, a directory (made when it ends in `/`), or `-` for standard output
    ///
    /// By default `<stem of FILE>.<extension of the target>` in the current directory. The input is never overwritten.
    /// A name without extension is taken for a directory that is there, else refused.
    /// Beside the program stands its `.meta.json`: what it was made from. A program is read back and judged before it
    /// is written (see `cutc verify`); when it fails, or the compile does, no program is written and an older one of
    /// the same name is moved to `<name>.stale`. A picture is written all the same when the file can be read, with
    /// `refused` across it and the places marked.
    #[arg(short, long)]
    out: Option<PathBuf>,

    /// What to write; several programs are written together or not at all, as in `-t csv,svg`
    ///
    /// Without it the extension of -o chooses, as in `-o marker.svg`; else csv.
    #[arg(
        short,
        long = "target",
        value_name = "TARGET",
        value_parser = choices::targets(),
        value_delimiter = ','
    )]
    targets: Vec<&'static Target>,

    #[command(flatten)]
    reading: Reading,

    #[command(flatten)]
    messages: Messages,

    #[command(flatten)]
    choice: Choice,

    /// Do not read the program back and judge it; summary and provenance say so
    #[arg(long)]
    no_verify: bool,

    /// How to give the figures
    #[arg(long, value_enum, default_value = "text")]
    format: Format,

    /// Print what a pass leaves, as text, and write no program
    #[arg(long, value_name = "PASS", value_parser = choices::passes(), conflicts_with_all = ["out", "format", "frame"])]
    dump_after: Option<String>,
}

/// Bytes of a program for standard output that are kept in memory; a longer one goes to a temporary file.
const SPOOL_BYTES: usize = 64 << 20;

/// Lines about the data that leave room for all of the summary.
const MOST_LINES: usize = 10;

/// What a compile left.
struct Emitted {
    /// The programs; `None` when they were refused.
    compiled: Option<Compiled>,
    /// Which of the targets are pictures of what was refused: they alone are worth keeping then.
    pictures: Vec<bool>,
}

/// One compile, ready to run.
struct Compile<'a> {
    arguments: &'a Arguments,
    targets: Vec<&'static Target>,
    source: Source,
    job: Job,
}

pub(super) fn run(arguments: &Arguments) -> anyhow::Result<Finished> {
    if let Some(pass) = &arguments.dump_after {
        return dump(arguments, pass);
    }
    let profile = arguments.reading.machine.profile.as_deref();
    let asked = Asked { out: arguments.out.as_deref(), targets: &arguments.targets, input: &arguments.file, profile };
    let Destination { targets, place } = asked.destination()?;
    if place == Place::Stdout && arguments.format == Format::Json {
        return Err(failure(
            "`-o -` and `--format json` both want standard output",
            "write the program to a file with -o FILE, or leave --format out",
        ));
    }
    let source = files::read(&arguments.file)?;
    let job = match arguments.reading.job()? {
        Ok(job) => arguments.choice.of(job),
        Err(mut refused) => {
            // A slip in an argument is no verdict on the program that is there.
            if let (FAULTY, Place::Files(paths)) = (refused.code, &place) {
                refused.stderr.push_str(&move_aside(paths));
            }
            return Ok(refused);
        }
    };
    let compile = Compile { arguments, targets, source, job };
    match place {
        Place::Stdout => compile.to_stdout(),
        Place::Files(paths) => Ok(compile.to_files(&paths)),
    }
}

/// Moves older programs aside, and says so.
fn move_aside(paths: &[PathBuf]) -> String {
    paths.iter().map(|path| files::move_aside(path)).collect()
}

/// What `--dump-after` prints.
fn dump(arguments: &Arguments, pass: &str) -> anyhow::Result<Finished> {
    let source = files::read(&arguments.file)?;
    let job = match arguments.reading.job()? {
        Ok(job) => arguments.choice.of(job),
        Err(refused) => return Ok(refused),
    };
    let mut diagnostics = Diagnostics::default();
    let text = pipeline::dump(&source, arguments.reading.from, &job, pass, &mut diagnostics);
    let code = if text.is_none() || diagnostics.has_errors() { FAULTY } else { DONE };
    let said = render_with(&diagnostics, &source, arguments.messages.detail(Format::Text));
    Ok(Finished::text(text.unwrap_or_default(), said, code))
}

impl Compile<'_> {
    fn to_stdout(&self) -> anyhow::Result<Finished> {
        let mut spool = SpooledTempFile::new(SPOOL_BYTES);
        let mut diagnostics = Diagnostics::default();
        let Emitted { compiled, pictures } = self.emit(vec![&mut spool], &mut diagnostics).map_err(|error| {
            failure(format!("cannot spool the program: {error}"), "make room for temporary files, or write to a file")
        })?;
        let mut finished = self.finish(compiled.as_ref(), &diagnostics, &[]);
        if compiled.is_some() || pictures[0] {
            finished.stdout = Stdout::Program(spool);
        }
        Ok(finished)
    }

    fn to_files(&self, paths: &[PathBuf]) -> Finished {
        let mut diagnostics = Diagnostics::default();
        let Emitted { compiled, pictures } = match self.write(paths, &mut diagnostics) {
            Ok(emitted) => emitted,
            Err(error) => {
                let aside = move_aside(paths);
                let said = format!("{}error: {error:#}\n{aside}", self.said(&diagnostics));
                return Finished::text(String::new(), said, USAGE);
            }
        };
        let (shown, programs): (Vec<_>, Vec<_>) = paths.iter().cloned().zip(&pictures).partition(|(_, shows)| **shows);
        let programs: Vec<PathBuf> = programs.into_iter().map(|(path, _)| path).collect();
        let mut finished = self.finish(compiled.as_ref(), &diagnostics, &programs);
        if compiled.is_some() {
            for path in programs.iter().filter(|_| !self.arguments.messages.quiet) {
                say(&mut finished.stderr, format_args!("wrote `{}`", path.display()));
            }
        } else {
            finished.stderr.push_str(&move_aside(&programs));
        }
        for (path, _) in shown {
            say(&mut finished.stderr, format_args!("wrote `{}`, a picture of what was refused", path.display()));
        }
        finished
    }

    /// Writes the programs and their provenance, all whole or none at all; of what is refused the pictures alone.
    fn write(&self, paths: &[PathBuf], diagnostics: &mut Diagnostics) -> anyhow::Result<Emitted> {
        // Outlives the drafts in it.
        let _made = MadeDirectory::of(&paths[0])?;
        let mut programs = paths.iter().map(|path| Draft::new(path)).collect::<anyhow::Result<Vec<_>>>()?;
        let outs = programs.iter_mut().map(|program| program.file() as &mut dyn Medium).collect();
        let emitted = self.emit(outs, diagnostics).map_err(|error| files::cannot_write(&paths[0], &error))?;
        let verified = match &emitted.compiled {
            None => Verified::Refused,
            Some(Compiled { verdict: None, .. }) => Verified::No,
            Some(Compiled { verdict: Some(_), .. }) => Verified::Yes,
        };
        let is_kept = |shows_refusal: bool| shows_refusal || emitted.compiled.is_some();
        let mut drafts = Vec::new();
        for ((path, target), &shows_refusal) in paths.iter().zip(&self.targets).zip(&emitted.pictures) {
            if !is_kept(shows_refusal) {
                continue;
            }
            let path = files::meta(path);
            let mut meta = Draft::new(&path)?;
            let text = provenance::json(&Made { source: &self.source, job: &self.job, target, verified });
            meta.file().write_all(text.as_bytes()).map_err(|error| files::cannot_write(&path, &error))?;
            drafts.push(meta);
        }
        let kept = programs.into_iter().zip(&emitted.pictures).filter(|(_, shows)| is_kept(**shows));
        drafts.extend(kept.map(|(program, _)| program));
        // Nothing takes its place before all is there.
        drafts.into_iter().try_for_each(Draft::publish)?;
        Ok(emitted)
    }

    /// Compiles into `outs`, one for each target, which are worth nothing but as [`Emitted`] says.
    fn emit(&self, outs: Vec<&mut dyn Medium>, diagnostics: &mut Diagnostics) -> io::Result<Emitted> {
        let Arguments { reading, no_verify, .. } = self.arguments;
        let mut products: Vec<Product> =
            self.targets.iter().zip(outs).map(|(target, out)| Product::new(target, out)).collect();
        let asked = (reading.from, !no_verify);
        let compiled = pipeline::compile_all(&self.source, &self.job, asked, &mut products, diagnostics)?;
        Ok(Emitted { compiled, pictures: products.iter().map(|product| product.shows_refusal).collect() })
    }

    /// What is said about the data.
    fn said(&self, diagnostics: &Diagnostics) -> String {
        render_with(diagnostics, &self.source, self.arguments.messages.detail(self.arguments.format))
    }

    /// What is said about the data and the program, which goes to a file or to standard output.
    fn finish(&self, compiled: Option<&Compiled>, diagnostics: &Diagnostics, paths: &[PathBuf]) -> Finished {
        let mut said = self.said(diagnostics);
        let stdout = match self.arguments.format {
            Format::Json => report::json(compiled.map(|c| &c.report), diagnostics, (&self.source, &self.job)),
            Format::Text => String::new(),
        };
        match (compiled, self.arguments.format) {
            (Some(Compiled { report, verdict }), Format::Text) if !self.arguments.messages.quiet => {
                let text = summary::text(report, self.source.name(), diagnostics);
                // Where there is much to read about the data, the table of the axes waits to be asked for.
                let is_long = said.lines().count() > MOST_LINES && !self.arguments.messages.all;
                said.push_str(if is_long { text.split(summary::AXES).next().unwrap_or(&text) } else { &text });
                said.push_str(&setup::text(&self.job));
                said.push_str(&summary::choice(&self.job));
                said.push_str(&summary::verdict(verdict.as_ref()));
            }
            (Some(_), Format::Json | Format::Text) => {}
            (None, Format::Text | Format::Json) => {
                let errors = counted(diagnostics.count(Severity::Error), "error");
                let warnings = counted(diagnostics.count(Severity::Warning), "warning");
                let broken = diagnostics.iter().filter(|d| d.code == &code::VERIFY_BROKEN).count();
                let why = match broken {
                    0 => format!("{errors}, {warnings}"),
                    n => format!("the program breaks {} of its verification", counted(n, "rule")),
                };
                let places: Vec<_> = paths.iter().map(|path| format!("`{}`", path.display())).collect();
                let place = if places.is_empty() { String::new() } else { format!(" to {}", places.join(" or ")) };
                say(&mut said, format_args!("{}: {why}; no program was written{place}", self.source.name()));
            }
        }
        Finished::text(stdout, said, if compiled.is_some() { DONE } else { FAULTY })
    }
}
