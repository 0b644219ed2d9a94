//! A plan that was written before: the programs of its heads, judged anew from their bytes.

use std::fs::{self, File};
use std::io::{self, BufRead, BufReader};
use std::path::{Path, PathBuf};

use serde_json::Value;

use super::earlier::is_plain;
use super::made::cannot_read_back;
use super::{on_cloth, refuse_others};
use crate::cli::files;
use crate::cli::finished::{failure, say};
use crate::cli::made::BLOCK_BYTES;
use crate::diagnostic::Diagnostics;
use crate::flow::verify::{self, Bytes, Ground};
use crate::flow::{TARGETS, Target};
use crate::front::Dialect;
use crate::machine::{Job, blake3_of};
use crate::pipeline::{self, Explained, Judged};
use crate::source::Source;

/// Judges the programs that a plan names by the marker that they must cut; of several targets all. `None` when the marker has
/// errors: then the diagnostics say which.
pub(in crate::cli) fn judge(
    plan: &Path,
    source: &Source,
    from: Option<&'static Dialect>,
    job: &Job,
    out: &mut Diagnostics,
) -> anyhow::Result<Option<Explained>> {
    refuse_others(job)?;
    let bytes = files::read(plan)?;
    let text = String::from_utf8_lossy(bytes.bytes());
    let job = on_cloth(job.clone(), from, source);
    let Some(Judged { mut input, reading }) = pipeline::read_to_judge(source, from, &job, out) else { return Ok(None) };
    pipeline::make_cuts(&mut input, source, &job, out);
    if out.has_errors() {
        return Ok(None);
    }
    let ground = Ground { marker: &input.marker, profile: &job.profile };
    let mut verdict = None;
    for Programs { bytes, paths } in programs(plan, &text) {
        if let Some(missing) = paths.iter().find(|path| !path.is_file()) {
            return Err(failure(
                format!("there is no `{}`, which `{}` needs", missing.display(), plan.display()),
                "move the folder of a plan as a whole, or plan anew",
            ));
        }
        let open = |head: usize| -> io::Result<Box<dyn BufRead>> {
            Ok(Box::new(BufReader::with_capacity(BLOCK_BYTES, File::open(&paths[head])?)))
        };
        let judged = verify::judge(&text, (bytes, &open), &ground).map_err(|error| cannot_read_back(&error))?;
        verdict = Some(match verdict {
            None => judged,
            Some(known) => pipeline::both(known, judged),
        });
    }
    let mut verdict = verdict.expect("a plan has programs of one target at the least");
    verdict.findings.extend(pipeline::audited(source, input.dialect, reading, &job));
    let told = pipeline::told(&verdict, &input.marker, source, &job);
    Ok(Some(Explained { verdict, told }))
}

/// Programs of one target that a plan names, head by head.
struct Programs {
    bytes: Bytes,
    paths: Vec<PathBuf>,
}

/// The programs of each target that a plan names. A head without a program has the name that its target gives it; a plan without
/// any program has those of the first target.
fn programs(plan: &Path, text: &str) -> Vec<Programs> {
    let told: Value = serde_json::from_str(text).unwrap_or_default();
    let heads = told["heads"].as_array().map_or(&[][..], Vec::as_slice);
    let folder = plan.parent().unwrap_or(Path::new(""));
    let of_target = |target: &Target| {
        let bytes = target.proof?;
        let named: Vec<Option<&str>> = heads.iter().map(|head| named(head, target.extension)).collect();
        let is_any = named.iter().any(Option::is_some);
        let name = |(head, name): (usize, Option<&str>)| name.map_or_else(|| target.file(head), str::to_owned);
        let paths = named.into_iter().enumerate().map(|of_head| folder.join(name(of_head))).collect();
        Some((is_any, Programs { bytes, paths }))
    };
    let (named, unnamed): (Vec<_>, Vec<_>) = TARGETS.iter().filter_map(of_target).partition(|(is_named, _)| *is_named);
    let kept = if named.is_empty() { unnamed.into_iter().take(1).collect() } else { named };
    kept.into_iter().map(|(_, programs)| programs).collect()
}

/// The file of a head with an extension.
fn named<'a>(head: &'a Value, extension: &str) -> Option<&'a str> {
    let files = head["files"].as_array()?;
    let mut names = files.iter().filter_map(|file| file["file"].as_str()).filter(|name| is_plain(name));
    names.find(|name| Path::new(name).extension().is_some_and(|end| end == extension))
}

/// Warnings on programs whose bytes are others than those that the plan tells.
pub(in crate::cli) fn doubts(plan: &Path) -> String {
    let text = fs::read(plan).unwrap_or_default();
    let told: Value = serde_json::from_slice(&text).unwrap_or_default();
    let heads = told["heads"].as_array().into_iter().flatten();
    let files = heads.flat_map(|head| head["files"].as_array().into_iter().flatten());
    let mut said = String::new();
    for file in files {
        let (Some(name), Some(digest)) = (file["file"].as_str().filter(|name| is_plain(name)), file["blake3"].as_str())
        else {
            continue;
        };
        let path = plan.with_file_name(name);
        if File::open(&path).and_then(blake3_of).is_ok_and(|found| found != digest) {
            say(
                &mut said,
                format_args!(
                    "warning: `{}` is not the program that was planned: its bytes are others\n  --> {}\n  \
                     = hint: it was edited by hand or sent on changed, or heads changed places",
                    path.display(),
                    plan.display()
                ),
            );
        }
    }
    said
}
