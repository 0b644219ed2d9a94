//! Options that several commands share.

use std::path::PathBuf;

use clap::Args;

use super::choices::Format;
use super::{FAULTY, Finished, USAGE, choices, failure, files, say};
use crate::diagnostic::{Detail, Severity, render_with};
use crate::front::Dialect;
use crate::machine::plot::{LineKind, Lines};
use crate::machine::{Faults, Job, MachineProfile, Mode, NotNumbers, Numbers, Selection, load};
use crate::source::Source;

/// Which machine.
#[derive(Debug, Args)]
pub(super) struct Machine {
    /// Machine profile to use; `cutc profile init` prints one with every key explained
    ///
    /// Without it the defaults hold: a real cutter's, with a worn 6.6 mm knife.
    #[arg(short, long, value_name = "PROFILE.toml")]
    pub(super) profile: Option<PathBuf>,

    /// Set one key of the profile, as in `--set knife.width_mm=7.2`; may be repeated
    ///
    /// Overrides the profile. `cutc profile init` explains the keys. A bare word needs no quotes: `--set
    /// knife.feed_mm_s=off`.
    #[arg(long, value_name = "KEY=VALUE")]
    set: Vec<String>,
}

/// How much is said about a file.
#[derive(Debug, Clone, Copy, Args)]
#[command(next_help_heading = "Messages")]
pub(super) struct Messages {
    /// Tell every finding; without it at most three of a code, and how many more there are
    #[arg(long, conflicts_with = "quiet")]
    pub(super) all: bool,

    /// Tell errors only
    #[arg(short, long)]
    pub(super) quiet: bool,
}

impl Messages {
    /// What is told on standard error; beside JSON, which holds every finding, only how many there are.
    pub(super) fn detail(self, format: Format) -> Detail {
        match (self, format) {
            (Self { all: true, .. }, _) => Detail::All,
            (Self { quiet: true, .. }, _) => Detail::Errors,
            (_, Format::Json) => Detail::Counts,
            (_, Format::Text) => Detail::Short,
        }
    }
}

/// How an input is read.
#[derive(Debug, Args)]
pub(super) struct Reading {
    /// Read the file as this dialect; do not guess from its content
    ///
    /// What is plainly something else, such as a plot given as a cut file, is refused all the same.
    #[arg(long, value_name = "DIALECT", value_parser = choices::dialects())]
    pub(super) from: Option<&'static Dialect>,

    #[command(flatten)]
    lines: Plotted,

    #[command(flatten)]
    pub(super) machine: Machine,
}

/// Which lines of a plot are cut.
#[derive(Debug, Args)]
#[command(next_help_heading = "Plots (HPGL)")]
struct Plotted {
    /// Of a plot, cut the lines of these pens only, as in `--cut-pens 4`
    ///
    /// Overrides `hpgl.pens` of the profile. `cutc info` shows what the lines of a plot were taken for.
    #[arg(long, value_name = "NUMBERS", value_parser = pens)]
    cut_pens: Option<Numbers>,

    /// Of a plot, cut every line, or all closed or all open ones, whatever their shapes say
    ///
    /// Without it closed outlines and their notches are cut; frames, texts and other lines are not.
    #[arg(long, value_name = "LINES", value_enum)]
    cut: Option<choices::Cut>,
}

impl Reading {
    /// The job on this machine with these lines, or what is wrong with its profile.
    pub(super) fn job(&self) -> anyhow::Result<Result<Job, Finished>> {
        let lines = Lines { pens: self.lines.cut_pens.clone(), kind: self.lines.cut.map(Into::into) };
        Ok(self.machine.job()?.map(|job| Job { lines, ..job }))
    }
}

/// What of a marker is cut, and whether the knife goes down.
#[derive(Debug, Args)]
#[command(next_help_heading = "What is cut")]
pub(super) struct Choice {
    /// Cut these pieces only, by their numbers in the file, as in `--pieces 3,7-12`
    ///
    /// The order stays that of the file. A number that the file does not have is an error. --pieces, --skip and
    /// --resume-from act together.
    #[arg(long, value_name = "NUMBERS", value_parser = numbers)]
    pieces: Option<Numbers>,

    /// Leave these pieces out, as in `--skip 4,9-10`
    #[arg(long, value_name = "NUMBERS", value_parser = numbers)]
    skip: Option<Numbers>,

