//! `cutc verify`: do programs cut what their cutter files say?

mod arguments;
mod many;
mod one;

pub(super) use arguments::Arguments;

use super::batch::{self, Inputs};
use super::finished::{Console, Finished};

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
