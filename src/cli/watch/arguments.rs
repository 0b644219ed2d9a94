//! Arguments of `cutc watch`.

use std::path::PathBuf;

use clap::Args;

use crate::cli::batch::Threads;
use crate::cli::compile::Making;
use crate::cli::options::Messages;

/// Arguments of `cutc watch`.
///
/// A file is finished when it was renamed into the folder, when its writer closed it, or when it stayed the same for a
/// second. Of a file that is refused `NAME.report.txt` stands where its program would. `cutc.toml` in the folder may
/// hold options of `cutc compile` by their long names, as in `target = ["gcode", "svg"]` or `profile = "machine.toml"`.
#[derive(Debug, Args)]
pub(in crate::cli) struct Arguments {
    /// Folder that cutter files come into, by themselves or in folders
    #[arg(value_name = "FOLDER")]
    pub(super) folder: PathBuf,

    #[command(flatten)]
    pub(super) making: Making,

    #[command(flatten)]
    pub(super) messages: Messages,

    #[command(flatten)]
    pub(super) threads: Threads,
}
