//! `cutc info`: reports the contents of cutter files.

mod arguments;
mod many;
mod one;
mod sheet;

pub(super) use arguments::Arguments;

use super::batch::{self, Input, Inputs};
use super::choices::Sheet;
use super::finished::{Console, Finished, failure};

pub(super) fn run(arguments: &Arguments, console: &mut Console) -> anyhow::Result<Finished> {
    let threads = arguments.threads.set();
    let inputs = match batch::find(&arguments.files, batch::is_cutter_file, &batch::hint())? {
        Inputs::One(file) if arguments.format != Sheet::Csv => return one::run(arguments, &file),
        Inputs::One(path) => vec![Input::named(&path)],
        Inputs::Many(inputs) => inputs,
    };
    if arguments.labels {
        return Err(failure("`--labels` looks into one file", "name one file, without `--format csv`"));
    }
    if !arguments.messages.quiet {
        batch::tell_passed_over(&arguments.files, console);
    }
    many::run(arguments, &inputs, threads, console)
}
