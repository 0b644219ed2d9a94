//! Verification of many programs, each against its own source or all against one.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use super::arguments::Arguments;
use super::one::{Judged, Program};
use crate::cli::batch::{self, Batch, Columns, Input, Inputs, Outcome, Row, State, Telling};
use crate::cli::choices::Format;
use crate::cli::finished::{Console, Finished, Stdout, failure, say};
use crate::cli::options::counted;
use crate::cli::{files, provenance, verdict};
use crate::machine::Job;
use crate::pipeline::{Explained, Verdict};
use crate::source::Source;

/// Maximum number of broken rules to name in a row; the rest are counted.
const MOST_RULES: usize = 3;

/// Sources of the programs.
enum Sources<'a> {
    /// One file for all programs.
    File(Source),
    /// A file in a folder for each program.
    Folder(SourceFolder<'a>),
}

/// A folder of cutter files.
struct SourceFolder<'a> {
    folder: &'a Path,
    /// Cutter files in the folder.
    files: Vec<Input>,
}

impl SourceFolder<'_> {
    fn of(folder: &Path) -> SourceFolder<'_> {
        let files = match batch::find(&[folder.to_owned()], batch::is_cutter_file, "") {
            Ok(Inputs::Many(files)) => files,
            // A folder without cutter files is no error here: each program reports its missing source.
            Ok(Inputs::One(_)) | Err(_) => Vec::new(),
        };
        SourceFolder { folder, files }
    }

    /// The cutter files from which no program was made.
    fn without_program(&self, programs: &[Input]) -> Vec<Input> {
        let is_of = |path: PathBuf| path.canonicalize().unwrap_or(path);
        let made: BTreeSet<PathBuf> =
            programs.iter().filter_map(|program| source_in(self.folder, program).ok()).map(is_of).collect();
        self.files.iter().filter(|file| !made.contains(&is_of(file.path.clone()))).cloned().collect()
    }

    /// Refuses a program that was made from one file but has the name of the program of another.
    fn refuse_exchanged(&self, program: &Input, source: &Path) -> anyhow::Result<()> {
        if files::is_plan(&program.path) {
            return Ok(());
        }
        let is_named_after = |file: &Path| file.file_stem() == program.path.file_stem();
        let same_place = |file: &&Input| file.path.parent() == source.parent();
        let other = self.files.iter().filter(same_place).find(|file| is_named_after(&file.path));
        match other.filter(|_| !is_named_after(source)) {
            None => Ok(()),
            Some(other) => Err(failure(
                format!(
                    "`{}` was made from `{}`, and has the name of the program of `{}`",
                    program.path.display(),
                    source.display(),
                    other.path.display()
                ),
                "have two programs changed places? give each its name, or compile the folder anew",
            )),
        }
    }
}

/// A source: borrowed if all programs share it, otherwise owned.
enum Shared<'a> {
    All(&'a Source),
    Own(Source),
}

impl Shared<'_> {
    fn get(&self) -> &Source {
        match self {
            Self::All(source) => source,
            Self::Own(source) => source,
        }
    }
}

impl Sources<'_> {
    fn of(&self, input: &Input) -> anyhow::Result<Shared<'_>> {
        match self {
            Self::File(source) => Ok(Shared::All(source)),
            Self::Folder(sources) => {
                let path = source_in(sources.folder, input)?;
                sources.refuse_exchanged(input, &path)?;
                if !path.exists() {
                    return Err(failure(
                        format!("there is no `{}`, which `{}` was made from", path.display(), input.path.display()),
                        "name the folder that was compiled with --source, and the folder of all its programs, or a quoted \
                         pattern: below these the folders are the same",
                    ));
                }
                files::read(&path).map(Shared::Own)
            }
        }
    }
}

