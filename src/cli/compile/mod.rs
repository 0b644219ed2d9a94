//! `cutc compile`: cutter files to machine programs.

mod arguments;
mod made;
pub(super) mod many;
mod one;
pub(super) mod overview;
mod shown;

pub(super) use arguments::{Arguments, Making};

use std::path::Path;

use super::batch::{self, Inputs};
use super::choices::Format;
use super::files;
use super::finished::{Console, DONE, FAULTY, Finished, failure};
use crate::diagnostic::{Diagnostics, render_with};
use crate::pipeline;

pub(super) fn run(arguments: &Arguments, console: &mut Console) -> anyhow::Result<Finished> {
    let threads = arguments.threads.set();
    let inputs = match batch::find(&arguments.files, batch::is_cutter_file, &batch::hint())? {
        Inputs::One(file) if !arguments.chosen.is_of_many() => {
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
    if inputs.len() > 1 && arguments.making.choice.beside()[1].is_some() {
        return Err(one_map());
    }
    if !arguments.messages.quiet {
        batch::tell_passed_over(&arguments.files, console);
    }
    many::run(arguments, &inputs, threads, console)
}

/// The refusal of `--map` for many files.
pub(super) fn one_map() -> anyhow::Error {
    failure("`--map` lays one drawing by the marks of its cloth", "name one file: every cloth has marks of its own")
}

/// Output of `--dump-after`.
fn dump(arguments: &Arguments, file: &Path, pass: &str) -> anyhow::Result<Finished> {
    arguments.making.check_remarks(&[])?;
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
