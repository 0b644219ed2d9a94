//! Provenance of a program: the `.meta.json` beside it.

use std::fs;
use std::io::{Read, Seek, Write as _};
use std::path::Path;

use serde::Serialize;

use super::draft::Draft;
use super::files;
use super::finished::{failure, say};
use super::report::pretty;
use crate::ir::declaration::Declaration;
use crate::machine::{Job, blake3_of, file_name, sha256_hex};
use crate::machines::{self, Part};
use crate::source::Source;

/// All inputs of a program, for later readers. No date, and no path except from the program to its input: folders that are
/// moved together keep their bytes.
#[derive(Serialize)]
struct Provenance<'a> {
    /// Version of this program.
    version: &'static str,
    /// Name of the input, without its directory.
    source: String,
    /// Path of the input from the folder of the program; absent for standard input.
    #[serde(skip_serializing_if = "Option::is_none")]
    source_path: Option<String>,
    source_sha256: String,
    /// Name of the machine profile, without its directory, or that of the default machine.
    profile: &'a str,
    /// Digest of the values in effect, `--set` included.
    profile_sha256: String,
    target: &'a str,
    /// Period and units of the program of a cutter; absent for other machines.
    #[serde(flatten)]
    scale: Option<Scale>,
    verified: Verified,
    /// Digest of the program.
    program_blake3: &'a str,
    /// Unavoidable deviations of the program from the drawing; absent when the target is not judged by its motion.
    #[serde(skip_serializing_if = "Option::is_none")]
    declared: Option<&'a [Declaration]>,
    /// The centre line that the marker follows; absent when there is none.
    #[serde(skip_serializing_if = "Option::is_none")]
    centre: Option<SideFile>,
    /// The registration marks by which the marker was laid; absent when there are none.
    #[serde(skip_serializing_if = "Option::is_none")]
    map: Option<SideFile>,
    /// Options beside the profile, as typed; absent when there are none.
    #[serde(skip_serializing_if = "str::is_empty")]
    options: &'a str,
}

/// Period and units of setpoints.
#[derive(Serialize)]
struct Scale {
    period_ms: f64,
    units: Units,
}

/// A file beside the source.
#[derive(Serialize)]
struct SideFile {
    /// Name without its directory.
    file: String,
    sha256: String,
}

impl SideFile {
    fn of(source: &Source) -> Self {
        Self { file: file_name(source), sha256: sha256_hex(source.bytes()) }
    }
}

/// Units of the setpoints.
#[derive(Serialize)]
struct Units {
    time: &'static str,
    length: &'static str,
    angle: &'static str,
}

/// Verification of the program: read back and proven to agree with the input, or not.
#[derive(Debug, Clone, Copy, Serialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum Verified {
    /// Not by this compile.
    No,
    /// By this compile.
    Yes,
    /// The file is a picture of a refused program.
    Refused,
}

/// Ingredients of a program.
#[derive(Debug, Clone, Copy)]
pub(super) struct Made<'a> {
    pub(super) source: &'a Source,
    pub(super) job: &'a Job,
    /// Name of the target, or names of several under one plan.
    pub(super) target: &'a str,
    /// Its verification.
    pub(super) verified: Verified,
    /// Data of a cutter's program; `None` for other machines.
    pub(super) cut: Option<Cut<'a>>,
    /// Options beside the profile, as typed.
    pub(super) options: &'a str,
}

/// Additional data of a cutter's program.
#[derive(Debug, Clone, Copy)]
pub(super) struct Cut<'a> {
    /// Declared deviations from the drawing; `None` when it is not judged by its motion.
    pub(super) declared: Option<&'a [Declaration]>,
}

/// Draft of the provenance of a program, at `path` beside it.
///
/// # Errors
///
/// The program cannot be read, or the draft cannot be written.
pub(super) fn draft<P: Read + Seek + ?Sized>(path: &Path, program: &mut P, made: &Made) -> anyhow::Result<Draft> {
    let mut draft = Draft::new(path)?;
    let digest = program.rewind().and_then(|()| blake3_of(&mut *program));
    let written = digest.and_then(|blake3| draft.file().write_all(json(path, &blake3, made).as_bytes()));
    written.map_err(|error| files::cannot_write(path, &error))?;
    Ok(draft)
}

