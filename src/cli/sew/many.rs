//! Many files, each to its place below one folder.

use std::path::{Path, PathBuf};

use super::arguments::Arguments;
use super::sewn::Sewing;
use crate::cli::batch::{self, Batch, Columns, Input, Outcome, Row, State, Telling, refuse_collisions};
use crate::cli::choices::Format;
use crate::cli::destination::{Place, below, not_of_another, targets_of_many};
use crate::cli::draft::{self, MadeFolders};
use crate::cli::files;
use crate::cli::finished::{Console, Finished};
use crate::sew::TARGETS;

pub(super) fn run(arguments: &Arguments, inputs: &[Input], console: &mut Console) -> anyhow::Result<Finished> {
    let threads = arguments.threads.set();
    let out = arguments.out.as_deref().unwrap_or(Path::new(""));
    let targets = targets_of_many(out, TARGETS, &arguments.targets)?;
    let job = match arguments.machine.job()? {
        Ok(job) => arguments.of(job),
        Err(refused) => return Ok(refused),
    };
    let extensions: Vec<&str> = targets.iter().map(|target| target.extension).collect();
    let places: Vec<Vec<PathBuf>> = inputs.iter().map(|input| below(out, &input.name, &extensions)).collect();
    refuse_collisions(inputs, &places)?;
    draft::sweep_folders(places.iter().flatten().map(PathBuf::as_path));
    let _made = MadeFolders::of(places.iter().flatten().map(PathBuf::as_path))?;
    let json = arguments.format == Format::Json;
    let telling = Telling { columns: Columns::Sewn, quiet: arguments.messages.quiet, json };
    let sewing = Sewing { arguments, targets: &targets, job: &job };
    let work = |i: usize, input: &Input| {
        sewing.outcome(input, &places[i]).unwrap_or_else(|error| Outcome::failed(input, &error))
    };
    Ok(Batch { inputs, threads, telling }.run(console, work).finished(telling))
}

impl Sewing<'_> {
    /// What becomes of one of many files.
    fn outcome(&self, input: &Input, paths: &[PathBuf]) -> anyhow::Result<Outcome> {
        if !self.arguments.force {
            paths.iter().try_for_each(|path| not_of_another(path, &input.path))?;
        }
        let source = files::read(&input.path)?;
        let sewn = self.sew(&source, &Place::Files(paths.to_vec()))?;
        let estimate = sewn.made.as_ref().map(|made| &made.estimate);
        let row = Row {
            stitches: estimate.map(|sum| sum.stitches),
            thread_m: estimate.map(|sum| sum.thread_m),
            time_s: estimate.map(|sum| sum.time_s),
            worst: batch::worst(&sewn.diagnostics).unwrap_or_default().to_owned(),
            ..Row::new(&input.path, if estimate.is_some() { State::Done } else { State::Failed })
        };
        let json = (self.arguments.format == Format::Json).then(|| sewn.json(&source, self.job));
        Ok(Outcome { row: Some(row), said: sewn.said, json })
    }
}
