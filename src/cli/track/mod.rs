//! `cutc track`: ruler readings of a moving cloth to commands for the carriage, and to the line that the cloth took.

mod arguments;
mod made;
mod place;
mod summary;

pub(super) use arguments::Arguments;

use std::path::{Path, PathBuf};

use self::made::product;
use super::choices::Format;
use super::destination::Destination;
use super::draft::MadeFolders;
use super::files;
use super::finished::{DONE, FAULTY, Finished, Stdout, say};
use super::made::Origin;
use super::report;
use crate::diagnostic::{Diagnostics, render_with};
use crate::machine::Job;
use crate::source::Source;
use crate::track::{Needs, Tracked};

pub(super) fn run(arguments: &Arguments) -> anyhow::Result<Finished> {
    let destinations = place::destinations(arguments)?;
    destinations.iter().try_for_each(|found| found.place.refuse_json(arguments.format))?;
    let paths: Vec<&Path> = destinations.iter().flat_map(|found| found.place.files()).map(PathBuf::as_path).collect();
    let source = files::read(&arguments.file)?;
    let job = match arguments.machine.job()? {
        Ok(job) => job,
        Err(refused) => return Ok(destinations.iter().fold(refused, |refused, found| found.place.refused(refused))),
    };
    let _made = MadeFolders::of(paths.iter().copied())?;
    let needs = destinations.iter().flat_map(|found| &found.targets).map(|target| target.emit.needs).max();
    let needs = needs.unwrap_or(Needs::Commands);
    let mut diagnostics = Diagnostics::default();
    let track = &job.profile.track;
    let tracked = if arguments.simulate {
        Tracked::of_scenario(&source, track, needs, &mut diagnostics)
    } else {
        Tracked::of_log(&source, track, needs, &mut diagnostics)
    };
    let Some(tracked) = tracked else {
        return Ok(refused(arguments, &source, &paths, &diagnostics, &job));
    };
    let mut spool = None;
    for Destination { targets, place } in &destinations {
        let products: Vec<_> = targets.iter().map(|target| product(target, &tracked, &job)).collect();
        let origin = Origin { source: &source, job: &job, options: "", record: None };
        spool = origin.write(&products, place, &mut diagnostics)?.or(spool);
    }
    if diagnostics.has_errors() {
        return Ok(refused(arguments, &source, &paths, &diagnostics, &job));
    }
    let mut said = render_with(&diagnostics, &source, arguments.messages.detail(arguments.format));
    let figures = summary::Figures::of(&tracked);
    let text = summary::text(&source, &figures, arguments.messages.quiet);
    let stdout = match (arguments.format, spool) {
        (_, Some(spool)) => {
            said.push_str(&text);
            Stdout::Program(spool)
        }
        (Format::Json, None) => Stdout::Text(report::json_by_profile(figures, &diagnostics, &source, &job)),
        (Format::Text, None) => Stdout::Text(text),
    };
    for path in paths.iter().filter(|_| !arguments.messages.quiet) {
        say(&mut said, format_args!("wrote `{}`", path.display()));
    }
    Ok(Finished { stdout, stderr: said, code: DONE })
}

/// Messages when nothing is written. Older files of these names are moved aside.
fn refused(arguments: &Arguments, source: &Source, paths: &[&Path], diagnostics: &Diagnostics, job: &Job) -> Finished {
    let mut said = render_with(diagnostics, source, arguments.messages.detail(arguments.format));
    said.push_str(&report::nothing_written(source, diagnostics));
    said.extend(paths.iter().map(|path| files::move_aside(path)));
    let stdout = match arguments.format {
        Format::Json => report::json_by_profile(summary::nothing(), diagnostics, source, job),
        Format::Text => String::new(),
    };
    Finished::text(stdout, said, FAULTY)
}
