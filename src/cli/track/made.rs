//! Files that are written, with their provenance beside them, all or none.

use std::fs::File;
use std::io::{BufWriter, Seek as _, Write as _};
use std::path::Path;

use tempfile::SpooledTempFile;

use super::place::Place;
use crate::cli::draft::{self, Draft};
use crate::cli::files;
use crate::cli::finished::failure;
use crate::cli::provenance::{self, Verified};
use crate::machine::{Job, blake3_of};
use crate::source::Source;
use crate::track::{Target, Tracked};

/// Bytes that are kept in memory for standard output; more go to a temporary file.
const SPOOL_BYTES: usize = 16 << 20;

/// Writes everything to its place; what is for standard output is handed back.
pub(super) fn write(
    tracked: &Tracked,
    places: &[(&'static Target, Place)],
    source: &Source,
    job: &Job,
) -> anyhow::Result<Option<SpooledTempFile>> {
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
                stdout = Some(spool);
            }
            Place::File(path) => {
                let mut draft = Draft::new(path)?;
                let mut writer = BufWriter::new(draft.file());
                let written = (target.write)(tracked, &mut writer).and_then(|()| writer.flush());
                drop(writer);
                written.map_err(|error| files::cannot_write(path, &error))?;
                drafts.push(meta(&files::meta(path), draft.file(), target, source, job)?);
                drafts.push(draft);
            }
        }
    }
    draft::publish(drafts, || Ok(()))?;
    Ok(stdout)
}

/// The provenance of a file, as a draft.
fn meta(path: &Path, written: &mut File, target: &Target, source: &Source, job: &Job) -> anyhow::Result<Draft> {
    let mut meta = Draft::new(path)?;
    let done = written.rewind().and_then(|()| blake3_of(&mut *written)).and_then(|blake3| {
        let (target, blake3, verified) = (target.name, &blake3[..], Verified::No);
        let text =
            provenance::json(&provenance::Made { source, job, target, verified, blake3, cut: None, options: "" });
        meta.file().write_all(text.as_bytes())
    });
    done.map_err(|error| files::cannot_write(path, &error))?;
    Ok(meta)
}
