//! Many files: which they are, work on them side by side, what is said of each, together and in order, and a table of all.

mod figures;
mod inputs;
mod manifest;
mod progress;
mod shard;
mod side_by_side;
mod table;

use std::num::NonZeroUsize;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::thread;

use clap::Args;

pub(super) use figures::{Cloth, Figures};
pub(super) use inputs::{Input, Inputs, find, find_programs, hint, is_cutter_file};
pub(super) use manifest::{Line, Made, Manifest, Output, Verdict};
pub(super) use shard::Shard;
pub(super) use table::{Columns, Row, State, counts, failed_last, sum, text};

use self::progress::Progress;
use super::{Console, DONE, FAULTY, Finished};
use crate::diagnostic::Diagnostics;

/// How many files are worked on.
#[derive(Debug, Clone, Copy, Args)]
pub(super) struct Threads {
    /// How many threads work; without it one for each core
    ///
    /// Small files are worked on side by side, a large one by all threads.
    #[arg(short, long, value_name = "N", help_heading = "Many files")]
    jobs: Option<NonZeroUsize>,
}

impl Threads {
    /// Their number; what is shared out inside a file keeps to it, too.
    pub(super) fn set(self) -> usize {
        if let Some(jobs) = self.jobs {
            // It fails when there are threads already, as in tests: then these serve.
            let _ = rayon::ThreadPoolBuilder::new().num_threads(jobs.get()).build_global();
        }
        self.jobs.or_else(|| thread::available_parallelism().ok()).map_or(1, NonZeroUsize::get)
    }
}

/// What became of one file.
#[derive(Debug)]
pub(super) struct Outcome {
    /// Its row; `None` when it is left to others.
    pub(super) row: Option<Row>,
    /// For standard error.
    pub(super) said: String,
    /// For standard output, where the figures are wanted as JSON: an object.
    pub(super) json: Option<String>,
}

impl Outcome {
    /// A file that cannot be read or written.
    pub(super) fn failed(input: &Input, error: &anyhow::Error) -> Self {
        let message = format!("{error:#}");
        let row = Row {
            worst: message.lines().next().unwrap_or_default().to_owned(),
            ..Row::new(&input.path, State::Failed)
        };
        Self { row: Some(row), said: format!("error: {message}\n"), json: None }
    }

    /// A file that is left to others.
    pub(super) fn elsewhere() -> Self {
        Self { row: None, said: String::new(), json: None }
    }
}

/// How a batch is told.
#[derive(Debug, Clone, Copy)]
pub(super) struct Telling {
    /// What its table has.
    pub(super) columns: Columns,
    /// Whether only what failed is told.
    pub(super) quiet: bool,
    /// Whether there is a list of JSON objects on standard output.
    pub(super) json: bool,
}

/// The code of the worst finding, for a row.
pub(super) fn worst(diagnostics: &Diagnostics) -> Option<&'static str> {
    diagnostics.tally().first().map(|(code, _)| code.name)
}

/// What is left to print of a batch.
#[derive(Debug)]
pub(super) struct Ended {
    /// Of all files, in their order.
    pub(super) rows: Vec<Row>,
    /// What closes the list of JSON objects.
    pub(super) closing: &'static str,
}

impl Ended {
    /// [`FAULTY`] when any file failed.
    pub(super) fn code(&self) -> u8 {
        if self.rows.iter().any(|row| row.state == State::Failed) { FAULTY } else { DONE }
    }
}

/// Works on every input and tells what comes of it, with a table on standard error. The exit code is [`FAULTY`] when any
/// failed.
pub(super) fn run(
    inputs: &[Input],
    threads: usize,
    (telling, console): (Telling, &mut Console),
    work: impl Fn(usize, &Input) -> Outcome + Sync,
) -> Finished {
    let ended = run_untold(inputs, threads, (telling, console), work);
    Finished::text(ended.closing.to_owned(), text(&ended.rows, telling), ended.code())
}

/// The same, but the table is left to others.
pub(super) fn run_untold(
    inputs: &[Input],
    threads: usize,
    (telling, console): (Telling, &mut Console),
    work: impl Fn(usize, &Input) -> Outcome + Sync,
) -> Ended {
    let sizes: Vec<u64> = inputs.iter().map(Input::size).collect();
    let progress = Progress::new(inputs.len(), telling.quiet);
    let (mut rows, mut objects) = (Vec::new(), 0);
    let work = |i: usize| {
        let input = &inputs[i];
        let outcome = catch_unwind(AssertUnwindSafe(|| work(i, input))).unwrap_or_else(|_| broken(input));
        let is_failed = outcome.row.as_ref().is_some_and(|row| row.state == State::Failed);
        progress.step(is_failed);
        outcome
    };
    side_by_side::run(&sizes, threads, work, |_, outcome| {
        let Outcome { row, said, json } = outcome;
        progress.aside(|| {
            // Who closed a stream does not want to read it.
            let _ = console.err.write_all(said.as_bytes());
            if let Some(json) = json {
                let before = if objects == 0 { "[\n" } else { ",\n" };
                let _ = write!(console.out, "{before}{}", indented(&json));
                objects += 1;
            }
        });
        rows.extend(row);
    });
    progress.end();
    let closing = match (telling.json, objects) {
        (false, _) => "",
        (true, 0) => "[]\n",
        (true, _) => "\n]\n",
    };
    Ended { rows, closing }
}

/// What is said of a file that the program itself broke down over: the others go on.
fn broken(input: &Input) -> Outcome {
    let message = "cutc broke down over this file: that is a fault of cutc, not of the file";
    Outcome::failed(input, &super::failure(format!("`{}`: {message}", input.path.display()), "send it to its makers"))
}

/// An object as one of a list is printed.
fn indented(json: &str) -> String {
    let lines: Vec<_> = json.lines().map(|line| format!("  {line}")).collect();
    lines.join("\n")
}
