//! A program that was written before, judged anew from its bytes.

use std::fs::File;
use std::io::{BufReader, Seek as _};
use std::path::Path;

use crate::cli::finished::failure;
use crate::cli::made::BLOCK_BYTES;
use crate::cli::{files, options, provenance};
use crate::diagnostic::Diagnostics;
use crate::ir::Finding;
use crate::machine::Job;
use crate::machine::patterns::Patterns;
use crate::pipeline::{Explained, Line, Told};
use crate::sew::{self, Asked, Made, TARGETS, Target};
use crate::source::Source;

/// The target that a program was made by, as its provenance or else its name tells, if programs of it are judged.
pub(in crate::cli) fn target_of(program: &Path) -> Option<&'static Target> {
    let name = program.file_name()?.to_string_lossy().to_ascii_lowercase();
    let is_named = |target: &&Target| name.ends_with(&format!(".{}", target.extension));
    let found = match provenance::target_of(program) {
        Some(told) => TARGETS.iter().find(|target| target.name == told),
        None => TARGETS.iter().find(is_named),
    };
    found.filter(|target| target.proof.is_some())
}

/// Judges a program by what must be sewn of a source. `None` when that has errors: then the diagnostics say which.
pub(in crate::cli) fn judge(
    (program, target): (&mut File, &Target),
    source: &Source,
    asked: &Asked,
    job: &Job,
    out: &mut Diagnostics,
) -> anyhow::Result<Option<Explained>> {
    let others = options::typed(&Job { patterns: Patterns::default(), ..job.clone() });
    if !others.is_empty() {
        return Err(failure(
            format!("`{others}` does nothing to a program of a sewing machine"),
            "leave it out: what it was sewn with are --from, --line, --inset, --size, --quantity and the profile",
        ));
    }
    let Some(planned) = sew::plan(source, asked, job, out) else { return Ok(None) };
    let bytes = target.proof.expect("a target whose programs are judged");
    program.rewind().map_err(|error| cannot_read(&error))?;
    let mut input = BufReader::with_capacity(BLOCK_BYTES, program);
    let made = Made { program: &planned, source, job };
    let verdict = made.judge(bytes, &mut input).map_err(|error| cannot_read(&error))?;
    let told = |finding: &Finding| {
        let entry = finding.place.and_then(|place| place.line);
        Told { line: entry.map(Line::Entry), ..Told::default() }
    };
    let told = verdict.broken().map(told).collect();
    Ok(Some(Explained { verdict, told }))
}

fn cannot_read(error: &std::io::Error) -> anyhow::Error {
    failure(format!("the program cannot be read: {}", files::reason(error)), "check the disk that it is on")
}
