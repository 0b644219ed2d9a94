//! The arguments of `cutc track`.

use std::path::PathBuf;

use clap::Args;

use crate::cli::choices::{self, Format};
use crate::cli::options::{Machine, Messages, NO_HEADING};
use crate::track::{TARGETS, Target};

/// Arguments of `cutc track`.
///
/// A log of ruler readings goes through the controller that keeps a carriage over the centre of a moving cloth, row by row:
/// what it commands is written, or the line that the cloth took, which `cutc compile --centre` follows. With --simulate the
/// file is a scenario, and the loop is closed: how well the cloth is followed is measured, other trackers beside it.
/// `cutc manual tracking` has the equations, the columns and the keys.
#[derive(Debug, Args)]
pub(in crate::cli) struct Arguments {
    /// Log of ruler readings, `t_s,i,j` and what else is known; `-` for standard input
    #[arg(value_name = "FILE")]
    pub(super) file: PathBuf,

    /// The file is a scenario: what the cloth does, as TOML; nothing is written unless -t, -o or --plot asks for it
    #[arg(long)]
    pub(super) simulate: bool,

    /// Where it is written: a file, a directory (made when it ends in `/`), or `-` for standard output
    #[arg(short, long)]
    pub(super) out: Option<PathBuf>,

    /// What to write, one or several as in `-t commands,centre`; without it commands
    #[arg(short, long = "target", value_name = "TARGET", value_parser = choices::targets(TARGETS), value_delimiter = ',')]
    pub(super) targets: Vec<&'static Target>,

    /// Draw positions, error and speed over time to this file, as SVG
    #[arg(long, value_name = "FILE")]
    pub(super) plot: Option<PathBuf>,

    /// Overwrite a file even if it was made from another input, or by somebody else
    #[arg(long)]
    pub(super) force: bool,

    #[command(flatten)]
    pub(super) machine: Machine,

    /// How to give the figures
    #[arg(long, value_enum, default_value = "text")]
    pub(super) format: Format,

    #[command(flatten, next_help_heading = NO_HEADING)]
    pub(super) messages: Messages,
}
