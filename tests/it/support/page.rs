//! Code blocks of the manual, and what folders hold.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use cutc::manual::PAGES;

/// A page of the manual.
pub(crate) fn page(name: &str) -> &'static str {
    PAGES.iter().find(|page| page.name == name).unwrap_or_else(|| panic!("there is a page `{name}`")).text
}

/// The code blocks of a language in a page, as they stand there.
pub(crate) fn blocks(text: &str, language: &str) -> Vec<String> {
    let fence = format!("\n```{language}\n");
    text.split(&fence).skip(1).map(|rest| rest.split("```").next().unwrap_or_default().to_owned()).collect()
}

/// What stands below a heading of a page.
pub(crate) fn section<'t>(text: &'t str, heading: &str) -> &'t str {
    let section = text.split_once(&format!("\n## {heading}\n")).unwrap_or_else(|| panic!("no heading `{heading}`")).1;
    section.split("\n## ").next().unwrap_or_default()
}

/// The lines of a page's indented blocks that are commands of ours, without their comments.
pub(crate) fn commands(text: &str) -> Vec<String> {
    // What is between fences is no line of its own.
    let outside = text.split("\n```").step_by(2);
    let lines = outside.flat_map(str::lines).filter_map(|line| line.strip_prefix("    "));
    let commands = lines.filter(|line| line.starts_with("cutc "));
    commands.map(|line| line.split('#').next().unwrap_or(line).trim().to_owned()).collect()
}

/// Every file below a folder.
pub(crate) fn tree(folder: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let mut files = BTreeMap::new();
    let mut folders = vec![folder.to_owned()];
    while let Some(at) = folders.pop() {
        for entry in fs::read_dir(&at).expect("a folder") {
            let path = entry.expect("readable").path();
            if path.is_dir() {
                folders.push(path);
            } else {
                let name = path.strip_prefix(folder).expect("below the folder").to_owned();
                files.insert(name, fs::read(&path).expect("readable"));
            }
        }
    }
    files
}

/// Expects that two folders hold the same files, byte for byte.
pub(crate) fn expect_same(found: &Path, expected: &Path) {
    let [found, expected] = [found, expected].map(tree);
    assert_eq!(found.keys().collect::<Vec<_>>(), expected.keys().collect::<Vec<_>>());
    let differ: Vec<_> =
        found.iter().filter(|(name, bytes)| expected[*name] != **bytes).map(|(name, _)| name).collect();
    assert!(differ.is_empty(), "other bytes than of a single run: {differ:?}");
}

/// The folder of our program before those where programs are looked for, and another before that.
pub(crate) fn search_path(first: &Path) -> String {
    let binary = Path::new(env!("CARGO_BIN_EXE_cutc")).parent().expect("a binary lies in a folder");
    format!("{}:{}:{}", first.display(), binary.display(), std::env::var("PATH").unwrap_or_default())
}
