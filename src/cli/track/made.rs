//! Files that are written, with their provenance beside them, all or none.

use std::fs::File;
use std::io::{BufReader, BufWriter, Read, Seek, Write as _};
use std::path::Path;

use tempfile::SpooledTempFile;

use super::place::Place;
use crate::cli::draft::{self, Draft};
use crate::cli::files;
use crate::cli::finished::failure;
use crate::cli::provenance::{self, Verified};
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::machine::{Job, blake3_of};
use crate::source::Source;
use crate::track::{Target, Tracked, verify};

/// Bytes that are kept in memory for standard output; more go to a temporary file.
const SPOOL_BYTES: usize = 16 << 20;

/// What is written of a log, and what it is made of.
pub(super) struct Made<'a> {
    pub(super) tracked: &'a Tracked,
    pub(super) places: &'a [(&'static Target, Place)],
    pub(super) source: &'a Source,
    pub(super) job: &'a Job,
}

impl Made<'_> {
    /// Writes everything to its place; what is for standard output is handed back. Nothing is written when commands, read back,
    /// break the law.
    pub(super) fn write(&self, out: &mut Diagnostics) -> anyhow::Result<Option<SpooledTempFile>> {
        let Self { tracked, places, .. } = *self;
        let mut stdout = None;
        let mut drafts = Vec::new();
        for (target, place) in places {
            match place {
                Place::Stdout => {
                    let mut spool = SpooledTempFile::new(SPOOL_BYTES);
                    (target.write)(tracked, &mut spool).map_err(|error| {
                        let hint = "make room for temporary files, or write to a file";
                        failure(format!("cannot spool what is written: {error}"), hint)
                    })?;
                    self.judge(target, &mut spool, out)?;
                    stdout = Some(spool);
                }
                Place::File(path) => {
                    let mut draft = Draft::new(path)?;
                    let mut writer = BufWriter::new(draft.file());
                    let written = (target.write)(tracked, &mut writer).and_then(|()| writer.flush());
                    drop(writer);
                    written.map_err(|error| files::cannot_write(path, &error))?;
                    self.judge(target, draft.file(), out)?;
                    drafts.push(self.meta(&files::meta(path), draft.file(), target)?);
                    drafts.push(draft);
                }
            }
        }
        if !out.has_errors() {
            draft::publish(drafts, || Ok(()))?;
        }
        Ok(stdout)
    }

    /// Reads commands back and holds them against the readings.
    fn judge(&self, target: &Target, written: &mut (impl Read + Seek), out: &mut Diagnostics) -> anyhow::Result<()> {
        if !target.is_judged {
            return Ok(());
        }
        let read = written.rewind().and_then(|()| {
            let rows = &self.tracked.replay.rows;
            verify::commands(&mut BufReader::new(&mut *written), rows, &self.job.profile.track)
        });
        let wrong = read.map_err(|error| {
            failure(format!("the commands cannot be read back: {}", files::reason(&error)), "the disk may fail")
        })?;
        if let Some(wrong) = wrong {
            out.push(Diagnostic::new(&code::TRACK_BROKEN, format!("the commands, read back, break the law: {wrong}")));
        }
        written
            .rewind()
            .map_err(|error| failure(format!("cannot read back: {}", files::reason(&error)), "the disk may fail"))?;
        Ok(())
    }

    /// The provenance of a file, as a draft.
    fn meta(&self, path: &Path, written: &mut File, target: &Target) -> anyhow::Result<Draft> {
        let Self { source, job, .. } = *self;
        let mut meta = Draft::new(path)?;
        let done = written.rewind().and_then(|()| blake3_of(&mut *written)).and_then(|blake3| {
            let verified = if target.is_judged { Verified::Yes } else { Verified::No };
            let (target, blake3) = (target.name, &blake3[..]);
            let made = provenance::Made { beside: path, source, job, target, verified, blake3, cut: None, options: "" };
            let text = provenance::json(&made);
            meta.file().write_all(text.as_bytes())
        });
        done.map_err(|error| files::cannot_write(path, &error))?;
        Ok(meta)
    }
}
