//! The files that are meant by files, folders and patterns on a command line.

use std::collections::BTreeSet;
use std::path::{Component, Path, PathBuf};

use globset::{GlobBuilder, GlobMatcher};
use walkdir::{DirEntry, WalkDir};

use crate::cli::failure;
use crate::cli::files::{STDIN, is_dash, meta};
use crate::front::DIALECTS;

/// What makes a name a pattern.
const PATTERN: [char; 4] = ['*', '?', '[', '{'];

/// A file to work on.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(in crate::cli) struct Input {
    /// Where it is.
    pub(in crate::cli) path: PathBuf,
    /// Its path below the folder or pattern that it was found by; else its name.
    pub(in crate::cli) name: PathBuf,
}

impl Input {
    /// Its bytes, as far as the file system knows.
    pub(in crate::cli) fn size(&self) -> u64 {
        self.path.metadata().map_or(0, |known| known.len())
    }

    /// Its name as manifests have it, the same on every system.
    pub(in crate::cli) fn key(&self) -> String {
        let parts: Vec<_> = self.name.iter().map(|part| part.to_string_lossy()).collect();
        parts.join("/")
    }
}

/// What a command line names.
#[derive(Debug)]
pub(in crate::cli) enum Inputs {
    /// One file, as such: what is said of it is said at length.
    One(PathBuf),
    /// Files, folders or patterns.
    Many(Vec<Input>),
}

/// Finds what some arguments mean. `belongs` tells which files in folders are meant; a pattern names them itself. What is
/// neither there nor a pattern is left for whoever opens it.
pub(in crate::cli) fn find(
    arguments: &[PathBuf],
    belongs: impl Fn(&Path) -> bool,
    hint: &str,
) -> anyhow::Result<Inputs> {
    if let [one] = arguments
        && !one.is_dir()
        && (one.exists() || pattern(one).is_none())
    {
        return Ok(Inputs::One(one.clone()));
    }
    let mut inputs = Vec::new();
    for argument in arguments {
        let before = inputs.len();
        if is_dash(argument) {
            inputs.push(Input { path: argument.clone(), name: STDIN.into() });
        } else if argument.is_dir() {
            walk(argument, |path, _| belongs(path), &mut inputs)?;
        } else if let Some(pattern) = pattern(argument).filter(|_| !argument.exists()) {
            let Pattern { folder, matcher } = pattern?;
            walk(&folder, |_, name| matcher.is_match(name), &mut inputs)?;
        } else {
            let name = argument.file_name().map_or_else(|| argument.clone(), PathBuf::from);
            inputs.push(Input { path: argument.clone(), name });
        }
        if inputs.len() == before {
            return Err(failure(format!("`{}` holds no files to work on", argument.display()), hint));
        }
    }
    // Named twice, as by two patterns, a file is meant once.
    let mut known = BTreeSet::new();
    inputs.retain(|input| known.insert(input.path.canonicalize().unwrap_or_else(|_| input.path.clone())));
    Ok(Inputs::Many(inputs))
}

/// Whether a file in a folder looks like a cutter file, by its extension.
pub(in crate::cli) fn is_cutter_file(path: &Path) -> bool {
    let extension = path.extension().map(|extension| extension.to_string_lossy().into_owned()).unwrap_or_default();
    let mut known = DIALECTS.iter().flat_map(|dialect| dialect.extensions);
    known.any(|known| known.eq_ignore_ascii_case(&extension))
}

/// The extensions by which cutter files in folders are told.
pub(in crate::cli) fn extensions() -> String {
    let known: Vec<_> = DIALECTS.iter().flat_map(|dialect| dialect.extensions).map(|e| format!(".{e}")).collect();
    known.join(" ")
}

/// What to do when a folder has no cutter files.
pub(in crate::cli) fn hint() -> String {
    format!("cutter files are told by {}; name others by a pattern, as in `'in/**/*.001'`", extensions())
}

/// The files below a folder, as a pattern that all names fit would find them; none is no mistake.
pub(in crate::cli) fn files_in(folder: &Path) -> anyhow::Result<Vec<Input>> {
    let mut inputs = Vec::new();
    walk(folder, |_, _| true, &mut inputs)?;
    Ok(inputs)
}

