//! Programs of an earlier plan: a head that is not in the new plan must not be run with its old program.

use std::fs;
use std::path::{Path, PathBuf};

use crate::cli::files;
use crate::cli::finished::say;
use crate::machines::Part;
use crate::machines::flow::{PLAN, files_of};

/// Moves plan and programs of an earlier plan in a folder aside, except for `kept` names, and returns a message.
pub(super) fn move_aside(folder: &Path, kept: &[PathBuf]) -> String {
    let plan = folder.join(PLAN);
    // A plan without its provenance beside it is not from `cutc`.
    if !files::meta(&plan).is_file() {
        return String::new();
    }
    let mut said = String::new();
    for Part { name, .. } in files_of(&fs::read(&plan).unwrap_or_default()) {
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
