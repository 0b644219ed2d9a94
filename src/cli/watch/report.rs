//! Report on a file of a hot folder that has no program: `NAME.report.txt`.

use std::fs;
use std::io::Write as _;
use std::path::{Path, PathBuf};

use crate::cli::draft::{self, Draft};
use crate::cli::files::cannot_write;

/// Path of the report on an input, from the name of the input below its folder.
pub(super) fn path(out: &Path, name: &Path) -> PathBuf {
    let mut path = out.join(name).into_os_string();
    path.push(".report.txt");
    path.into()
}

/// Writes a whole report.
pub(super) fn write(path: &Path, said: &str) -> anyhow::Result<()> {
    // Repeated attempts with the same report write it once.
    if fs::read(path).is_ok_and(|there| there == said.as_bytes()) {
        return Ok(());
    }
    let mut draft = Draft::new(path)?;
    draft.file().write_all(said.as_bytes()).map_err(|error| cannot_write(path, &error))?;
    draft::publish(vec![draft], || Ok(()))
}

/// Removes a report, if there is one.
pub(super) fn remove(path: &Path) {
    let _ = fs::remove_file(path); // there rarely is one
}