/// Provenance of a program with this digest, as JSON at `path`.
fn json(path: &Path, blake3: &str, Made { source, job, target, verified, cut, options }: &Made) -> String {
    let scale =
        || Scale { period_ms: job.profile.time.period_ms, units: Units { time: "s", length: "mm", angle: "deg" } };
    pretty(&Provenance {
        version: env!("CARGO_PKG_VERSION"),
        source: file_name(source),
        source_path: path_of(source, path),
        source_sha256: sha256_hex(source.bytes()),
        profile: job.origin.name(),
        profile_sha256: job.profile.digest(),
        target,
        scale: cut.map(|_| scale()),
        verified: *verified,
        program_blake3: blake3,
        declared: cut.and_then(|cut| cut.declared),
        centre: job.centre.as_ref().map(|centre| SideFile::of(&centre.source)),
        map: job.marks.as_ref().map(|marks| SideFile::of(marks.source())),
        options,
    })
}

/// Name of the input of a program, by its provenance.
pub(super) fn source_of(program: &Path) -> Option<String> {
    told(program, "source")
}

/// Path of the input of a program from the folder of the program, by its provenance.
pub(super) fn source_path_of(program: &Path) -> Option<String> {
    told(program, "source_path")
}

/// True if a program was made from these bytes.
pub(super) fn is_made_from(program: &Path, bytes: &[u8]) -> bool {
    told(program, "source_sha256").is_some_and(|digest| digest == sha256_hex(bytes))
}

/// Path of an input from the folder of a file; `None` for standard input.
fn path_of(source: &Source, beside: &Path) -> Option<String> {
    if source.name() == files::STDIN {
        None
    } else {
        files::path_from(files::directory(beside), source.name().as_ref())
    }
}

/// True if a program can be judged, by its target; `None` without provenance.
pub(super) fn is_judged(program: &Path) -> Option<bool> {
    target_of(program).map(|target| machines::is_judged(&target))
}

/// Name of the target of a program, by its provenance.
pub(super) fn target_of(program: &Path) -> Option<String> {
    told(program, "target")
}

/// Value of a key in the provenance of a program.
fn told(program: &Path, key: &str) -> Option<String> {
    let meta: serde_json::Value = serde_json::from_slice(&fs::read(files::meta(program)).ok()?).ok()?;
    meta[key].as_str().map(str::to_owned)
}

/// Deviations from the drawing that the provenance of a program declares; `None` when it does not mention them.
///
/// # Errors
///
/// The provenance is no JSON, its declarations cannot be read, or a magnitude is no length.
pub(super) fn declared(path: &Path) -> anyhow::Result<Option<Vec<Declaration>>> {
    let Ok(bytes) = fs::read(path) else { return Ok(None) };
    let path = path.display();
    let hint = "take back the file that was written with the program, or compile it anew";
    let meta: serde_json::Value = serde_json::from_slice(&bytes)
        .map_err(|_| failure(format!("`{path}` is no JSON: nobody knows what the program was made from"), hint))?;
    let Some(told) = meta.get("declared") else { return Ok(None) };
    let told: Vec<Declaration> = serde_json::from_value(told.clone())
        .map_err(|error| failure(format!("what the program declares cannot be read: {error}, in `{path}`"), hint))?;
    let is_length = |mm: f64| mm.is_finite() && mm >= 0.0;
    match told.iter().find(|entry| !is_length(entry.magnitude_mm)) {
        None => Ok(Some(told)),
        Some(entry) => {
            let magnitude = entry.magnitude_mm;
            Err(failure(format!("the program declares a magnitude of {magnitude} mm, in `{path}`"), hint))
        }
    }
}

