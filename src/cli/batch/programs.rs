//! Programs of many files below one folder, with a line for each in the manifest of that folder.

use std::path::{Path, PathBuf};

use clap::Args;

use super::collisions::refuse_collisions;
use super::manifest::{Line, Made, Manifest, Standing};
use super::side_by_side::Stages;
use super::table::{Row, State, Telling};
use super::{Batch, Ended, Input, Outcome, Shard};
use crate::cli::destination::below;
use crate::cli::draft::{self, MadeFolders};
use crate::cli::files;
use crate::cli::finished::{Console, Finished, USAGE, say};
use crate::ir::Target;
use crate::source::Source;

/// Choice of the files that are worked on.
#[derive(Debug, Clone, Copy, Args)]
pub(in crate::cli) struct Chosen {
    /// Work only on what was changed: what `cutc.jsonl` beside the programs does not have, or not of these bytes, options
    /// and version, or what no longer stands there as it was written
    #[arg(long, help_heading = "Many files")]
    pub(in crate::cli) changed: bool,

    /// Work on one part of the files, as in `--shard 3/16`, on one of several machines
    ///
    /// Which part a file belongs to is told by its content. Its manifest is `cutc.3-of-16.jsonl`; the next run with
    /// --changed and without --shard joins those of all parts.
    #[arg(long, value_name = "PART/PARTS", value_parser = Shard::parse, help_heading = "Many files")]
    pub(in crate::cli) shard: Option<Shard>,
}

impl Chosen {
    /// True if a manifest is requested even for a single file.
    pub(in crate::cli) fn is_of_many(self) -> bool {
        self.changed || self.shard.is_some()
    }
}

/// Files whose programs go below a folder.
pub(in crate::cli) struct Programs<'a> {
    pub(in crate::cli) inputs: &'a [Input],
    /// The folder.
    pub(in crate::cli) out: &'a Path,
    /// Places of the programs of each.
    pub(in crate::cli) places: &'a [Vec<PathBuf>],
    pub(in crate::cli) chosen: Chosen,
    pub(in crate::cli) threads: usize,
    pub(in crate::cli) telling: Telling,
}

/// Places of the programs of inputs below a folder, in the structure that they were found in.
///
/// # Errors
///
/// Two programs would have one place.
pub(in crate::cli) fn places<E, P>(
    out: &Path,
    targets: &[&'static Target<E, P>],
    inputs: &[Input],
) -> anyhow::Result<Vec<Vec<PathBuf>>> {
    let extensions: Vec<&str> = targets.iter().map(|target| target.extension).collect();
    let places: Vec<Vec<PathBuf>> = inputs.iter().map(|input| below(out, &input.name, &extensions)).collect();
    refuse_collisions(inputs, &places)?;
    Ok(places)
}

/// Stages of the work on a file.
pub(in crate::cli) struct Work<M, D, S> {
    /// Ingredients of its programs.
    pub(in crate::cli) made: M,
    /// Makes its programs as drafts, in parallel with other files.
    pub(in crate::cli) draft: D,
    /// Moves them to their places.
    pub(in crate::cli) settle: S,
}

/// State of one of many files between the stages.
enum Step<T> {
    /// Nothing more to do.
    Over(Box<Outcome>),
    /// Worked on, but not yet in its places.
    Drafted(Box<T>),
}

impl Programs<'_> {
    /// Makes the programs of all files. `seen` receives their rows and writes the overview of all, whose path is reported.
    pub(in crate::cli) fn make<T: Send>(
        self,
        console: &mut Console,
        work: Work<
            impl Fn(&Input, &Source) -> Made + Sync,
            impl Fn(&Manifest, &Input, Source, (Made, &[PathBuf])) -> T + Sync,
            impl Fn(&Manifest, &Input, T) -> Outcome + Sync,
        >,
        seen: impl FnOnce(&Ended) -> Option<anyhow::Result<String>>,
    ) -> anyhow::Result<Finished> {
        let Self { inputs, out, places, chosen: Chosen { changed, shard }, threads, telling } = self;
        let manifest_at = Manifest::place(out, shard);
        let mut folder = MadeFolders::of([manifest_at.as_path()])?;
        // After another run, which may have removed folders that it left empty.
        let manifest = Manifest::open(out, shard, console)?;
        draft::sweep_folders(places.iter().flatten().map(PathBuf::as_path));
        let mut folders = MadeFolders::of(places.iter().flatten().map(PathBuf::as_path))?;
        if shard.is_some() {
            // Another part may be about to write to folders that this one does not need.
            folder.keep();
            folders.keep();
        }
        let Work { made, draft, settle } = work;
        let work = |i: usize, input: &Input| {
            let source = match files::read(&input.path) {
                Ok(source) => source,
                Err(error) => return Step::Over(Box::new(Outcome::failed(input, &error))),
            };
            let made = made(input, &source);
            if shard.is_some_and(|shard| !shard.has(&made.source_sha256)) {
                return Step::Over(Box::new(Outcome::elsewhere()));
            }
            match manifest.standing(&made).filter(|_| changed) {
                Some(line) => Step::Over(Box::new(unchanged(&manifest, input, line))),
                None => Step::Drafted(Box::new(draft(&manifest, input, source, (made, &places[i])))),
            }
        };
        let settle = |i: usize, step: Step<T>| match step {
            Step::Over(outcome) => *outcome,
            Step::Drafted(drafted) => settle(&manifest, &inputs[i], *drafted),
        };
        let ended = Batch { inputs, threads, telling }.run_in_stages(console, Stages { work, settle });
        let seen = seen(&ended);
        let mut finished = ended.finished(telling);
        let path = manifest.path().display().to_string();
        for written in seen.into_iter().chain([manifest.finish().map(|()| path)]) {
            tell(written, telling.quiet, &mut finished);
        }
        Ok(finished)
    }
}

/// Outcome of a file whose programs are up to date.
fn unchanged(manifest: &Manifest, input: &Input, line: Line) -> Outcome {
    Outcome { row: Some(kept(manifest, input, line)), said: String::new(), json: None }
}

/// Row of a file with nothing to do, whose line the manifest keeps.
pub(in crate::cli) fn kept(manifest: &Manifest, input: &Input, line: Line) -> Row {
    let state = if line.verdict == Standing::Refused { State::Failed } else { State::Unchanged };
    let row = Row {
        pieces: line.pieces,
        cut_m: line.cut_m,
        time_s: line.time_s,
        worst: line.worst.clone().unwrap_or_default(),
        found: line.found.clone(),
        verdict: Some(line.verdict),
        ..Row::new(&input.path, state)
    };
    manifest.keep(line);
    row
}

/// Reports the path of the overview, or why it could not be written.
fn tell(written: anyhow::Result<String>, quiet: bool, finished: &mut Finished) {
    match written {
        Ok(path) if !quiet => say(&mut finished.stderr, format_args!("wrote `{path}`")),
        Ok(_) => {}
        Err(error) => {
            say(&mut finished.stderr, format_args!("error: {error:#}"));
            finished.code = USAGE;
        }
    }
}
