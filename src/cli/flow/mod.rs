//! `cutc flow`: a marker to the programs of heads that cut it while a conveyor moves it.

mod arguments;
mod earlier;
mod made;
mod summary;

pub(super) use arguments::Arguments;

use self::made::Made;
use super::choices::Format;
use super::destination::{not_of_another, writable};
use super::draft::MadeFolders;
use super::files;
use super::finished::{DONE, FAULTY, Finished, Stdout, failure, say};
use super::options::counted;
use super::report;
use crate::diagnostic::{Diagnostics, render_with};
use crate::flow::{Speed, TARGETS, Target};
use crate::machine::Job;
use crate::machines::flow::{self, PLAN, Planned};
use crate::source::Source;

pub(super) fn run(arguments: &Arguments) -> anyhow::Result<Finished> {
    let targets = targets(arguments)?;
    let plan = arguments.out.join(PLAN);
    let [centre, _] = arguments.choice.beside();
    let inputs = [Some(&*arguments.file), arguments.reading.machine.profile.as_deref(), centre];
    let inputs: Vec<_> = inputs.into_iter().flatten().filter(|path| !files::is_dash(path)).collect();
    writable(&plan, &inputs)?;
    if !arguments.force {
        not_of_another(&plan, &arguments.file)?;
    }
    let source = files::read(&arguments.file)?;
    let job = match arguments.choice.job(&arguments.reading)? {
        Ok(job) => job,
        Err(mut refused) => {
            // A mistake in an argument is no verdict on the programs that are there.
            if refused.code == FAULTY {
                refused.stderr.push_str(&earlier::move_aside(&arguments.out, &[]));
            }
            return Ok(refused);
        }
    };
    if let Some([what, hint]) = flow::refusal(&job) {
        return Err(failure(what, hint));
    }
    let from = arguments.reading.from;
    let job = flow::on_cloth(job, from, &source);
    let _made = MadeFolders::of([plan.as_path()])?;
    let mut diagnostics = Diagnostics::default();
    let speed = arguments.speed.unwrap_or(Speed::Profile);
    let Some(Planned { marker, program, audit }) = flow::plan(&source, from, speed, &job, &mut diagnostics) else {
        return Ok(refused(arguments, &source, &diagnostics, &job));
    };
    let verify = !arguments.no_verify;
    let made = Made { targets: &targets, source: &source, job: &job, marker: &marker, verify, audit: &audit };
    let written = made.write(&program, &arguments.out, &mut diagnostics)?;
    if diagnostics.has_errors() {
        return Ok(refused(arguments, &source, &diagnostics, &job));
    }
    let mut said = render_with(&diagnostics, &source, arguments.messages.detail(arguments.format));
    said.push_str(&written.said);
    if !arguments.messages.quiet {
        let count = counted(written.files, "file");
        say(&mut said, format_args!("wrote `{}` and {count} beside it", plan.display()));
    }
    let figures = summary::Figures::of(&program, written);
    let stdout = match arguments.format {
        Format::Json => report::json_by_profile(figures, &diagnostics, &source, &job),
        Format::Text => summary::text(&source, &figures, arguments.messages.quiet),
    };
    Ok(Finished { stdout: Stdout::Text(stdout), stderr: said, code: DONE })
}

/// The targets: those typed, else the default.
fn targets(arguments: &Arguments) -> anyhow::Result<Vec<&'static Target>> {
    let typed = &arguments.targets;
    if let Some(twice) = typed.iter().enumerate().find(|(i, t)| typed[..*i].iter().any(|u| u.name == t.name)) {
        return Err(failure(format!("the target `{}` is named twice", twice.1.name), "name each target once"));
    }
    Ok(if typed.is_empty() { vec![&TARGETS[0]] } else { typed.clone() })
}

/// Messages when nothing is written. Older programs are moved aside.
fn refused(arguments: &Arguments, source: &Source, diagnostics: &Diagnostics, job: &Job) -> Finished {
    let mut said = render_with(diagnostics, source, arguments.messages.detail(arguments.format));
    said.push_str(&report::nothing_written(source, diagnostics));
    said.push_str(&earlier::move_aside(&arguments.out, &[]));
    let stdout = match arguments.format {
        Format::Json => report::json_by_profile(summary::nothing(), diagnostics, source, job),
        Format::Text => String::new(),
    };
    Finished::text(stdout, said, FAULTY)
}
