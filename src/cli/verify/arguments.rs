//! Arguments of `cutc verify`.

use std::path::PathBuf;

use clap::Args;

use crate::cli::batch::Threads;
use crate::cli::choices::Format;
use crate::cli::finished::Finished;
use crate::cli::options::{Choice, Messages, NO_HEADING, Reading};
use crate::cli::sew;
use crate::machine::Job;
use crate::sew::Asked;

/// Arguments of `cutc verify`.
///
/// Each program is simulated row by row and judged under every rule: whether all is cut, once and nothing else, how far
/// the tip leaves the path, and whether the axes keep their limits. The exit code is 0 when every rule holds, 1 when one
/// is broken, a file is no program, or the cutter file has errors.
#[derive(Debug, Args)]
pub(in crate::cli) struct Arguments {
    /// Programs to judge, folders of such, or patterns as 'out/**/*.csv': what `cutc compile` writes with a target of timed
    /// setpoints, with gcode or with iso, what `cutc sew` writes, and plans of `cutc flow`, each with the programs of its heads
    ///
    /// In folders programs are told by the `.meta.json` beside them; pictures and summaries are left out.
    #[arg(required = true, value_name = "PROGRAM")]
    pub(super) programs: Vec<PathBuf>,

    /// File that the program must cut or sew, `-` for standard input; or the folder that programs were made from
    ///
    /// In a folder the source of each program is found by its `.meta.json`, in the same place below this folder as the
    /// program below its own.
    #[arg(long, value_name = "FILE|FOLDER")]
    pub(super) source: PathBuf,

    /// The `.meta.json` of a single program, where that does not stand beside it
    #[arg(long, value_name = "FILE", help_heading = NO_HEADING)]
    pub(super) meta: Option<PathBuf>,

    #[command(flatten)]
    pub(super) reading: Reading,

    /// Pen or layer of the lines that were sewn, as for `cutc sew`
    #[arg(long, value_name = "NAME", help_heading = SEWN)]
    pub(super) line: Option<String>,

    /// Inset of closed contours that were sewn, as for `cutc sew`
    #[arg(long, value_name = "MM", value_parser = sew::inset, help_heading = SEWN)]
    pub(super) inset: Option<f64>,

    #[command(flatten)]
    pub(super) messages: Messages,

    #[command(flatten)]
    pub(super) threads: Threads,

    /// How to give the verdict; of many programs JSON is a list, each with its `program`
    ///
    /// JSON has `verdict` ("pass" or "fail") and `rules`, each with `code`, `worst`, `limit`, `unit`, `where` and
    /// `holds`. A `worst` of null is beyond measure, a `limit` of null is only reported, a `block` of 0 is none. When
    /// the cutter file has errors, or the program is none, the verdict is "fail" without rules. When rows cannot be read,
    /// `unread` says which, and no rule is there that needs them. G-code tells no times: `untimed` then lists the
    /// rules on these.
    #[arg(long, value_enum, default_value = "text", help_heading = NO_HEADING)]
    pub(super) format: Format,

    /// What the program was compiled with
    #[command(flatten)]
    pub(super) choice: Choice,
}

/// Heading of the options of sewn programs.
const SEWN: &str = "Programs of cutc sew";

impl Arguments {
    /// The options with which a file was sewn.
    pub(super) fn asked(&self) -> Asked {
        let from = self.reading.from.map(|dialect| dialect.name.to_owned());
        Asked { from, line: self.line.clone(), inset: self.inset.unwrap_or(0.0) }
    }

    /// The job that the programs were made with, or the faults of its profile, its centre line or its marks.
    pub(super) fn job(&self) -> anyhow::Result<Result<Job, Finished>> {
        self.choice.job(&self.reading)
    }
}