/// The files below a folder, each folder's in the order of their names; neither hidden ones nor programs of ours.
fn walk(folder: &Path, is_meant: impl Fn(&Path, &Path) -> bool, inputs: &mut Vec<Input>) -> anyhow::Result<()> {
    let is_seen = |entry: &DirEntry| entry.depth() == 0 || !entry.file_name().to_string_lossy().starts_with('.');
    for entry in WalkDir::new(folder).follow_links(true).sort_by_file_name().into_iter().filter_entry(is_seen) {
        let entry = entry.map_err(|error| {
            failure(format!("cannot look through `{}`: {error}", folder.display()), "name folders that you may read")
        })?;
        let path = entry.path();
        let name = path.strip_prefix(folder).unwrap_or(path);
        if entry.file_type().is_file() && is_meant(path, name) && !meta(path).exists() {
            // Written as its user would: `./a.cut` is `a.cut`.
            let path = path.strip_prefix(".").unwrap_or(path);
            inputs.push(Input { path: path.to_owned(), name: name.to_owned() });
        }
    }
    Ok(())
}

/// A pattern of names below a folder.
struct Pattern {
    folder: PathBuf,
    matcher: GlobMatcher,
}

/// What a path means as a pattern; `None` when it is none.
fn pattern(path: &Path) -> Option<anyhow::Result<Pattern>> {
    let is_plain = |part: &Component| !part.as_os_str().to_string_lossy().contains(PATTERN);
    let folder: PathBuf = path.components().take_while(is_plain).collect();
    let rest = path.strip_prefix(&folder).ok().filter(|rest| !rest.as_os_str().is_empty())?;
    let folder = if folder.as_os_str().is_empty() { PathBuf::from(".") } else { folder };
    let glob = GlobBuilder::new(&rest.to_string_lossy()).literal_separator(true).build();
    Some(glob.map(|glob| Pattern { folder, matcher: glob.compile_matcher() }).map_err(|error| {
        failure(format!("`{}` is no pattern: {}", path.display(), error.kind()), "quote it, as in `'in/**/*.cut'`")
    }))
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;

    /// A folder with some files, and what arguments below it find: paths and names.
    fn found(arguments: &[&str]) -> Vec<(String, String)> {
        let room = tempfile::tempdir().expect("a directory");
        for path in ["in/b.cut", "in/a.PLT", "in/sub/a.cut", "in/.c.cut", "in/d.pdf", "in/p.csv", "in/p.csv.meta.json"]
        {
            let path = room.path().join(path);
            fs::create_dir_all(path.parent().expect("a folder")).expect("writable");
            fs::write(path, "").expect("writable");
        }
        let arguments: Vec<_> = arguments.iter().map(|argument| room.path().join(argument)).collect();
        match find(&arguments, is_cutter_file, "").expect("readable") {
            Inputs::One(path) => vec![(path.file_name().expect("a name").to_string_lossy().into_owned(), "one".into())],
            Inputs::Many(inputs) => {
                let told = |input: &Input| {
                    let path = input.path.strip_prefix(room.path()).expect("below the room");
                    (path.display().to_string(), input.key())
                };
                inputs.iter().map(told).collect()
            }
        }
    }

    fn check(arguments: &[&str], expected: &[(&str, &str)]) {
        let expected: Vec<_> = expected.iter().map(|(path, name)| ((*path).to_owned(), (*name).to_owned())).collect();
        assert_eq!(found(arguments), expected, "{arguments:?}");
    }

    #[test]
    fn folders_files_and_patterns_are_told_apart() {
        let all = [("in/a.PLT", "a.PLT"), ("in/b.cut", "b.cut"), ("in/sub/a.cut", "sub/a.cut")];
        check(&["in"], &all);
        check(&["in/**/*.{cut,PLT}"], &all);
        check(&["in/*.cut"], &all[1..2]);
        check(&["in/b.cut"], &[("b.cut", "one")]);
        check(&["in/none.cut"], &[("none.cut", "one")]);
        check(&["in/b.cut", "in/sub/a.cut"], &[("in/b.cut", "b.cut"), ("in/sub/a.cut", "a.cut")]);
        check(&["in/b.cut", "in", "in/../in/b.cut"], &[("in/b.cut", "b.cut"), all[0], all[2]]);
    }

    #[test]
    fn a_place_without_cutter_files_is_a_mistake() {
        let room = tempfile::tempdir().expect("a directory");
        let of = |argument: &str| find(&[room.path().join(argument)], is_cutter_file, &hint());
        assert!(of("").expect_err("refused").to_string().contains(".cut"));
        assert!(of("*.cut").expect_err("refused").to_string().contains("no files"));
        assert!(of("[.cut").expect_err("refused").to_string().contains("is no pattern"));
    }
}
