//! Work on many files: their selection, parallel work, messages in order, and a table of all.

mod collisions;
mod figures;
mod found;
mod inputs;
mod manifest;
mod passed;
mod programs;
mod progress;
mod shard;
mod side_by_side;
mod table;

use std::num::NonZeroUsize;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::thread;

use clap::Args;

pub(super) use figures::{Cloth, Figures};
pub(super) use found::{Found, worst};
pub(super) use inputs::{Input, Inputs, extensions, files_in, find, find_programs, hint, is_cutter_file};
pub(super) use manifest::{Line, Made, Manifest, Standing, rounded};
pub(super) use passed::tell_passed_over;
pub(super) use programs::{Chosen, Programs, Work, kept, places};
pub(super) use shard::Shard;
pub(super) use side_by_side::{Stages, run as side_by_side};
pub(super) use table::{Columns, Row, State, Telling, counts, failed_last, sum, text};

use self::progress::Progress;
use self::table::BROKEN;
use super::finished::{Console, DONE, FAULTY, Finished};

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
    /// Sets and returns the number of threads; parallel work inside a file keeps to it, too.
    pub(super) fn set(self) -> usize {
        if let Some(jobs) = self.jobs {
            // It fails if there already are threads, as in tests: then these are used.
            let _ = rayon::ThreadPoolBuilder::new().num_threads(jobs.get()).build_global();
        }
        self.jobs.or_else(|| thread::available_parallelism().ok()).map_or(1, NonZeroUsize::get)
    }
}

/// Outcome of one file.
#[derive(Debug)]
pub(super) struct Outcome {
    /// Its row; `None` when it belongs to another part.
    pub(super) row: Option<Row>,
    /// Text for standard error.
    pub(super) said: String,
    /// JSON object for standard output, if JSON is requested.
    pub(super) json: Option<String>,
}

impl Outcome {
    /// Outcome of a file that cannot be read or written.
    pub(super) fn failed(input: &Input, error: &anyhow::Error) -> Self {
        let message = format!("{error:#}");
        let hint = message.lines().find_map(|line| line.trim_start().strip_prefix("= hint: ")).unwrap_or_default();
        let row = Row {
            worst: message.lines().next().unwrap_or_default().to_owned(),
            found: Found { errors: 1, hint: hint.to_owned(), ..Found::default() },
            ..Row::new(&input.path, State::Failed)
        };
        Self { row: Some(row), said: format!("error: {message}\n"), json: None }
    }

    /// Outcome of a file that caused a panic.
    fn broken(input: &Input, said: String) -> Self {
        Self { row: Some(Row::broken(&input.path)), said, json: None }
    }

    /// Outcome of a file that belongs to another part.
    pub(super) fn elsewhere() -> Self {
        Self { row: None, said: String::new(), json: None }
    }
}

/// Files to work on.
#[derive(Debug, Clone, Copy)]
pub(super) struct Batch<'b> {
    /// Inputs.
    pub(super) inputs: &'b [Input],
    /// Number of threads.
    pub(super) threads: usize,
    /// Form of the output.
    pub(super) telling: Telling,
}

/// Rest of the output of a batch.
#[derive(Debug)]
pub(super) struct Ended {
    /// Rows of all files, in order.
    pub(super) rows: Vec<Row>,
    /// End of the list of JSON objects.
    pub(super) closing: &'static str,
}

impl Ended {
    /// Exit code: [`FAULTY`] when any file failed.
    pub(super) fn code(&self) -> u8 {
        if self.rows.iter().any(|row| row.state == State::Failed) { FAULTY } else { DONE }
    }

    /// The end of the list on standard output, and the table on standard error.
    pub(super) fn finished(self, telling: Telling) -> Finished {
        Finished::text(self.closing.to_owned(), text(&self.rows, telling), self.code())
    }
}

impl Batch<'_> {
    /// Works on every input and prints the outcomes, without the table.
    pub(super) fn run(self, console: &mut Console, work: impl Fn(usize, &Input) -> Outcome + Sync) -> Ended {
        self.run_in_stages(console, Stages { work, settle: |_, outcome| outcome })
    }

    /// Works on every input in two stages, of which the second waits for a disk; see [`Batch::run`].
    pub(super) fn run_in_stages<D: Send>(
        self,
        console: &mut Console,
        stages: Stages<impl Fn(usize, &Input) -> D + Sync, impl Fn(usize, D) -> Outcome + Sync>,
    ) -> Ended {
        let Self { inputs, threads, telling } = self;
        let sizes: Vec<u64> = inputs.iter().map(Input::size).collect();
        let progress = Progress::new(inputs.len(), telling.quiet);
        let (mut rows, mut objects) = (Vec::new(), 0);
        let Stages { work, settle } = stages;
        let work = |i: usize| unless_broken(&inputs[i], || work(i, &inputs[i]));
        let settle = |i: usize, worked: Result<D, String>| {
            let settled = worked.and_then(|worked| unless_broken(&inputs[i], || settle(i, worked)));
            let outcome = settled.unwrap_or_else(|said| Outcome::broken(&inputs[i], said));
            progress.step(outcome.row.as_ref().is_some_and(|row| row.state == State::Failed));
            outcome
        };
        side_by_side(&sizes, threads, Stages { work, settle }, |_, outcome| {
            let Outcome { row, said, json } = outcome;
            progress.aside(|| {
                // Ignore errors on a stream: the reader has closed it.
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
}

/// Result of work on a file, or the message about a panic in it: the other files go on.
pub(super) fn unless_broken<T>(input: &Input, work: impl FnOnce() -> T) -> Result<T, String> {
    catch_unwind(AssertUnwindSafe(work)).map_err(|_| {
        let file = input.path.display();
        format!("error: `{file}`: {BROKEN}\n  = hint: send it to the makers of cutc, with what is said above\n")
    })
}

/// An object, indented as an item of a list.
fn indented(json: &str) -> String {
    let lines: Vec<_> = json.lines().map(|line| format!("  {line}")).collect();
    lines.join("\n")
}
