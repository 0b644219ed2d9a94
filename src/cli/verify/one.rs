//! Verification of one program, with its whole verdict.

use std::fs::File;
use std::io::{self, BufRead, BufReader};
use std::path::Path;

use super::arguments::Arguments;
use crate::cli::choices::Format;
use crate::cli::finished::{DONE, FAULTY, Finished, failure, say};
use crate::cli::made::BLOCK_BYTES;
use crate::cli::options::counted;
use crate::cli::verdict::{self, Judgement};
use crate::cli::{files, provenance, sew};
use crate::diagnostic::{Diagnostics, Severity, render_with};
use crate::machine::Job;
use crate::machine::patterns::Patterns;
use crate::machines::{self, Claim, Machine, Written};
use crate::pipeline::{self, Declared, Explained, rules};
use crate::source::Source;

/// A program that can be judged.
pub(super) struct Program<'a> {
    path: &'a Path,
    file: File,
    /// Name of its file, in lower case.
    name: String,
    /// Target in its provenance.
    target: Option<String>,
}

/// Result for a program.
pub(super) struct Judged {
    /// The verdict; `None` when its source has errors.
    pub(super) verdict: Option<Explained>,
    /// Messages about the source, and about doubts whether the program was made from it.
    pub(super) said: String,
}

pub(super) fn run(arguments: &Arguments, program: &Path, source: &Path) -> anyhow::Result<Finished> {
    let job = match arguments.job()? {
        Ok(job) => job,
        Err(refused) => return Ok(refused),
    };
    let mut program = match Program::open(program, &job)? {
        Ok(program) => program,
        Err(foreign) => {
            let stdout = match arguments.format {
                Format::Json => verdict::json(None),
                Format::Text => String::new(),
            };
            return Ok(Finished::text(stdout, format!("error: {foreign}\n"), FAULTY));
        }
    };
    let source = files::read(source)?;
    let Judged { verdict, said } = arguments.judge(&mut program, &source, &job)?;
    let stdout = match (arguments.format, &verdict) {
        (Format::Json, verdict) => verdict::json(verdict.as_ref()),
        (Format::Text, Some(explained)) => {
            let (works, program) = (program.machine(&job).works, program.path.display().to_string());
            verdict::text(&Judgement { explained, mode: job.mode, works, program: &program, source: source.name() })
        }
        (Format::Text, None) => String::new(),
    };
    let code = if verdict.is_some_and(|explained| explained.verdict.passes()) { DONE } else { FAULTY };
    Ok(Finished::text(stdout, said, code))
}

impl<'a> Program<'a> {
    /// Opens a file; the inner error is that of a file that is no program for a job.
    pub(super) fn open(path: &'a Path, job: &Job) -> anyhow::Result<Result<Self, anyhow::Error>> {
        let name = path.file_name().unwrap_or_default().to_string_lossy().to_ascii_lowercase();
        let target = provenance::target_of(path);
        let mut program = Self { path, file: files::open(path)?, name, target };
        let foreign = match machines::claimant(program.claim()) {
            Some(_) => None,
            None => pipeline::foreign(&mut program.file, job).map_err(|error| cannot_read(path, &error))?,
        };
        let Some([what, hint]) = foreign else { return Ok(Ok(program)) };
        let first = "first comes what `cutc compile`, `cutc sew` or `cutc flow` wrote with a target that is judged, then \
                     its source as --source";
        let message = format!("not a program: `{}`: {what}", path.display());
        Ok(Err(failure(message, format!("{hint}; {first}"))))
    }

    fn claim(&self) -> Claim<'_> {
        Claim { name: &self.name, target: self.target.as_deref() }
    }

    /// Its machine by its name or its provenance; else the machine of the profile's tool.
    fn machine(&self, job: &Job) -> &'static Machine {
        machines::claimant(self.claim()).unwrap_or_else(|| machines::of(job))
    }
}

