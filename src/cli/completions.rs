//! `cutc completions` and `cutc man`: what shells and manuals know of the command line, made from it.

use std::io::{self, Write as _};

use clap::{Args, CommandFactory as _};
use clap_complete::Shell;

use super::{DONE, Finished};

/// Arguments of `cutc completions`.
#[derive(Debug, Args)]
pub(super) struct Arguments {
    /// The shell, as in `cutc completions bash > ~/.local/share/bash-completion/completions/cutc`
    #[arg(value_enum)]
    shell: Shell,
}

pub(super) fn run(arguments: &Arguments) -> Finished {
    let mut command = super::Arguments::command();
    let mut out = Vec::new();
    clap_complete::generate(arguments.shell, &mut command, "cutc", &mut out);
    printed(&out)
}

/// The page of the program, and behind it one for each command.
pub(super) fn man() -> anyhow::Result<Finished> {
    let mut command = super::Arguments::command().disable_help_subcommand(true);
    command.build();
    let mut out = Vec::new();
    pages(&command, &mut out)?;
    Ok(printed(&out))
}

fn pages(command: &clap::Command, out: &mut Vec<u8>) -> io::Result<()> {
    clap_mangen::Man::new(command.clone()).render(out)?;
    for inner in command.get_subcommands() {
        out.write_all(b"\n")?;
        pages(inner, out)?;
    }
    Ok(())
}

fn printed(bytes: &[u8]) -> Finished {
    Finished::text(String::from_utf8_lossy(bytes).into_owned(), String::new(), DONE)
}
