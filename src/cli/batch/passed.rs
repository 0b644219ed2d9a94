//! Note on files in folders that a batch skips, so that no marker is missed by mistake.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use super::inputs::{extensions, files_in, is_cutter_file};
use super::manifest::is_manifest;
use crate::cli::files::{is_meta, meta};
use crate::cli::finished::Console;
use crate::cli::options::counted;

/// File extension of outdated programs.
const STALE: &str = "stale";

/// Prints the note of [`passed_over`] on standard error.
pub(in crate::cli) fn tell_passed_over(arguments: &[PathBuf], console: &mut Console) {
    // Ignore errors on standard error: the reader has closed it.
    let _ = console.err.write_all(passed_over(arguments).as_bytes());
}

/// Note on the files in folders that do not have the extension of a cutter file; empty if there are none. Programs written by
/// `cutc` and the files beside them are not mentioned.
fn passed_over(arguments: &[PathBuf]) -> String {
    let folders = arguments.iter().filter(|argument| argument.is_dir());
    let mut counts: BTreeMap<String, usize> = BTreeMap::new();
    for input in folders.flat_map(|folder| files_in(folder)).filter(|input| is_foreign(&input.path)) {
        let extension = input.path.extension().map(|extension| extension.to_string_lossy().to_ascii_lowercase());
        let kind = extension.map_or_else(|| "without an extension".to_owned(), |extension| format!(".{extension}"));
        *counts.entry(kind).or_default() += 1;
    }
    if counts.is_empty() {
        return String::new();
    }
    let total = counted(counts.values().sum(), "file");
    let kinds: Vec<String> = counts.iter().map(|(kind, count)| format!("{count} {kind}")).collect();
    format!(
        "note: {total} passed over in folders: {}\n  = hint: cutter files in folders are told by {}; name others by a pattern\n",
        kinds.join(", "),
        extensions()
    )
}

/// True if a file is neither a cutter file nor the output of a compile.
fn is_foreign(path: &Path) -> bool {
    let is_stale = path.extension().is_some_and(|extension| extension == STALE);
    path.is_file() && !is_cutter_file(path) && !is_meta(path) && !is_manifest(path) && !is_stale && !meta(path).exists()
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;

    #[test]
    fn a_folder_says_what_it_passes_over_but_for_programs() {
        let room = tempfile::tempdir().expect("a directory");
        let put =
            |names: &[&str]| names.iter().for_each(|name| fs::write(room.path().join(name), "").expect("writable"));
        put(&["a.cut", "p.ngc", "p.ngc.meta.json", "q.ngc.stale", "cutc.jsonl", "cutc.3-of-16.jsonl"]);
        let folder = room.path().to_owned();
        assert_eq!(passed_over(std::slice::from_ref(&folder)), "");
        put(&["b.pdf", "c.PDF", "order"]);
        let said = passed_over(std::slice::from_ref(&folder));
        assert!(said.starts_with("note: 3 files passed over in folders: 2 .pdf, 1 without an extension\n"), "{said}");
        assert!(said.contains(".cut"), "{said}");
        assert_eq!(passed_over(&[folder.join("b.pdf")]), "", "a file that is named is worked on");
    }
}
