//! Files that are written, with their provenance beside them, all or none.

use std::fs::File;
use std::io::{BufWriter, Seek as _, Write as _};
use std::path::Path;

use serde::Serialize;
use tempfile::SpooledTempFile;

use super::place::Place;
use crate::cli::draft::{self, Draft};
use crate::cli::files;
use crate::cli::finished::failure;
use crate::cli::report::pretty;
use crate::machine::{Job, blake3_of, sha256_hex};
use crate::source::Source;
use crate::track::{Target, Tracked};

/// Bytes that are kept in memory for standard output; more go to a temporary file.
const SPOOL_BYTES: usize = 16 << 20;

/// Everything that made a file. No date and no path: the same input gives the same bytes.
#[derive(Serialize)]
struct Provenance<'a> {
    version: &'static str,
    source: String,
    source_sha256: String,
    profile: &'a str,
    profile_sha256: String,
    target: &'a str,
    program_blake3: &'a str,
}

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
    let name = Path::new(source.name()).file_name().map(|name| name.to_string_lossy().into_owned());
    let done = written.rewind().and_then(|()| blake3_of(&mut *written)).and_then(|blake3| {
        let text = pretty(&Provenance {
            version: env!("CARGO_PKG_VERSION"),
            source: name.unwrap_or_else(|| source.name().to_owned()),
            source_sha256: sha256_hex(source.bytes()),
            profile: job.origin.name(),
            profile_sha256: job.profile.digest(),
            target: target.name,
            program_blake3: &blake3,
        });
        meta.file().write_all(text.as_bytes())
    });
    done.map_err(|error| files::cannot_write(path, &error))?;
    Ok(meta)
}
