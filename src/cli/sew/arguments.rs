//! The arguments of `cutc sew`.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

use crate::cli::batch::{Chosen, Threads};
use crate::cli::choices::{self, Format};
use crate::cli::options::{Machine, Messages, NO_HEADING, Patterned};
use crate::machine::Job;
use crate::machine::sewing;
use crate::sew::{Asked, TARGETS, Target};

/// Arguments of `cutc sew`.
///
/// Lines become stitches, with a needle point on every corner; each run gets the greatest constant speed of the spindle at
/// which all of its stitches fit between feed start and feed end; every pulse of X and Y is timed. What is written is read
/// back and judged first. `cutc manual sewing` has the equations, the keys and the rules.
#[derive(Debug, Args)]
pub(in crate::cli) struct Arguments {
    /// Patterns, stitch files or any files with lines, folders of such, or patterns of names as 'in/*.dst'; `-` for standard
    /// input
    #[arg(required = true, value_name = "FILE")]
    pub(super) files: Vec<PathBuf>,

    /// Where the program goes: a file, a directory (made when it ends in `/`), or `-` for standard output; of many files a
    /// directory
    #[arg(short, long)]
    pub(super) out: Option<PathBuf>,

    /// What to write, one or several as in `-t queue,dst`; without it the extension of -o chooses, else queue
    #[arg(short, long = "target", value_name = "TARGET", value_parser = choices::targets(TARGETS), value_delimiter = ',')]
    pub(super) targets: Vec<&'static Target>,

    /// Overwrite a file even if it was made from another input, or by somebody else
    #[arg(long)]
    pub(super) force: bool,

    /// Read the file as this; do not guess from its content
    #[arg(long, value_name = "FORMAT", value_parser = choices::sewing_formats())]
    from: Option<String>,

    /// Sew the lines of this pen or layer of a drawing, as in `--line 14`, or of several with what is made along them, as
    /// in `--line SEW,TACK=bar-tack`; `seam` = the seam lines that are recognised
    #[arg(long, value_name = "NAME")]
    line: Option<String>,

    /// Sew closed contours so many mm inside; open lines are sewn where they are
    #[arg(long, value_name = "MM", value_parser = inset)]
    inset: Option<f64>,

    /// What is done about stitches that are too long for the speed (overrides `sewing.on_long`)
    #[arg(long, value_enum, value_name = "HOW")]
    on_long: Option<OnLong>,

    #[command(flatten)]
    pub(super) machine: Machine,

    #[command(flatten, next_help_heading = NO_HEADING)]
    patterns: Patterned,

    #[command(flatten)]
    pub(super) threads: Threads,

    #[command(flatten)]
    pub(super) chosen: Chosen,

    /// How to give the figures; of many files JSON is a list
    #[arg(long, value_enum, default_value = "text", help_heading = NO_HEADING)]
    pub(super) format: Format,

    /// Do not read the program back and judge it; summary and provenance say so
    #[arg(long, help_heading = NO_HEADING)]
    pub(super) no_verify: bool,

    #[command(flatten, next_help_heading = NO_HEADING)]
    pub(super) messages: Messages,
}

/// What is done about stitches that are too long.
#[derive(Debug, Clone, Copy, ValueEnum)]
enum OnLong {
    /// The whole run is sewn more slowly
    Slow,
    /// They become several stitches
    Split,
    /// Nothing is written
    Reject,
}

impl From<OnLong> for sewing::OnLong {
    fn from(on_long: OnLong) -> Self {
        match on_long {
            OnLong::Slow => Self::Slow,
            OnLong::Split => Self::Split,
            OnLong::Reject => Self::Reject,
        }
    }
}

/// Reads an inset.
pub(in crate::cli) fn inset(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(value) if (0.0..=1000.0).contains(&value) => Ok(value),
        Ok(_) | Err(_) => Err("expected a number from 0 to 1000 mm".to_owned()),
    }
}

impl Arguments {
    /// Options of the file.
    pub(super) fn asked(&self) -> Asked {
        Asked { from: self.from.clone(), line: self.line.clone(), inset: self.inset.unwrap_or(0.0) }
    }

    /// The job with the options that override its profile.
    pub(super) fn of(&self, job: Job) -> Job {
        let mut job = self.patterns.of(job);
        if let Some(on_long) = self.on_long {
            job.profile.sewing.on_long = on_long.into();
        }
        job
    }
}
