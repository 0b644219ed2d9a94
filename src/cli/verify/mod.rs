//! `cutc verify`: do programs cut what their cutter files say?

mod many;
mod one;

use std::path::PathBuf;

use clap::Args;

use super::batch::{self, Inputs, Threads};
use super::choices::Format;
use super::options::{Choice, Messages, Reading};
use super::{Console, Finished};

/// Arguments of `cutc verify`.
///
/// Each program is simulated row by row and judged under every rule: whether all is cut, once and nothing else, how far
/// the tip leaves the path, and whether the axes keep their limits. The exit code is 0 when every rule holds, 1 when one
/// is broken, a file is no program, or the cutter file has errors.
#[derive(Debug, Args)]
pub(super) struct Arguments {
    /// Programs to judge, folders of such, or patterns as 'out/**/*.csv': what `cutc compile` writes with a target of timed
    /// setpoints, with gcode or with iso
    ///
    /// In folders programs are told by the `.meta.json` beside them; pictures and summaries are left out.
    #[arg(required = true, value_name = "PROGRAM")]
    programs: Vec<PathBuf>,

    /// Cutter file that the program must cut, `-` for standard input; or the folder that programs were compiled from
    ///
    /// In a folder the source of each program is found by its `.meta.json`, in the same place below this folder as the
    /// program below its own.
    #[arg(long, value_name = "FILE|FOLDER")]
    source: PathBuf,

    #[command(flatten)]
    reading: Reading,

    #[command(flatten)]
    messages: Messages,

    #[command(flatten)]
    threads: Threads,

    /// What the program was compiled with
    #[command(flatten)]
    choice: Choice,

    /// How to give the verdict; of many programs JSON is a list, each with its `program`
    ///
    /// JSON has `verdict` ("pass" or "fail") and `rules`, each with `code`, `worst`, `limit`, `unit`, `where` and
    /// `holds`. A `worst` of null is beyond measure, a `limit` of null is only reported, a `block` of 0 is none. When
    /// the cutter file has errors, or the program is none, the verdict is "fail" without rules. When rows cannot be read,
    /// `unread` says which, and no rule is there that needs them. G-code tells no times: `untimed` then lists the
    /// rules on these.
    #[arg(long, value_enum, default_value = "text")]
    format: Format,
}

pub(super) fn run(arguments: &Arguments, console: &mut Console) -> anyhow::Result<Finished> {
    let threads = arguments.threads.set();
    match batch::find_programs(&arguments.programs)? {
        Inputs::One(program) if arguments.source.is_dir() => {
            let source = many::source_in(&arguments.source, &batch::Input::named(&program))?;
            one::run(arguments, &program, &source)
        }
        Inputs::One(program) => one::run(arguments, &program, &arguments.source),
        Inputs::Many(programs) => many::run(arguments, &programs, threads, console),
    }
}
