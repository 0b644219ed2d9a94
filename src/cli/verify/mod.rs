//! `cutc verify`: checks that programs cut what their cutter files say.

mod arguments;
mod many;
mod one;

pub(super) use arguments::Arguments;

use super::batch::{self, Input, Inputs};
use super::files::is_plan;
use super::finished::{Console, Finished};

/// True if the only program is a plan.
fn is_only_a_plan(programs: &[Input]) -> bool {
    programs.len() == 1 && is_plan(&programs[0].path)
}

pub(super) fn run(arguments: &Arguments, console: &mut Console) -> anyhow::Result<Finished> {
    let threads = arguments.threads.set();
    match batch::find_programs(&arguments.programs)? {
        Inputs::One(program) if arguments.source.is_dir() => {
            let source = many::source_in(&arguments.source, &Input::named(&program))?;
            one::run(arguments, &program, &source)
        }
        Inputs::One(program) => one::run(arguments, &program, &arguments.source),
        // A plan alone may be named by its folder. Its programs are judged together.
        Inputs::Many(programs) if is_only_a_plan(&programs) && !arguments.source.is_dir() => {
            one::run(arguments, &programs[0].path, &arguments.source)
        }
        Inputs::Many(programs) => many::run(arguments, &programs, threads, console),
    }
}
