//! `cutc profile`: prints, creates, describes or checks a machine profile.

mod ask;
mod questions;

use std::path::PathBuf;

use clap::{Args, Subcommand};

use super::draft::write_new;
use super::files;
use super::finished::{Console, DONE, Finished, Run};
use super::options::{self, Machine, no_profile, refuse};
use super::report::pretty;
use crate::machine::{Comments, Extent, MachineProfile, SHIPPED, Shipped, load, schema};

/// Comment above the keys of a new profile.
const HEAD: &str = "\
# Machine profile of cutc. Every key is here with its default: change what differs on your machine and
# delete the rest. `cutc profile check FILE` says what is wrong, `cutc profile show -p FILE` what holds.
# A number may be a text with a unit of your own: \"45 m/min\", \"0.25 in\", \"2 rev/s\", \"50 ms\".

";

/// Arguments of `cutc profile`.
#[derive(Debug, Args)]
pub(super) struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Print the values in effect: the defaults, the profile and `--set` together
    Show {
        #[command(flatten)]
        machine: Machine,
    },
    /// Print the profiles that ship with the program, a controller a line: `-p NAME` takes one
    List,
    /// Print a profile with every key, its meaning, range and default: a beginning for your machine
    Init {
        /// Print what a machine with the controller of a shipped profile needs, with the values of that
        #[arg(long = "for", value_name = "NAME")]
        controller: Option<String>,

        /// With `--for`: print every other key, too
        #[arg(long, requires = "controller")]
        all: bool,

        /// Ask twelve questions about the machine, then write its profile, the drawing of a trial and the
        /// trial's program
        ///
        /// The files have the name of `-o`; without it they are `machine.toml`, `machine-trial.cut` and
        /// `machine-trial.ngc` with its `.meta.json`.
        /// `cutc manual trial` says how to read what the trial cuts.
        #[arg(long, conflicts_with_all = ["controller", "all"])]
        ask: bool,

        /// File to write, instead of standard output (`-`); never overwritten
        #[arg(short, long, value_name = "PROFILE.toml")]
        out: Option<PathBuf>,
    },
    /// Print a JSON Schema, by which editors complete and check a profile that begins with the line
    /// `#:schema ./cutc.schema.json`
    Schema,
    /// Say everything that is wrong with profiles
    Check {
        /// Profiles to check: files, or names of profiles that ship
        #[arg(required = true, value_name = "PROFILE.toml")]
        files: Vec<PathBuf>,
    },
}

pub(super) fn run(arguments: &Arguments, console: &mut Console, cutc: Run) -> anyhow::Result<Finished> {
    match &arguments.command {
        Command::Show { machine } => Ok(match machine.job()? {
            Ok(job) => Finished::text(job.profile.effective().to_toml(Comments::Plain), String::new(), DONE),
            Err(refused) => refused,
        }),
        Command::Schema => Ok(Finished::text(pretty(&schema()), String::new(), DONE)),
        Command::List => Ok(Finished::text(list(), String::new(), DONE)),
        Command::Init { ask: true, out, .. } => ask::run(out.as_ref(), &mut std::io::stdin().lock(), console, cutc),
        Command::Init { controller, all, out, .. } => init(beginning(controller.as_deref(), *all)?, out.as_ref()),
        Command::Check { files } => Ok(check(files)),
    }
}

/// Names of the shipped profiles with their controllers.
fn list() -> String {
    let width = SHIPPED.iter().map(|shipped| shipped.name.len()).max().unwrap_or_default();
    let lines = SHIPPED.iter().map(|shipped| format!("{:width$}  {}", shipped.name, shipped.about));
    lines.collect::<Vec<_>>().join("\n") + "\n"
}

/// Profile to begin with: the defaults, or those of a controller.
fn beginning(controller: Option<&str>, all: bool) -> anyhow::Result<String> {
    let Some(name) = controller else {
        return Ok(format!("{HEAD}{}", MachineProfile::default().to_toml(Comments::Explained)));
    };
    let shipped = Shipped::find(name).ok_or_else(|| no_profile(name))?;
    Ok(shipped.beginning(if all { Extent::All } else { Extent::Needed }))
}

fn init(text: String, out: Option<&PathBuf>) -> anyhow::Result<Finished> {
    let Some(path) = out.filter(|out| !files::is_dash(out)) else {
        return Ok(Finished::text(text, String::new(), DONE));
    };
    write_new(path, &text)?;
    Ok(Finished::text(String::new(), format!("wrote `{}`\n", path.display()), DONE))
}

fn check(paths: &[PathBuf]) -> Finished {
    let mut finished = Finished::text(String::new(), String::new(), DONE);
    for path in paths {
        let (said, code) = match if files::is_dash(path) { files::read(path) } else { options::profile(path) } {
            Err(error) => (format!("error: {error:#}\n"), super::USAGE),
            Ok(file) => match load(Some(&file), &[]) {
                Ok(_) => (format!("{}: no errors\n", file.name()), DONE),
                Err(faults) => {
                    let refused = refuse(&faults, Some(&file));
                    (refused.stderr, refused.code)
                }
            },
        };
        finished.stderr.push_str(&said);
        finished.code = finished.code.max(code);
    }
    finished
}
