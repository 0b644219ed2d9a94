//! `cutc completions` and `cutc man`: shell completions and manual pages, generated from the command line.

use std::io::{self, Write as _};

use clap::{Args, Command};
use clap_complete::Shell;

use super::finished::{DONE, Finished, failure};
use super::help;

/// Arguments of `cutc completions`.
#[derive(Debug, Args)]
pub(super) struct Arguments {
    /// The shell, as in `cutc completions bash > ~/.local/share/bash-completion/completions/cutc`
    #[arg(value_enum)]
    shell: Shell,
}

pub(super) fn run(arguments: &Arguments, mut command: Command) -> Finished {
    let mut out = Vec::new();
    clap_complete::generate(arguments.shell, &mut command, "cutc", &mut out);
    printed(&out)
}

/// Arguments of `cutc man`.
#[derive(Debug, Args)]
pub(super) struct Page {
    /// The command that the page is about, as in `cutc man profile show`; without one, the program
    command: Vec<String>,
}

/// Prints the manual page of the program or of one command. It refers to the pages of its subcommands as `cutc-compile(1)`.
pub(super) fn man(page: &Page, root: Command) -> anyhow::Result<Finished> {
    let mut root = root.disable_help_subcommand(true);
    root.build();
    let mut command = &root;
    for word in &page.command {
        command = command.find_subcommand(word).ok_or_else(|| {
            let below: Vec<&str> = command.get_subcommands().map(Command::get_name).collect();
            failure(
                format!("there is no command `{}` with a page", page.command.join(" ")),
                if below.is_empty() { "leave the last word out".to_owned() } else { below.join(", ") + " have one" },
            )
        })?;
    }
    let mut out = Vec::new();
    let man = clap_mangen::Man::new(command.clone());
    if page.command.is_empty() {
        man.render_title(&mut out)?;
        man.render_name_section(&mut out)?;
        man.render_synopsis_section(&mut out)?;
        man.render_description_section(&mut out)?;
        man.render_options_section(&mut out)?;
        man.render_subcommands_section(&mut out)?;
        verbatim("EXAMPLES", help::EXAMPLES, &mut out)?;
        verbatim("NOTES", &help::reference(), &mut out)?;
        man.render_version_section(&mut out)?;
    } else {
        man.render(&mut out)?;
    }
    Ok(printed(&out))
}

/// Writes a section whose lines are not reflowed.
fn verbatim(title: &str, text: &str, out: &mut Vec<u8>) -> io::Result<()> {
    writeln!(out, ".SH {title}\n.nf")?;
    for line in text.lines() {
        let line = line.replace('\\', "\\e").replace('-', "\\-");
        // A line that begins with a full stop or an apostrophe would be a roff request.
        let guard = if line.starts_with(['.', '\'']) { "\\&" } else { "" };
        writeln!(out, "{guard}{line}")?;
    }
    writeln!(out, ".fi")
}

fn printed(bytes: &[u8]) -> Finished {
    Finished::text(String::from_utf8_lossy(bytes).into_owned(), String::new(), DONE)
}
