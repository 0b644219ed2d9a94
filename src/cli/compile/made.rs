//! Written programs: all programs of a file, with their provenance, or none at all.

use std::io;
use std::path::{Path, PathBuf};

use super::arguments::Making;
use crate::back::{Emit, Proof, Target};
use crate::cli::draft::{self, Draft, Whole};
use crate::cli::files;
use crate::cli::finished::say;
use crate::cli::options::remarks;
use crate::cli::provenance::{self, Cut, Made, Verified};
use crate::diagnostic::Diagnostics;
use crate::machine::Job;
use crate::machines;
use crate::pipeline::{Advance, Choices, Compiled, Medium, Product};
use crate::source::Source;

/// One compile, ready to run.
#[derive(Clone, Copy)]
pub(in crate::cli) struct Compile<'a> {
    pub(in crate::cli) making: &'a Making,
    pub(in crate::cli) targets: &'a [&'static Target],
    pub(in crate::cli) source: &'a Source,
    pub(in crate::cli) job: &'a Job,
    pub(in crate::cli) advance: &'a Advance,
}

/// Result of a compile.
pub(in crate::cli) struct Emitted {
    /// The programs; `None` when they were refused.
    pub(in crate::cli) compiled: Option<Compiled>,
    /// True for each target that is a picture of a refused program: only these are worth keeping then.
    pub(in crate::cli) pictures: Vec<bool>,
}

/// End of a compile to files.
pub(in crate::cli) struct Ended {
    /// The result, `None` when it was refused; or the error of writing.
    pub(in crate::cli) compiled: anyhow::Result<Option<Compiled>>,
    /// Diagnostics.
    pub(in crate::cli) diagnostics: Diagnostics,
    /// Paths of the programs, written or not.
    pub(in crate::cli) programs: Vec<PathBuf>,
    /// Messages about other actions: pictures of refused programs, older programs that were moved aside.
    pub(in crate::cli) beside: String,
}

impl Ended {
    /// End without a compile.
    pub(in crate::cli) fn failed(error: anyhow::Error) -> Self {
        let diagnostics = Diagnostics::default();
        Self { compiled: Err(error), diagnostics, programs: Vec::new(), beside: String::new() }
    }
}

/// Record of a write, which is made together with it or not at all.
type Record<'r> = &'r dyn Fn(Option<&Compiled>, &Diagnostics, Vec<Whole>) -> anyhow::Result<()>;

/// Complete programs that are not yet in their places.
pub(in crate::cli) struct Drafted {
    paths: Vec<PathBuf>,
    diagnostics: Diagnostics,
    /// The drafts, or the error of writing.
    written: anyhow::Result<Written>,
}

/// Drafts of a compile.
struct Written {
    emitted: Emitted,
    /// Programs that are worth keeping.
    programs: Vec<Draft>,
    /// Provenance of each.
    metas: Vec<Draft>,
}

