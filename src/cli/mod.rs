//! The command line: arguments as typed to a job as meant, one file a subcommand.
//!
//! Receives parsed arguments, reads and writes files, and hands back what is to be printed: only `main.rs` prints and
//! exits. Help texts, flag values and names come from the tables of the stages.

mod batch;
mod check;
mod choices;
mod compile;
mod completions;
mod destination;
mod draft;
mod drawn;
mod explain;
mod facts;
mod files;
mod help;
mod info;
mod labels;
mod manual;
mod options;
mod price;
mod profile;
mod provenance;
mod report;
mod setup;
mod stop;
mod summary;
mod times;
mod verdict;
mod verify;
mod watch;

pub use stop::{STOPPED, stop};

use std::ffi::OsString;
use std::fmt::Write as _;
use std::io::{self, Read as _, Seek as _, Write};

use clap::{Parser, Subcommand};
use tempfile::SpooledTempFile;
use thiserror::Error;

/// Exit code: done.
pub const DONE: u8 = 0;
/// Exit code: the data has errors, or a program is not what it should be.
pub const FAULTY: u8 = 1;
/// Exit code: the arguments are wrong, or a file cannot be read or written.
pub const USAGE: u8 = 2;

/// The command line as typed.
#[derive(Debug, Parser)]
#[command(
    name = "cutc",
    version,
    about = "Compiles garment cutter files to machine programs for a tangential knife",
    after_help = "`cutc help COMMAND` or `cutc COMMAND --help` explains a command; `cutc --help` has examples.",
    after_long_help = help::overview(),
    max_term_width = 100,
    arg_required_else_help = true
)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Compile cutter files to machine programs
    Compile(compile::Arguments),
    /// Compile every cutter file that comes into a folder, until it is stopped
    Watch(watch::Arguments),
    /// Judge programs, edited by hand or not: do they cut what their cutter files say?
    Verify(verify::Arguments),
    /// Read cutter files and say everything that is wrong with them; writes nothing
    Check(check::Arguments),
    /// Say what is in cutter files: pieces, notches, speeds, labels, area, costs
    Info(info::Arguments),
    /// Show, begin or check a machine profile
    Profile(profile::Arguments),
    /// Explain a code of a message or a rule of the verifier; without one, list them all
    Explain(explain::Arguments),
    /// Print a page of the manual; without one, list them
    Manual(manual::Arguments),
    /// Print completions of the command line for a shell
    Completions(completions::Arguments),
    /// Print the manual page of the program, or of a command
    Man(completions::Page),
}

/// Where a command that takes long says what it has found so far.
pub struct Console<'a> {
    /// Standard output.
    pub out: &'a mut dyn Write,
    /// Standard error.
    pub err: &'a mut dyn Write,
}

/// What a command leaves to print, and its exit code.
#[derive(Debug)]
pub struct Finished {
    /// For standard output.
    pub stdout: Stdout,
    /// For standard error.
    pub stderr: String,
    /// [`DONE`], [`FAULTY`] or [`USAGE`]; of who was asked to end by a signal what shells make of that.
    pub code: u8,
}

/// What goes to standard output.
#[derive(Debug)]
pub enum Stdout {
    /// Text; may be empty.
    Text(String),
    /// A whole program, from its start.
    Program(SpooledTempFile),
}

impl Stdout {
    /// Copies it to a writer.
    pub fn copy_to(self, out: &mut impl Write) -> io::Result<()> {
        match self {
            Self::Text(text) => out.write_all(text.as_bytes())?,
            Self::Program(mut spool) => {
                spool.rewind()?;
                let mut block = vec![0; 1 << 16];
                loop {
                    match spool.read(&mut block)? {
                        0 => break,
                        n => out.write_all(&block[..n])?,
                    }
                }
            }
        }
        out.flush()
    }
}

impl Finished {
    fn text(stdout: String, stderr: String, code: u8) -> Self {
        Self { stdout: Stdout::Text(stdout), stderr, code }
    }
}

/// Something about arguments or files that ends the command: what, and what to do about it.
#[derive(Debug, Error)]
#[error("{message}\n  = hint: {hint}")]
struct Failure {
    message: String,
    hint: String,
}

/// An error of arguments or files.
fn failure(message: impl Into<String>, hint: impl Into<String>) -> anyhow::Error {
    Failure { message: message.into(), hint: hint.into() }.into()
}

/// Adds a line to what is said.
fn say(said: &mut String, line: std::fmt::Arguments<'_>) {
    // Writing into a `String` cannot fail.
    let _ = writeln!(said, "{line}");
}

/// Runs a command line, the name of the program first, to its end. What takes long is told on `console` meanwhile.
pub fn run(words: impl IntoIterator<Item = OsString>, console: &mut Console) -> Finished {
    let words: Vec<OsString> = words.into_iter().collect();
    let arguments = match Arguments::try_parse_from(&words) {
        Ok(arguments) => arguments,
        Err(misuse) if misuse.use_stderr() => return Finished::text(String::new(), misuse.render().to_string(), USAGE),
        // Help and version come this way too.
        Err(asked) => return Finished::text(asked.render().to_string(), String::new(), DONE),
    };
    let finished = match &arguments.command {
        Command::Compile(arguments) => compile::run(arguments, console),
        Command::Watch(arguments) => watch::run(arguments, &words[2..], console),
        Command::Verify(arguments) => verify::run(arguments, console),
        Command::Check(arguments) => check::run(arguments, console),
        Command::Info(arguments) => info::run(arguments, console),
        Command::Profile(arguments) => profile::run(arguments),
        Command::Explain(arguments) => explain::run(arguments),
        Command::Manual(arguments) => Ok(manual::run(arguments)),
        Command::Completions(arguments) => Ok(completions::run(arguments)),
        Command::Man(page) => completions::man(page),
    };
    finished.unwrap_or_else(|error| Finished::text(String::new(), format!("error: {error:#}\n"), USAGE))
}

#[cfg(test)]
mod tests {
    use clap::CommandFactory as _;

    use super::*;

    #[test]
    fn the_command_line_is_sound() {
        Arguments::command().debug_assert();
    }

    #[test]
    fn the_help_lists_every_target_and_says_where_the_keys_are() {
        let help = Arguments::command().render_long_help().to_string();
        for target in crate::back::TARGETS {
            assert!(help.contains(target.name) && help.contains(target.about), "{help}");
        }
        for dialect in crate::front::DIALECTS {
            assert!(help.contains(dialect.name) && help.contains(dialect.about), "{help}");
        }
        assert!(help.contains("cutc profile init") && help.contains("Examples"), "{help}");
    }

    #[test]
    fn a_program_is_copied_from_its_start() {
        let mut spool = SpooledTempFile::new(4);
        spool.write_all(b"t_s,x_mm\n0,1\n").expect("a spool takes bytes");
        let mut out = Vec::new();
        Stdout::Program(spool).copy_to(&mut out).expect("a vector takes bytes");
        assert_eq!(out, b"t_s,x_mm\n0,1\n");
    }
}
