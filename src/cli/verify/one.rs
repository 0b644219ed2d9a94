//! One program, and all that its verdict says.

use std::fs::File;
use std::io;
use std::path::Path;

use super::arguments::Arguments;
use crate::cli::choices::Format;
use crate::cli::finished::{DONE, FAULTY, Finished, failure, say};
use crate::cli::options::{counted, typed};
use crate::cli::verdict::{self, Judgement};
use crate::cli::{files, flow, provenance, sew};
use crate::diagnostic::{Diagnostics, Severity, render_with};
use crate::machine::Job;
use crate::pipeline::{self, Declared, Explained, rules};
use crate::sew::Target;
use crate::source::Source;

/// A program that can be judged.
pub(super) struct Program<'a> {
    path: &'a Path,
    machine: Machine,
}

/// The machine of a program, with the bytes of that.
enum Machine {
    /// A cutter or a spray head.
    Cutter(File),
    /// Heads over a conveyor: the plan names their programs.
    Heads,
    /// A sewing machine.
    Sewing(File, &'static Target),
}

impl Machine {
    /// Its work, as a verb.
    fn works(&self) -> &'static str {
        match self {
            Self::Cutter(_) | Self::Heads => "cuts",
            Self::Sewing(..) => "sews",
        }
    }
}

/// What was found of a program.
pub(super) struct Judged {
    /// `None` when its source has errors.
    pub(super) verdict: Option<Explained>,
    /// What is said of the source, and of whether the program was made from it.
    pub(super) said: String,
}

pub(super) fn run(arguments: &Arguments, program: &Path, source: &Path) -> anyhow::Result<Finished> {
    let mut program = match Program::open(program)? {
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
    let job = match arguments.job()? {
        Ok(job) => job,
        Err(refused) => return Ok(refused),
    };
    let Judged { verdict, said } = arguments.judge(&mut program, &source, &job)?;
    let stdout = match (arguments.format, &verdict) {
        (Format::Json, verdict) => verdict::json(verdict.as_ref()),
        (Format::Text, Some(explained)) => {
            let (works, program) = (program.machine.works(), program.path.display().to_string());
            verdict::text(&Judgement { explained, mode: job.mode, works, program: &program, source: source.name() })
        }
        (Format::Text, None) => String::new(),
    };
    let code = if verdict.is_some_and(|explained| explained.verdict.passes()) { DONE } else { FAULTY };
    Ok(Finished::text(stdout, said, code))
}

impl<'a> Program<'a> {
    /// Opens a file; the inner error is of one that is no program.
    pub(super) fn open(path: &'a Path) -> anyhow::Result<Result<Self, anyhow::Error>> {
        if files::is_plan(path) {
            return Ok(Ok(Self { path, machine: Machine::Heads }));
        }
        let mut file = files::open(path)?;
        if let Some(target) = sew::target_of(path) {
            return Ok(Ok(Self { path, machine: Machine::Sewing(file, target) }));
        }
        let foreign = pipeline::foreign(&mut file).map_err(|error| cannot_read(path, &error))?;
        let Some([what, hint]) = foreign else { return Ok(Ok(Self { path, machine: Machine::Cutter(file) })) };
        let first = "first comes what `cutc compile`, `cutc sew` or `cutc flow` wrote with a target that is judged, then \
                     its source as --source";
        let message = format!("not a program: `{}`: {what}", path.display());
        Ok(Err(failure(message, format!("{hint}; {first}"))))
    }
}

impl Arguments {
    /// Judges a program by a source.
    pub(super) fn judge(&self, program: &mut Program, source: &Source, job: &Job) -> anyhow::Result<Judged> {
        let Program { path, machine } = program;
        let asked = self.asked();
        if !matches!(machine, Machine::Sewing(..)) && (self.line.is_some() || self.inset.is_some()) {
            return Err(failure(
                format!("`{}` is no program of `cutc sew`: --line and --inset do nothing to it", path.display()),
                "leave them out",
            ));
        }
        let mut diagnostics = Diagnostics::default();
        let meta = self.meta.clone().unwrap_or_else(|| files::meta(path));
        let declared = match provenance::declared(&meta) {
            Ok(declared) => declared.map(Declared::new),
            Err(fault) => return Ok(Judged { verdict: None, said: format!("error: {fault:#}\n") }),
        };
        let from = self.reading.from;
        let verdict = match machine {
            Machine::Heads => flow::judge(path, source, from, job, &mut diagnostics)?,
            Machine::Sewing(file, target) => sew::judge((file, target), source, &asked, job, &mut diagnostics)?,
            Machine::Cutter(file) => {
                pipeline::judge_program(file, source, from, job, declared.as_ref(), &mut diagnostics)
                    .map_err(|error| cannot_read(path, &error))?
            }
        };
        let mut said = render_with(&diagnostics, source, self.messages.detail(self.format));
        if !self.messages.quiet {
            let options = match machine {
                Machine::Cutter(_) | Machine::Heads => typed(job),
                Machine::Sewing(..) => sew::typed(&asked),
            };
            said.push_str(&provenance::doubts(path, &meta, source, job, &options));
            if let Machine::Heads = machine {
                said.push_str(&flow::doubts(path));
            }
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

/// Said of a program that declares nothing.
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
