//! Many files, each with its place below one folder.

use std::path::{Path, PathBuf};

use super::arguments::Arguments;
use super::sewn::{Sewing, typed};
use crate::cli::batch::{
    self, Columns, Input, Line, Made, Manifest, Outcome, Programs, Row, Standing, State, Telling, Work, rounded,
};
use crate::cli::choices::Format;
use crate::cli::destination::{Place, not_of_another, targets_of_many};
use crate::cli::draft::Whole;
use crate::cli::finished::{Console, Finished};
use crate::diagnostic::Diagnostics;
use crate::sew::{Estimate, TARGETS};
use crate::source::Source;

pub(super) fn run(arguments: &Arguments, inputs: &[Input], console: &mut Console) -> anyhow::Result<Finished> {
    let threads = arguments.threads.set();
    let out = arguments.out.as_deref().unwrap_or(Path::new(""));
    let targets = targets_of_many(out, TARGETS, &arguments.targets)?;
    let job = match arguments.machine.job()? {
        Ok(job) => arguments.of(job),
        Err(refused) => return Ok(refused),
    };
    let places = &batch::places(out, &targets, inputs)?[..];
    let json = arguments.format == Format::Json;
    let telling = Telling { columns: Columns::Sewn, quiet: arguments.messages.quiet, json };
    let sewing = Sewing { arguments, targets: &targets, job: &job };
    let work = Work {
        made: |input: &Input, source: &Source| sewing.ingredients(input, source),
        draft: |manifest: &Manifest, input: &Input, source: Source, (made, paths): (Made, &[PathBuf])| {
            let outcome = sewing.outcome(input, &source, &made, (manifest, paths));
            outcome.unwrap_or_else(|error| Outcome::failed(input, &error))
        },
        settle: |_: &Manifest, _: &Input, outcome: Outcome| outcome,
    };
    Programs { inputs, out, places, chosen: arguments.chosen, threads, telling }.make(console, work, |_| None)
}

impl Sewing<'_> {
    /// Ingredients of the programs of an input.
    fn ingredients(&self, input: &Input, source: &Source) -> Made {
        let Self { arguments, targets, job } = *self;
        let mut options = vec![typed(&arguments.asked()), job.typed()];
        options.extend(arguments.no_verify.then(|| "--no-verify".to_owned()));
        Made::of((input, source), targets.iter().map(|target| target.name), &job.profile, options)
    }

    /// Sews one of many files, with its line in the manifest.
    fn outcome(
        &self,
        input: &Input,
        source: &Source,
        made: &Made,
        (manifest, paths): (&Manifest, &[PathBuf]),
    ) -> anyhow::Result<Outcome> {
        if !self.arguments.force {
            paths.iter().try_for_each(|path| not_of_another(path, &input.path))?;
        }
        let record = |estimate: Option<&Estimate>, out: &Diagnostics, whole: Vec<Whole>| {
            let standing = match estimate {
                None => Standing::Refused,
                Some(_) if self.arguments.no_verify => Standing::Unverified,
                Some(_) => Standing::Verified,
            };
            let time_s = estimate.map(|estimate| rounded(estimate.time_s));
            manifest.add(Line { time_s, ..manifest.line(made.clone(), standing, whole, out) })
        };
        let sewn = self.sew(source, &Place::Files(paths.to_vec()), Some(&record))?;
        let estimate = sewn.made.as_ref().map(|made| &made.estimate);
        let row = Row {
            stitches: estimate.map(|sum| sum.stitches),
            thread_m: estimate.map(|sum| sum.thread_m),
            time_s: estimate.map(|sum| sum.time_s),
            worst: batch::worst(&sewn.diagnostics).unwrap_or_default().to_owned(),
            ..Row::new(&input.path, if estimate.is_some() { State::Done } else { State::Failed })
        };
        let json = (self.arguments.format == Format::Json).then(|| sewn.json(source, self.job));
        Ok(Outcome { row: Some(row), said: sewn.said, json })
    }
}
