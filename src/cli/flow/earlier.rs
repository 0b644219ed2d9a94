//! Programs of an earlier plan: a head that the new one does not have must not be run with its old program.

use std::fs;
use std::path::{Path, PathBuf};

use crate::cli::files::{self, PLAN};
use crate::cli::finished::say;

/// Moves plan and programs of an earlier plan in a folder aside, but for those of some names, and says so.
pub(super) fn move_aside(folder: &Path, kept: &[PathBuf]) -> String {
    let plan = folder.join(PLAN);
    // A plan without its provenance beside it is not one of ours.
    if !files::meta(&plan).is_file() {
        return String::new();
    }
    let mut said = String::new();
    for name in programs(&plan) {
        let path = folder.join(name);
        if kept.contains(&path) || !path.is_file() {
            continue;
        }
        let aside = files::stale(&path);
        let (shown, to) = (path.display().to_string(), aside.display().to_string());
        match fs::rename(&path, &aside) {
            Ok(()) => say(&mut said, format_args!("`{shown}` is of an earlier plan: moved to `{to}`")),
            Err(error) => say(
                &mut said,
                format_args!(
                    "`{shown}` is of an earlier plan and cannot be moved aside ({}): do not use it",
                    files::reason(&error)
                ),
            ),
        }
    }
    if kept.is_empty() {
        said.push_str(&files::move_aside(&plan));
    }
    said
}

/// The files that a plan names in its folder.
fn programs(plan: &Path) -> Vec<String> {
    let text = fs::read(plan).unwrap_or_default();
    let plan: serde_json::Value = serde_json::from_slice(&text).unwrap_or_default();
    let heads = plan["heads"].as_array().into_iter().flatten();
    let files = heads.flat_map(|head| head["files"].as_array().into_iter().flatten());
    let files = files.chain(plan["pictures"].as_array().into_iter().flatten());
    let names = files.filter_map(|file| file["file"].as_str());
    names.filter(|name| is_plain(name)).map(str::to_owned).collect()
}

/// Whether a name is that of a file in the folder of its plan, and in none beside it.
pub(super) fn is_plain(name: &str) -> bool {
    Path::new(name).file_name().is_some_and(|own| own == name)
}