    /// Cut from the piece of this number on, in cut order: what an interrupted run has left
    #[arg(long, value_name = "NUMBER")]
    resume_from: Option<u32>,

    /// The same motion with knife and drills up: nothing is cut
    #[arg(long, conflicts_with = "frame")]
    dry_run: bool,

    /// No cut, but once around the box of what would be cut, knife up: the C axis from home along it and back
    #[arg(long)]
    frame: bool,
}

fn numbers(text: &str) -> Result<Numbers, NotNumbers> {
    Numbers::parse(text)
}

/// Numbers of pens: any but 0, which stands for none.
fn pens(text: &str) -> anyhow::Result<Numbers> {
    let numbers = numbers(text)?;
    anyhow::ensure!(!numbers.has(0), "pen 0 stands for none: nothing is drawn with it; give others, as in 1,3-4");
    Ok(numbers)
}

impl Choice {
    /// The job, with this choice.
    pub(super) fn of(&self, job: Job) -> Job {
        let selection =
            Selection { pieces: self.pieces.clone(), skip: self.skip.clone(), resume_from: self.resume_from };
        let mode = match (self.dry_run, self.frame) {
            (_, true) => Mode::Frame,
            (true, false) => Mode::Dry,
            (false, false) => Mode::Cut,
        };
        Job { selection, mode, ..job }
    }
}

/// The choice of a job as it is typed; empty when all is cut.
pub(super) fn typed(job: &Job) -> String {
    let Selection { pieces, skip, resume_from } = &job.selection;
    let mut words = Vec::new();
    words.extend(job.lines.pens.iter().map(|numbers| format!("--cut-pens {numbers}")));
    words.extend(job.lines.kind.iter().map(|kind| {
        let name = match kind {
            LineKind::All => "all",
            LineKind::Closed => "closed",
            LineKind::Open => "open",
        };
        format!("--cut {name}")
    }));
    words.extend(pieces.iter().map(|numbers| format!("--pieces {numbers}")));
    words.extend(skip.iter().map(|numbers| format!("--skip {numbers}")));
    words.extend(resume_from.iter().map(|number| format!("--resume-from {number}")));
    match job.mode {
        Mode::Cut => {}
        Mode::Dry => words.push("--dry-run".to_owned()),
        Mode::Frame => words.push("--frame".to_owned()),
    }
    words.join(" ")
}

impl Machine {
    /// The job on this machine, or what is wrong with its profile.
    pub(super) fn job(&self) -> anyhow::Result<Result<Job, Finished>> {
        Ok(self.load()?.map(|profile| Job { profile, ..Job::default() }))
    }

    /// The profile, or what is wrong with it: [`FAULTY`] when the file is, [`USAGE`] when only arguments are.
    pub(super) fn load(&self) -> anyhow::Result<Result<MachineProfile, Finished>> {
        let file = match &self.profile {
            Some(path) if !path.exists() => {
                let path = path.display();
                return Err(failure(
                    format!("there is no profile `{path}`"),
                    format!("check the spelling, or begin one with `cutc profile init -o {path}`"),
                ));
            }
            Some(path) => Some(files::read(path)?),
            None => None,
        };
        Ok(load(file.as_ref(), &self.set).map_err(|faults| refuse(&faults, file.as_ref())))
    }
}

/// What is said about a faulty profile.
pub(super) fn refuse(faults: &Faults, file: Option<&Source>) -> Finished {
    let mut said = String::new();
    if let Some(file) = file {
        said.push_str(&render_with(&faults.file, file, Detail::All));
    }
    let arguments = Source::new("command line", Vec::new()).expect("nothing is small");
    said.push_str(&render_with(&faults.arguments, &arguments, Detail::All));
    let count = faults.file.count(Severity::Error) + faults.arguments.count(Severity::Error);
    let name = file.map_or_else(String::new, |file| format!(" `{}`", file.name()));
    say(&mut said, format_args!("the machine profile{name} has {}", counted(count, "error")));
    Finished::text(String::new(), said, if faults.file.has_errors() { FAULTY } else { USAGE })
}

/// A number with its noun: `1 error`, `2 errors`.
pub(super) fn counted(count: usize, noun: &str) -> String {
    format!("{count} {noun}{}", if count == 1 { "" } else { "s" })
}
