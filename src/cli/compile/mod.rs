//! `cutc compile`: cutter files to machine programs.

mod made;
pub(super) mod many;
mod one;

use std::path::{Path, PathBuf};

use clap::Args;

use super::batch::{self, Inputs, Shard, Threads};
use super::choices::{self, Format};
use super::options::{Choice, Messages, Reading};
use super::{Console, DONE, FAULTY, Finished, failure, files};
use crate::back::Target;
use crate::diagnostic::{Diagnostics, render_with};
use crate::machine::Job;
use crate::pipeline;

/// Arguments of `cutc compile`.
#[derive(Debug, Args)]
pub(super) struct Arguments {
    /// Cutter files to compile, folders of such, or patterns as 'in/**/*.cut'; `-` for standard input, then with -o
    #[arg(required = true, value_name = "FILE")]
    files: Vec<PathBuf>,

    #[command(flatten)]
    making: Making,

    #[command(flatten)]
    messages: Messages,

    #[command(flatten)]
    threads: Threads,

    /// Compile only what was changed: what `cutc.jsonl` beside the programs does not have, or not of these bytes, options
    /// and version, or what no longer stands there as it was written
    #[arg(long, help_heading = "Many files")]
    changed: bool,

    /// Compile one part of the files, as in `--shard 3/16`, on one of several machines
    ///
    /// Which part a file belongs to is told by its content. Its manifest is `cutc.3-of-16.jsonl`; the next run with
    /// --changed and without --shard joins those of all parts.
    #[arg(long, value_name = "PART/PARTS", value_parser = Shard::parse, help_heading = "Many files")]
    shard: Option<Shard>,

    /// How to give the figures; of many files JSON is a list, each with its `file`
    #[arg(long, value_enum, default_value = "text")]
    format: Format,

    /// Print what a pass leaves, as text, and write no program
    #[arg(long, value_name = "PASS", value_parser = choices::passes(), conflicts_with_all = ["out", "format", "frame"])]
    dump_after: Option<String>,
}

/// What is made of a file, and where it goes.
#[derive(Debug, Args)]
pub(super) struct Making {
    /// Where the program goes: a file, a directory (made when it ends in `/`), or `-` for standard output
    ///
    /// By default `<stem of FILE>.<extension of the target>` in the current directory. The input is never overwritten, nor
    /// is a program of another input without --force. A name without extension is taken for a directory that is there, else
    /// refused. Of many files it is a directory, made when it is not there, in which folders keep their structure.
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

    /// Overwrite a program even if it was made from another input
    #[arg(long)]
    force: bool,

    #[command(flatten)]
    reading: Reading,

    #[command(flatten)]
    choice: Choice,

    /// Do not read the program back and judge it; summary and provenance say so
    #[arg(long)]
    no_verify: bool,
}

impl Making {
    /// The directory that `-o` names; the current one without it.
    pub(super) fn place(&self) -> &Path {
        self.out.as_deref().unwrap_or(Path::new(""))
    }

    /// The targets as typed.
    pub(super) fn targets(&self) -> &[&'static Target] {
        &self.targets
    }

    /// The machine profile as typed.
    pub(super) fn profile(&self) -> Option<&Path> {
        self.reading.machine.profile.as_deref()
    }

    /// The job, or what is wrong with its profile.
    pub(super) fn job(&self) -> anyhow::Result<Result<Job, Finished>> {
        Ok(self.reading.job()?.map(|job| self.choice.of(job)))
    }
}

pub(super) fn run(arguments: &Arguments, console: &mut Console) -> anyhow::Result<Finished> {
    let threads = arguments.threads.set();
    let inputs = match batch::find(&arguments.files, batch::is_cutter_file, &batch::hint())? {
        Inputs::One(file) if !arguments.changed && arguments.shard.is_none() => {
            return match &arguments.dump_after {
                Some(pass) => dump(arguments, &file, pass),
                None => one::run(arguments, &file),
            };
        }
        Inputs::One(path) => vec![batch::Input::named(&path)],
        Inputs::Many(inputs) => inputs,
    };
    if arguments.dump_after.is_some() {
        return Err(failure("`--dump-after` looks into one file", "name one file, without --changed and --shard"));
    }
    many::run(arguments, &inputs, threads, console)
}

/// What `--dump-after` prints.
fn dump(arguments: &Arguments, file: &Path, pass: &str) -> anyhow::Result<Finished> {
    let source = files::read(file)?;
    let job = match arguments.making.job()? {
        Ok(job) => job,
        Err(refused) => return Ok(refused),
    };
    let mut diagnostics = Diagnostics::default();
    let text = pipeline::dump(&source, arguments.making.reading.from, &job, pass, &mut diagnostics);
    let code = if text.is_none() || diagnostics.has_errors() { FAULTY } else { DONE };
    let said = render_with(&diagnostics, &source, arguments.messages.detail(Format::Text));
    Ok(Finished::text(text.unwrap_or_default(), said, code))
}
