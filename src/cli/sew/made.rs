//! Programs that are written: whole and judged, with their provenance beside them, or none at all.

use std::io::{self, BufReader, BufWriter, Read, Seek, Write};
use std::path::{Path, PathBuf};

use tempfile::SpooledTempFile;

use crate::cli::draft::{self, Draft};
use crate::cli::files;
use crate::cli::finished::failure;
use crate::cli::provenance::{self, Verified};
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::ir::verdict::Verdict;
use crate::machine::blake3_of;
use crate::sew::verify::Bytes;
use crate::sew::{Made, TARGETS, Target};

/// Bytes that are kept in memory where no file is asked for; more go to a temporary one.
const SPOOL_BYTES: usize = 16 << 20;
/// Bytes that are written and read at a time.
pub(super) const BLOCK_BYTES: usize = 1 << 17;

/// What is to be written.
#[derive(Clone, Copy)]
pub(super) struct Writing<'a> {
    pub(super) made: Made<'a>,
    pub(super) targets: &'a [&'static Target],
    /// What was asked of the file, as it is typed.
    pub(super) options: &'a str,
    pub(super) verify: bool,
}

/// What was written.
pub(super) struct Written {
    /// What was judged, and what it is worth.
    pub(super) verdicts: Vec<(&'static Target, Verdict)>,
    /// The program for standard output.
    pub(super) stdout: Option<SpooledTempFile>,
}

impl Writing<'_> {
    /// Writes every program to its path, or the only one for standard output. Nothing takes its place when one is refused.
    pub(super) fn write(&self, paths: &[PathBuf], out: &mut Diagnostics) -> anyhow::Result<Written> {
        let mut verdicts = Vec::new();
        for target in self.targets {
            (target.refusals)(self.made.program, self.made.job, out);
        }
        if self.verify && self.targets.iter().all(|target| target.proof.is_none()) {
            // Pictures show what is written otherwise: that is judged.
            let pulses = TARGETS.iter().find(|target| target.proof == Some(Bytes::PulseRecords));
            let pulses = pulses.expect("pulses are a target");
            let mut spool = SpooledTempFile::new(SPOOL_BYTES);
            verdicts.extend(self.make(pulses, &mut spool).map_err(|error| cannot_spool(&error))?);
        }
        if paths.is_empty() {
            let mut spool = SpooledTempFile::new(SPOOL_BYTES);
            verdicts.extend(self.make(self.targets[0], &mut spool).map_err(|error| cannot_spool(&error))?);
            tell(&verdicts, out);
            return Ok(Written { verdicts, stdout: Some(spool) });
        }
        let mut drafts = Vec::new();
        for (target, path) in self.targets.iter().zip(paths) {
            let mut draft = Draft::new(path)?;
            verdicts.extend(self.make(target, draft.file()).map_err(|error| files::cannot_write(path, &error))?);
            drafts.push(self.meta(&files::meta(path), draft.file(), target)?);
            drafts.push(draft);
        }
        tell(&verdicts, out);
        if !out.has_errors() {
            draft::publish(drafts, || Ok(()))?;
        }
        Ok(Written { verdicts, stdout: None })
    }

    /// Writes a program, and judges its bytes where these can be judged.
    fn make(
        &self,
        target: &'static Target,
        file: &mut (impl Read + Write + Seek),
    ) -> io::Result<Option<(&'static Target, Verdict)>> {
        let mut writer = BufWriter::with_capacity(BLOCK_BYTES, &mut *file);
        (target.write)(self.made.program, self.made.job, &mut writer)?;
        writer.flush()?;
        drop(writer);
        file.rewind()?;
        let Some(bytes) = target.proof.filter(|_| self.verify) else { return Ok(None) };
        let verdict = self.made.judge(bytes, &mut BufReader::with_capacity(BLOCK_BYTES, file))?;
        Ok(Some((target, verdict)))
    }

    /// The provenance of a program, as a draft of a file.
    fn meta(&self, path: &Path, program: &mut std::fs::File, target: &Target) -> anyhow::Result<Draft> {
        let mut meta = Draft::new(path)?;
        let Made { source, job, .. } = self.made;
        let verified = if self.verify { Verified::Yes } else { Verified::No };
        let written = program.rewind().and_then(|()| blake3_of(&mut *program)).and_then(|blake3| {
            let (target, options) = (target.name, self.options);
            let blake3 = &blake3;
            let made = provenance::Made { beside: path, source, job, target, verified, blake3, cut: None, options };
            let text = provenance::json(&made);
            meta.file().write_all(text.as_bytes())
        });
        written.map_err(|error| files::cannot_write(path, &error))?;
        Ok(meta)
    }
}

/// Says which rules programs break.
fn tell(verdicts: &[(&'static Target, Verdict)], out: &mut Diagnostics) {
    for (target, verdict) in verdicts {
        if let Some(unread) = &verdict.unread {
            let message = format!("the program (target {}) cannot be read back: {unread}", target.name);
            out.push(Diagnostic::new(&code::SEW_BROKEN, message));
        }
        for finding in verdict.broken().filter(|_| verdict.unread.is_none()) {
            let limit = finding.limit.unwrap_or(f64::INFINITY);
            let place = finding.place.and_then(|place| place.line).map_or(String::new(), |n| format!(", entry {n}"));
            let message = format!(
                "{} (target {}): {:.4} {}, allowed {limit:.4}{place}",
                finding.rule.name, target.name, finding.worst, finding.unit
            );
            let found =
                Diagnostic::new(&code::SEW_BROKEN, message).hint(format!("`cutc explain {}`", finding.rule.name));
            out.push(match finding.place {
                Some(place) => found.on_cloth(place.point),
                None => found,
            });
        }
    }
}

fn cannot_spool(error: &io::Error) -> anyhow::Error {
    failure(format!("cannot spool the program: {error}"), "make room for temporary files, or write to a file")
}
