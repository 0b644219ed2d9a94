//! Programs that are written: whole and judged, with their provenance beside them, or none at all.

use std::io::{self, BufReader, BufWriter, Read, Seek, Write};
use std::path::{Path, PathBuf};

use serde::Serialize;
use tempfile::SpooledTempFile;

use crate::cli::draft::{self, Draft};
use crate::cli::files;
use crate::cli::finished::failure;
use crate::cli::report::pretty;
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::machine::{Job, blake3_of, sha256_hex};
use crate::sew::verify::Verdict;
use crate::sew::{self, Asked, Program, Proof, TARGETS, Target};
use crate::source::Source;

/// Bytes that are kept in memory where no file is asked for; more go to a temporary one.
const SPOOL_BYTES: usize = 16 << 20;
/// Bytes that are written and read at a time.
const BLOCK_BYTES: usize = 1 << 17;

/// What is to be written.
pub(super) struct Made<'a> {
    pub(super) targets: &'a [&'static Target],
    pub(super) source: &'a Source,
    pub(super) job: &'a Job,
    pub(super) asked: &'a Asked,
    pub(super) verify: bool,
}

/// What was written.
pub(super) struct Written {
    /// What each program is worth, with the name of its target.
    pub(super) verdicts: Vec<(&'static str, Verdict)>,
    /// The program for standard output.
    pub(super) stdout: Option<SpooledTempFile>,
}

/// Everything that made a program. No date and no path: the same input gives the same bytes.
#[derive(Serialize)]
struct Provenance<'a> {
    version: &'static str,
    source: String,
    source_sha256: String,
    profile: &'a str,
    profile_sha256: String,
    target: &'a str,
    verified: &'static str,
    program_blake3: &'a str,
    #[serde(skip_serializing_if = "String::is_empty")]
    options: String,
}

impl Made<'_> {
    /// Writes every program to its path, or the only one for standard output. Nothing takes its place when one is refused.
    pub(super) fn write(&self, program: &Program, paths: &[PathBuf], out: &mut Diagnostics) -> anyhow::Result<Written> {
        let mut verdicts = Vec::new();
        for target in self.targets {
            (target.refusals)(program, self.job, out);
        }
        if self.verify && self.targets.iter().all(|target| target.proof == Proof::None) {
            // Pictures show what is written otherwise: that is judged.
            let pulses = TARGETS.iter().find(|target| target.proof == Proof::PulseRecords);
            let pulses = pulses.expect("pulses are a target");
            let mut spool = SpooledTempFile::new(SPOOL_BYTES);
            self.make(program, pulses, &mut spool, &mut verdicts, out).map_err(|error| cannot_spool(&error))?;
        }
        if paths.is_empty() {
            let mut spool = SpooledTempFile::new(SPOOL_BYTES);
            let made = self.make(program, self.targets[0], &mut spool, &mut verdicts, out);
            made.map_err(|error| cannot_spool(&error))?;
            return Ok(Written { verdicts, stdout: Some(spool) });
        }
        let mut drafts = Vec::new();
        for (target, path) in self.targets.iter().zip(paths) {
            let mut draft = Draft::new(path)?;
            let made = self.make(program, target, draft.file(), &mut verdicts, out);
            made.map_err(|error| files::cannot_write(path, &error))?;
            drafts.push(self.meta(&files::meta(path), draft.file(), target)?);
            drafts.push(draft);
        }
        if !out.has_errors() {
            draft::publish(drafts, || Ok(()))?;
        }
        Ok(Written { verdicts, stdout: None })
    }

    /// Writes a program and judges its bytes.
    fn make(
        &self,
        program: &Program,
        target: &'static Target,
        file: &mut (impl Read + Write + Seek),
        verdicts: &mut Vec<(&'static str, Verdict)>,
        out: &mut Diagnostics,
    ) -> io::Result<()> {
        let mut writer = BufWriter::with_capacity(BLOCK_BYTES, &mut *file);
        (target.write)(program, self.job, &mut writer)?;
        writer.flush()?;
        drop(writer);
        file.rewind()?;
        if !self.verify {
            return Ok(());
        }
        let verdict =
            sew::judge(program, self.source, self.job, target.proof, &mut BufReader::with_capacity(BLOCK_BYTES, file))?;
        if let Some(verdict) = verdict {
            tell(&verdict, target, out);
            verdicts.push((target.name, verdict));
        }
        Ok(())
    }

    /// The provenance of a program, as a draft of a file.
    fn meta(&self, path: &Path, program: &mut std::fs::File, target: &Target) -> anyhow::Result<Draft> {
        let mut meta = Draft::new(path)?;
        let name = Path::new(self.source.name()).file_name().map(|name| name.to_string_lossy().into_owned());
        let written = program.rewind().and_then(|()| blake3_of(&mut *program)).and_then(|blake3| {
            let text = pretty(&Provenance {
                version: env!("CARGO_PKG_VERSION"),
                source: name.unwrap_or_else(|| self.source.name().to_owned()),
                source_sha256: sha256_hex(self.source.bytes()),
                profile: self.job.origin.name(),
                profile_sha256: self.job.profile.digest(),
                target: target.name,
                verified: if self.verify { "yes" } else { "no" },
                program_blake3: &blake3,
                options: typed(self.asked),
            });
            meta.file().write_all(text.as_bytes())
        });
        written.map_err(|error| files::cannot_write(path, &error))?;
        Ok(meta)
    }
}

/// What was asked of the file, as it is typed.
fn typed(asked: &Asked) -> String {
    let from = asked.from.as_ref().map(|from| format!("--from {from}"));
    let line = asked.line.as_ref().map(|line| format!("--line {line}"));
    let inset = (asked.inset != 0.0).then(|| format!("--inset {}", asked.inset));
    [from, line, inset].into_iter().flatten().collect::<Vec<_>>().join(" ")
}

/// Says which rules a program breaks.
fn tell(verdict: &Verdict, target: &Target, out: &mut Diagnostics) {
    if let Some(unread) = &verdict.unread {
        let message = format!("the program (target {}) cannot be read back: {unread}", target.name);
        out.push(Diagnostic::new(&code::SEW_BROKEN, message));
    }
    for finding in verdict.broken().filter(|_| verdict.unread.is_none()) {
        let limit = finding.limit.unwrap_or(f64::INFINITY);
        let place = finding.place.and_then(|place| place.line).map_or(String::new(), |n| format!(", entry {n}"));
        let message = format!(
            "{} (target {}): {:.4} {}, allowed {limit:.4}{place}",
            finding.rule, target.name, finding.worst, finding.unit
        );
        out.push(Diagnostic::new(&code::SEW_BROKEN, message).hint(format!("`cutc explain {}`", finding.rule)));
    }
}

fn cannot_spool(error: &io::Error) -> anyhow::Error {
    failure(format!("cannot spool the program: {error}"), "make room for temporary files, or write to a file")
}