/// Warnings if the provenance of a program names another source, another profile or other options than those given; empty
/// without a provenance. Options are compared as typed.
pub(super) fn doubts(program: &Path, path: &Path, source: &Source, job: &Job, options: &str) -> String {
    let mut said = String::new();
    let Ok(bytes) = fs::read(path) else { return said };
    let path = path.display();
    let Ok(meta) = serde_json::from_slice::<serde_json::Value>(&bytes) else { return said };
    let differs = |key: &str, digest: &str| meta[key].as_str().is_some_and(|told| told != digest);
    if fs::File::open(program).and_then(blake3_of).is_ok_and(|digest| differs("program_blake3", &digest)) {
        say(
            &mut said,
            format_args!(
                "warning: the program is not the one that was compiled: its bytes are others\n  --> {path}\n  \
                 = hint: it was edited by hand or sent on changed; what the file beside it declares is applied all the same"
            ),
        );
    }
    if differs("source_sha256", &sha256_hex(source.bytes())) {
        let made_from = meta["source"].as_str().unwrap_or("another file");
        say(
            &mut said,
            format_args!(
                "warning: the program was not made from this `{}`\n  --> {path}: from `{made_from}`, with other bytes\n  \
                 = hint: name the cutter file that it was made from with --source, or compile it anew",
                source.name()
            ),
        );
    }
    if differs("profile_sha256", &job.profile.digest()) {
        say(
            &mut said,
            format_args!(
                "warning: the program was made with another machine profile\n  --> {path}\n  \
                 = hint: give the -p and --set that it was compiled with"
            ),
        );
    }
    let centre = job.centre.as_ref().map(|centre| &*centre.source);
    let marks = job.marks.as_ref().map(|marks| &**marks.source());
    for beside in [
        Beside { option: "centre", fault: "follows another centre line", source: centre },
        Beside { option: "map", fault: "was laid by other marks", source: marks },
    ] {
        beside.doubt(&mut said, &meta, &path);
    }
    doubt_options(&mut said, &meta, &path, options);
    said
}

/// Warnings about files beside a program whose bytes differ from the digests that it names.
pub(super) fn doubts_of_parts(program: &Path, parts: fn(&[u8]) -> Vec<Part>) -> String {
    let mut said = String::new();
    for Part { name, blake3 } in parts(&fs::read(program).unwrap_or_default()) {
        let path = program.with_file_name(name);
        if fs::File::open(&path).and_then(blake3_of).is_ok_and(|found| blake3.is_some_and(|told| told != found)) {
            say(
                &mut said,
                format_args!(
                    "warning: `{}` is not the program that was planned: its bytes are others\n  --> {}\n  \
                     = hint: it was edited by hand or sent on changed, or heads changed places",
                    path.display(),
                    program.display()
                ),
            );
        }
    }
    said
}

/// A file beside the source that a program is judged by.
struct Beside<'a> {
    /// The option that gives it.
    option: &'a str,
    /// Fault of a program that was made with another one, as a predicate.
    fault: &'a str,
    source: Option<&'a Source>,
}

impl Beside<'_> {
    /// Warns of a program that was made with another file.
    fn doubt(&self, said: &mut String, meta: &serde_json::Value, path: &impl std::fmt::Display) {
        let Self { option, fault, source } = *self;
        let given = source.map(|source| sha256_hex(source.bytes()));
        if let (Some(told), Some(given)) = (meta[option]["sha256"].as_str(), &given)
            && told != given
        {
            say(
                said,
                format_args!(
                    "warning: the program {fault}\n  --> {path}: `{}`, with other bytes\n  \
                     = hint: give the file that it was compiled with as --{option}",
                    meta[option]["file"].as_str().unwrap_or("another file")
                ),
            );
        }
    }
}

/// Reports that a program was made with other options than it is judged with, if it was.
fn doubt_options(said: &mut String, meta: &serde_json::Value, path: &impl std::fmt::Display, asked: &str) {
    let made = meta["options"].as_str().unwrap_or_default();
    if made != asked {
        let made = if made.is_empty() { "no option beside the profile's" } else { made };
        say(
            said,
            format_args!(
                "warning: the program was made with other options\n  --> {path}: with {made}\n  \
                 = hint: give the same to `cutc verify`"
            ),
        );
    }
}
