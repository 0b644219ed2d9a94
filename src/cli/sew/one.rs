//! One file, with detailed messages.

use std::path::{Path, PathBuf};

use super::arguments::Arguments;
use super::sewn::{Programs, Sewing};
use super::summary;
use crate::cli::choices::Format;
use crate::cli::destination::{Asked, Destination};
use crate::cli::draft::MadeFolders;
use crate::cli::files;
use crate::cli::finished::{DONE, FAULTY, Finished, Stdout, say};
use crate::sew::TARGETS;

pub(super) fn run(arguments: &Arguments, file: &Path) -> anyhow::Result<Finished> {
    let Arguments { out, targets, force, machine, .. } = arguments;
    let beside = [machine.profile.as_deref(), None, None];
    let asked = Asked { all: TARGETS, out: out.as_deref(), targets, input: file, beside, force: *force };
    let Destination { targets, place } = asked.destination()?;
    place.refuse_json(arguments.format)?;
    let paths = place.files();
    let source = files::read(file)?;
    let job = match arguments.machine.job()? {
        Ok(job) => arguments.of(job),
        Err(refused) => return Ok(place.refused(refused)),
    };
    let _made = MadeFolders::of(paths.iter().map(PathBuf::as_path))?;
    let sewn = Sewing { arguments, targets: &targets, job: &job }.sew(&source, &place, None)?;
    let json = (arguments.format == Format::Json).then(|| sewn.json(&source, &job));
    let mut said = sewn.said;
    let Some(Programs { figures, written, .. }) = sewn.made else {
        return Ok(Finished::text(json.unwrap_or_default(), said, FAULTY));
    };
    let text = summary::text(&source, &figures, arguments.messages.quiet);
    let stdout = match (json, written.stdout) {
        (_, Some(spool)) => {
            said.push_str(&text);
            Stdout::Program(spool)
        }
        (Some(json), None) => Stdout::Text(json),
        (None, None) => Stdout::Text(text),
    };
    for path in paths.iter().filter(|_| !arguments.messages.quiet) {
        say(&mut said, format_args!("wrote `{}`", path.display()));
    }
    Ok(Finished { stdout, stderr: said, code: DONE })
}