impl Compile<'_> {
    /// Compiles to drafts of files, one for each target.
    pub(in crate::cli) fn draft(&self, paths: &[PathBuf]) -> Drafted {
        let mut diagnostics = Diagnostics::default();
        let written = self.write(paths, &mut diagnostics);
        Drafted { paths: paths.to_vec(), diagnostics, written }
    }

    /// Writes the programs and their provenance; for a refused program the pictures only.
    fn write(&self, paths: &[PathBuf], diagnostics: &mut Diagnostics) -> anyhow::Result<Written> {
        let mut programs = paths.iter().map(|path| Draft::new(path)).collect::<anyhow::Result<Vec<_>>>()?;
        let outs =
            programs.iter_mut().zip(paths).map(|(program, path)| (name(path), program.file() as &mut dyn Medium));
        let outs = outs.collect();
        let emitted = self.emit(outs, diagnostics).map_err(|error| files::cannot_write(&paths[0], &error))?;
        let is_kept = |shows_refusal: bool| shows_refusal || emitted.compiled.is_some();
        let (mut kept, mut metas) = (Vec::new(), Vec::new());
        for ((mut program, target), &shows_refusal) in programs.into_iter().zip(self.targets).zip(&emitted.pictures) {
            if is_kept(shows_refusal) {
                let path = files::meta(program.path());
                metas.push(self.meta(&path, program.file(), (target, emitted.compiled.as_ref()))?);
                kept.push(program);
            }
        }
        Ok(Written { emitted, programs: kept, metas })
    }

    /// Draft of the provenance of a target's program; without a compiled program it belongs to a picture of a refused one.
    pub(in crate::cli) fn meta(
        &self,
        path: &Path,
        program: &mut dyn Medium,
        (target, compiled): (&Target, Option<&Compiled>),
    ) -> anyhow::Result<Draft> {
        let verified = match compiled {
            None => Verified::Refused,
            Some(Compiled { verdict: None, .. }) => Verified::No,
            Some(Compiled { verdict: Some(_), .. }) => Verified::Yes,
        };
        let declared = compiled.map_or(&[][..], |compiled| &compiled.declared);
        let Self { source, job, .. } = *self;
        let is_moved = matches!(target.proof, Some(Proof::Setpoints | Proof::Positions));
        let cut = Some(Cut { declared: is_moved.then_some(declared) });
        let remarks = if matches!(target.emit, Emit::Page(_)) { remarks(job) } else { String::new() };
        let options = [job.typed(), remarks].join(" ");
        let made = Made { source, job, target: target.name, verified, cut, options: options.trim() };
        provenance::draft(path, program, &made)
    }

    /// Compiles into `outs`, one for each target with the name of its file, if any; [`Emitted`] tells which of them are usable.
    pub(in crate::cli) fn emit(
        &self,
        outs: Vec<(String, &mut dyn Medium)>,
        diagnostics: &mut Diagnostics,
    ) -> io::Result<Emitted> {
        let Making { reading, no_verify, .. } = self.making;
        let products = self.targets.iter().zip(outs);
        let mut products: Vec<Product> =
            products.map(|(target, (name, out))| Product::new(target, out).named(name)).collect();
        let choices = Choices { from: reading.from, verify: !no_verify, advance: self.advance };
        let compile = machines::tool_of(self.job).compile;
        let compiled = compile(self.source, self.job, choices, &mut products, diagnostics)?;
        Ok(Emitted { compiled, pictures: products.iter().map(|product| product.shows_refusal).collect() })
    }
}

impl Drafted {
    /// Moves everything to its place, or nothing. `record` receives the written or refused programs.
    pub(in crate::cli) fn publish(self, record: Option<Record>) -> Ended {
        let Self { paths, diagnostics, written } = self;
        let published = written.and_then(|Written { emitted, mut programs, metas }| {
            // Digests are needed for a record only.
            let recorded = if record.is_some() { &mut programs[..] } else { &mut [] };
            let whole = recorded.iter_mut().map(Whole::of).collect::<anyhow::Result<_>>()?;
            // Nothing takes its place before everything is complete.
            draft::publish(metas.into_iter().chain(programs).collect(), || match record {
                Some(record) => record(emitted.compiled.as_ref(), &diagnostics, whole),
                None => Ok(()),
            })?;
            Ok(emitted)
        });
        let Emitted { compiled, pictures } = match published {
            Ok(emitted) => emitted,
            Err(error) => {
                let beside = move_aside(&paths);
                return Ended { compiled: Err(error), diagnostics, programs: paths, beside };
            }
        };
        let (shown, programs): (Vec<_>, Vec<_>) = paths.into_iter().zip(&pictures).partition(|(_, shows)| **shows);
        let programs: Vec<PathBuf> = programs.into_iter().map(|(path, _)| path).collect();
        let mut beside = if compiled.is_some() { String::new() } else { move_aside(&programs) };
        for (path, _) in shown {
            say(&mut beside, format_args!("wrote `{}`, a picture of what was refused", path.display()));
        }
        Ended { compiled: Ok(compiled), diagnostics, programs, beside }
    }
}

/// Name of a file without its directory.
fn name(path: &Path) -> String {
    path.file_name().map_or_else(String::new, |name| name.to_string_lossy().into_owned())
}

/// Moves older programs aside, and returns a message.
fn move_aside(paths: &[PathBuf]) -> String {
    paths.iter().map(|path| files::move_aside(path)).collect()
}
