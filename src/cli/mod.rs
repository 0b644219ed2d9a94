//! Command line: translation of the arguments to jobs, with one file per subcommand.
//!
//! Receives parsed arguments, reads and writes files, and returns the output: only `main.rs` prints and exits. Help texts, flag
//! values and names come from the tables of the stages.

mod batch;
mod bites;
mod check;
mod choices;
mod compile;
mod completions;
mod destination;
mod draft;
mod drawn;
mod edges;
mod explain;
mod facts;
mod files;
mod finished;
mod flow;
mod help;
mod info;
mod labels;
mod made;
mod manual;
mod options;
mod price;
mod profile;
mod provenance;
mod report;
mod setup;
mod sew;
mod stop;
mod summary;
mod times;
mod track;
mod verdict;
mod verify;
mod watch;

pub use finished::{Console, DONE, FAULTY, Finished, Stdout, USAGE};
pub use stop::{STOPPED, stop};

use std::ffi::OsString;

use clap::{CommandFactory as _, Parser, Subcommand};

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
    /// Sew patterns and stitch files: to queues, feed pulses and stitch files
    Sew(sew::Arguments),
    /// Keep a carriage over the centre of a moving cloth: replay logs of its rulers, or simulate it
    Track(track::Arguments),
    /// Cut a marker on a conveyor that moves: to programs of several heads
    Flow(flow::Arguments),
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

/// Runs a command line that begins with the name of the program. Long commands report on `console` while they run.
pub fn run(words: &[OsString], console: &mut Console) -> Finished {
    let arguments = match Arguments::try_parse_from(words) {
        Ok(arguments) => arguments,
        Err(misuse) if misuse.use_stderr() => return Finished::text(String::new(), misuse.render().to_string(), USAGE),
        // Requests for help and for the version arrive here, too.
        Err(asked) => return Finished::text(asked.render().to_string(), String::new(), DONE),
    };
    let finished = match &arguments.command {
        Command::Compile(arguments) => compile::run(arguments, console),
        Command::Watch(arguments) => watch::run(arguments, &words[2..], console),
        Command::Sew(arguments) => sew::run(arguments, console),
        Command::Track(arguments) => track::run(arguments),
        Command::Flow(arguments) => flow::run(arguments),
        Command::Verify(arguments) => verify::run(arguments, console),
        Command::Check(arguments) => check::run(arguments, console),
        Command::Info(arguments) => info::run(arguments, console),
        Command::Profile(arguments) => profile::run(arguments, console, run),
        Command::Explain(arguments) => explain::run(arguments),
        Command::Manual(arguments) => Ok(manual::run(arguments)),
        Command::Completions(arguments) => Ok(completions::run(arguments, Arguments::command())),
        Command::Man(page) => completions::man(page, Arguments::command()),
    };
    finished.unwrap_or_else(|error| Finished::text(String::new(), format!("error: {error:#}\n"), USAGE))
}

#[cfg(test)]
mod tests {
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
}