pub(super) fn run(
    arguments: &Arguments,
    programs: &[Input],
    threads: usize,
    console: &mut Console,
) -> anyhow::Result<Finished> {
    let Arguments { source, messages, format, .. } = arguments;
    let sources =
        if source.is_dir() { Sources::Folder(SourceFolder::of(source)) } else { Sources::File(files::read(source)?) };
    let job = match arguments.job()? {
        Ok(job) => job,
        Err(refused) => return Ok(refused),
    };
    let is_json = *format == Format::Json;
    let telling = Telling { columns: Columns::Judged, quiet: messages.quiet, json: is_json };
    // With a folder all its programs are given, so a source without one is an error. A pattern may select some programs.
    let missing = match &sources {
        Sources::Folder(sources) if arguments.programs.iter().any(|named| named.is_dir()) => {
            sources.without_program(programs)
        }
        Sources::Folder(_) | Sources::File(_) => Vec::new(),
    };
    let inputs = [programs, &missing].concat();
    let work = |place: usize, input: &Input| {
        let failed = |error: anyhow::Error| {
            let json = is_json.then(|| verdict::json_of(&input.path, None));
            Outcome { json, ..Outcome::failed(input, &error) }
        };
        if place >= programs.len() {
            return failed(failure(
                format!("no program was made from `{}`", input.path.display()),
                "compile it; or name the programs that are judged by a pattern, as in `'out/*.csv'`",
            ));
        }
        arguments.outcome(input, &sources, &job).unwrap_or_else(failed)
    };
    let mut finished = Batch { inputs: &inputs, threads, telling }.run(console, work).finished(telling);
    if !is_json {
        // The verdicts are the requested output.
        finished.stdout = Stdout::Text(std::mem::take(&mut finished.stderr));
    }
    Ok(finished)
}

/// Path of the source of a program in a folder. It has the same place below the folder as the program below its own, and the
/// name from the provenance of the program.
pub(super) fn source_in(folder: &Path, program: &Input) -> anyhow::Result<PathBuf> {
    if !program.path.exists() {
        return Err(failure(
            format!("cannot read `{}`: there is no such file or folder", program.path.display()),
            "name programs that were compiled to files, or the folder that they are in",
        ));
    }
    let name = provenance::source_of(&program.path);
    // A name must not lead to another folder.
    let name = name.as_deref().map(Path::new).and_then(Path::file_name).ok_or_else(|| {
        failure(
            format!(
                "`{}` does not say what it was made from: there is no `{}`, or it names no source",
                program.path.display(),
                files::meta(&program.path).display()
            ),
            "name its cutter file, as in `--source marker.cut`, not a folder; or compile it anew",
        )
    })?;
    Ok(folder.join(program.name.parent().unwrap_or(Path::new(""))).join(name))
}

impl Arguments {
    /// The outcome of one of many programs.
    fn outcome(&self, input: &Input, sources: &Sources, job: &Job) -> anyhow::Result<Outcome> {
        let mut program = Program::open(&input.path, job)??;
        let source = sources.of(input)?;
        let Judged { verdict, mut said } = self.judge(&mut program, source.get(), job)?;
        let (state, worst) = match &verdict {
            Some(Explained { verdict, .. }) if verdict.passes() => (State::Done, "PASS".to_owned()),
            Some(Explained { verdict, .. }) => {
                let (name, source) = (input.path.display(), source.get().name());
                let rules = counted(verdict.broken().count(), "rule");
                say(
                    &mut said,
                    format_args!("{name}: breaks {rules}; `cutc verify {name} --source {source}` says more"),
                );
                (State::Failed, broken(verdict))
            }
            None => (State::Failed, "not judged: its cutter file has errors".to_owned()),
        };
        let row = Row { worst, ..Row::new(&input.path, state) };
        let json = (self.format == Format::Json).then(|| verdict::json_of(&input.path, verdict.as_ref()));
        Ok(Outcome { row: Some(row), said, json })
    }
}

/// The names of the first broken rules.
fn broken(verdict: &Verdict) -> String {
    let mut rules: Vec<String> = verdict.broken().map(|finding| finding.rule.name.to_owned()).collect();
    let more = rules.len().saturating_sub(MOST_RULES);
    rules.truncate(MOST_RULES);
    let more = if more > 0 { format!(" and {more} more") } else { String::new() };
    rules.join(", ") + &more
}