impl Arguments {
    /// Judges a program by a source.
    pub(super) fn judge(&self, program: &mut Program, source: &Source, job: &Job) -> anyhow::Result<Judged> {
        let (path, machine, asked) = (program.path, program.machine(job), self.asked());
        self.refuse(path, machine, job)?;
        let mut diagnostics = Diagnostics::default();
        let meta = self.meta.clone().unwrap_or_else(|| files::meta(path));
        let declared = match provenance::declared(&meta) {
            Ok(declared) => declared.map(Declared::new),
            Err(fault) => return Ok(Judged { verdict: None, said: format!("error: {fault:#}\n") }),
        };
        let open = |name: &str| -> io::Result<Box<dyn BufRead>> {
            let beside = path.with_file_name(name);
            let named = |error: io::Error| io::Error::new(error.kind(), beside.display().to_string());
            Ok(Box::new(BufReader::with_capacity(BLOCK_BYTES, File::open(&beside).map_err(named)?)))
        };
        let Program { file, name, target, .. } = program;
        let claim = Claim { name, target: target.as_deref() };
        let mut written = Written { claim, bytes: file, open: &open, declared: declared.as_ref() };
        let judge = machine.judge.expect("a machine that claims programs judges them");
        let judged = judge(&mut written, source, &asked, job, &mut diagnostics);
        let verdict = judged.map_err(|error| match error.kind() {
            io::ErrorKind::NotFound => failure(
                format!("there is no `{error}`, which `{}` needs", path.display()),
                "move the folder of a plan as a whole, or plan anew",
            ),
            _ => cannot_read(path, &error),
        })?;
        let mut said = render_with(&diagnostics, source, self.messages.detail(self.format));
        if !self.messages.quiet {
            let options = if machine.is_sewn { sew::typed(&asked) } else { job.typed() };
            said.push_str(&provenance::doubts(path, &meta, source, job, &options));
            said.extend(machine.parts.map(|parts| provenance::doubts_of_parts(path, parts)));
            if declared.is_none()
                && verdict.as_ref().is_some_and(|explained| explained.verdict.under(&rules::DECLARED).is_some())
            {
                say(&mut said, format_args!("note: {}", undeclared(&meta)));
            }
        }
        if verdict.is_none() {
            let errors = counted(diagnostics.count(Severity::Error), "error");
            say(&mut said, format_args!("{}: {errors}; `{}` was not judged", source.name(), path.display()));
        }
        Ok(Judged { verdict, said })
    }
}

impl Arguments {
    /// Refuses options that have no effect on the programs of a machine, and jobs that it cannot do.
    fn refuse(&self, program: &Path, machine: &Machine, job: &Job) -> anyhow::Result<()> {
        let others = Job { patterns: Patterns::default(), ..job.clone() }.typed();
        if machine.is_sewn && !others.is_empty() {
            return Err(failure(
                format!("`{others}` does nothing to a program of a sewing machine"),
                "leave it out: what it was sewn with are --from, --line, --inset, --size, --quantity and the profile",
            ));
        }
        if !machine.is_sewn && (self.line.is_some() || self.inset.is_some()) {
            return Err(failure(
                format!("`{}` is no program of `cutc sew`: --line and --inset do nothing to it", program.display()),
                "leave them out",
            ));
        }
        match (machine.refusal)(job) {
            None => Ok(()),
            Some([what, hint]) => Err(failure(what, hint)),
        }
    }
}

/// Message about a program without declarations.
fn undeclared(meta: &Path) -> String {
    format!(
        "nothing says what the program does beside the drawing (no `{}`): it is held to the bounds for every program\n  \
         = hint: `cutc manual verification` has them; --meta names what was written with the program",
        meta.display()
    )
}

fn cannot_read(path: &Path, error: &io::Error) -> anyhow::Error {
    failure(format!("cannot read `{}`: {error}", path.display()), "check the disk that it is on")
}
