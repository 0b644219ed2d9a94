//! Check for programs of a batch that would overwrite each other.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use super::inputs::Input;
use crate::cli::finished::failure;

/// Maximum number of collisions to list; the rest are counted.
const MOST_TOLD: usize = 10;

/// Refuses a batch in which two programs would be written to one place, or a program over an input.
pub(in crate::cli) fn refuse_collisions(inputs: &[Input], places: &[Vec<PathBuf>]) -> anyhow::Result<()> {
    let mut wanted: BTreeMap<&Path, Vec<&Input>> = BTreeMap::new();
    for (input, paths) in inputs.iter().zip(places) {
        for path in paths {
            wanted.entry(path).or_default().push(input);
        }
    }
    let known: BTreeMap<_, _> =
        inputs.iter().filter_map(|input| Some((input.path.canonicalize().ok()?, input))).collect();
    let mut told = Vec::new();
    for (path, of) in wanted {
        let names: Vec<_> = of.iter().map(|input| format!("`{}`", input.path.display())).collect();
        if names.len() > 1 {
            told.push(format!("`{}` would be written for {}", path.display(), names.join(" and ")));
        }
        if let Some(over) = path.canonicalize().ok().and_then(|path| known.get(&path)) {
            told.push(format!("`{}` is an input: it is never overwritten for {}", over.path.display(), names[0]));
        }
    }
    if told.is_empty() {
        return Ok(());
    }
    let more = told.len().saturating_sub(MOST_TOLD);
    told.truncate(MOST_TOLD);
    if more > 0 {
        told.push(format!("and {more} more"));
    }
    Err(failure(
        format!("nothing was written, because programs would collide:\n  {}", told.join("\n  ")),
        "name the folder that holds them all, whose structure is kept below -o, or choose some by a pattern, as in \
         `'in/**/*.cut'`",
    ))
}
