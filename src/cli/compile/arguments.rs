//! The arguments of `cutc compile`.

use std::path::{Path, PathBuf};

use clap::Args;

use crate::back::{Emit, TARGETS, Target};
use crate::cli::batch::{Chosen, Threads};
use crate::cli::choices::{self, Format};
use crate::cli::finished::{Finished, failure};
use crate::cli::options::{Choice, Messages, NO_HEADING, Reading};
use crate::cli::price::Pricing;
use crate::machine::{Job, Remarks};

/// Arguments of `cutc compile`.
#[derive(Debug, Args)]
pub(in crate::cli) struct Arguments {
    /// Cutter files to compile, folders of such, or patterns as 'in/**/*.cut'; `-` for standard input, then with -o
    #[arg(required = true, value_name = "FILE")]
    pub(super) files: Vec<PathBuf>,

    #[command(flatten)]
    pub(super) making: Making,

    #[command(flatten)]
    pub(super) messages: Messages,

    #[command(flatten)]
    pub(super) threads: Threads,

    #[command(flatten)]
    pub(super) chosen: Chosen,

    /// How to give the figures; of many files JSON is a list, each with its `file`
    #[arg(long, value_enum, default_value = "text", help_heading = NO_HEADING)]
    pub(super) format: Format,

    /// Print what a pass leaves, as text, and write no program
    #[arg(long, value_name = "PASS", value_parser = choices::passes(), conflicts_with_all = ["out", "format", "frame"], help_heading = NO_HEADING)]
    pub(super) dump_after: Option<String>,
}

/// What is made of a file, and where it goes.
#[derive(Debug, Args)]
pub(in crate::cli) struct Making {
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
    pub(super) out: Option<PathBuf>,

    /// What to write; several programs are written together or not at all, as in `-t csv,svg`
    ///
    /// Without it the extension of -o chooses, as in `-o marker.svg`; csv goes to `.txt`, directories and `-o -`.
    #[arg(
        short,
        long = "target",
        value_name = "TARGET",
        value_parser = choices::targets(TARGETS),
        value_delimiter = ','
    )]
    pub(super) targets: Vec<&'static Target>,

    /// Overwrite a file even if it was made from another input, or by somebody else
    #[arg(long)]
    pub(in crate::cli) force: bool,

    #[command(flatten)]
    pub(super) reading: Reading,

    #[command(flatten)]
    pub(super) choice: Choice,

    /// How a head at a distance is planned: `--planner quintic` is `--set tool.planner=quintic`
    #[arg(long, value_name = "PLANNER", value_parser = choices::planners(), help_heading = NO_HEADING)]
    pub(super) planner: Option<String>,

    /// Where the `.meta.json` goes of a program that goes to standard output
    #[arg(long, value_name = "FILE", help_heading = NO_HEADING)]
    pub(super) meta: Option<PathBuf>,

    /// Date that a page of the target html prints, as typed: no other date stands in it
    #[arg(long, value_name = "TEXT", help_heading = NO_HEADING)]
    pub(super) date: Option<String>,

    #[command(flatten)]
    pub(super) pricing: Pricing,

    /// Do not read the program back and judge it; summary and provenance say so
    #[arg(long, help_heading = NO_HEADING)]
    pub(super) no_verify: bool,
}

impl Making {
    /// The directory of `-o`; the current one without it.
    pub(in crate::cli) fn place(&self) -> &Path {
        self.out.as_deref().unwrap_or(Path::new(""))
    }

    /// Targets as typed.
    pub(in crate::cli) fn targets(&self) -> &[&'static Target] {
        &self.targets
    }

    /// Machine profile as typed.
    pub(in crate::cli) fn profile(&self) -> Option<&Path> {
        self.reading.machine.profile.as_deref()
    }

    /// The files beside the source, as typed: profile, centre line and marks.
    pub(in crate::cli) fn beside(&self) -> [Option<&Path>; 3] {
        let [centre, map] = self.choice.beside();
        [self.profile(), centre, map]
    }

    /// The job, or the faults of its profile, its centre line or its marks.
    pub(in crate::cli) fn job(&self) -> anyhow::Result<Result<Job, Finished>> {
        let planner: Vec<String> = self.planner.iter().map(|name| format!("{}={name}", choices::PLANNER)).collect();
        let job = self.choice.job_with(&self.reading, &planner)?;
        Ok(job.map(|job| Job { remarks: self.remarks(), ..job }))
    }

    /// Remarks for a page.
    fn remarks(&self) -> Remarks {
        Remarks { date: self.date.clone(), price: self.pricing.price() }
    }

    /// Refuses remarks if no page prints them.
    pub(in crate::cli) fn check_remarks(&self, targets: &[&Target]) -> anyhow::Result<()> {
        let has_page = targets.iter().any(|target| matches!(target.emit, Emit::Page(_)));
        let option = if self.date.is_some() { "--date" } else { "--rate" };
        if has_page || self.remarks() == Remarks::default() {
            return Ok(());
        }
        Err(failure(format!("`{option}` is printed by a page, and none is written"), "add a page with `-t html`"))
    }
}
