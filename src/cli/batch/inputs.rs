//! Input files of a command line with files, folders and patterns.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use fast_glob::glob_match;
use walkdir::{DirEntry, WalkDir};

use crate::back::{Proof, TARGETS};
use crate::cli::files::{STDIN, is_dash, is_meta, is_plan, meta};
use crate::cli::finished::failure;
use crate::cli::provenance;
use crate::front::DIALECTS;
use crate::machines::flow::PLAN;

/// Characters that make a name a pattern.
const PATTERN: [char; 4] = ['*', '?', '[', '{'];

/// An input file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(in crate::cli) struct Input {
    /// Its path.
    pub(in crate::cli) path: PathBuf,
    /// Its path below its folder or pattern; otherwise its name.
    pub(in crate::cli) name: PathBuf,
}

impl Input {
    /// An input that is named itself.
    pub(in crate::cli) fn named(path: &Path) -> Self {
        let name =
            if is_dash(path) { STDIN.into() } else { path.file_name().map_or_else(|| path.to_owned(), PathBuf::from) };
        Self { path: path.to_owned(), name }
    }

    /// Its size in bytes, as far as the file system knows.
    pub(in crate::cli) fn size(&self) -> u64 {
        self.path.metadata().map_or(0, |known| known.len())
    }

    /// Its name in manifests, equal on every system.
    pub(in crate::cli) fn key(&self) -> String {
        let parts: Vec<_> = self.name.iter().map(|part| part.to_string_lossy()).collect();
        parts.join("/")
    }
}

/// Inputs of a command line.
#[derive(Debug)]
pub(in crate::cli) enum Inputs {
    /// One file by name: its messages are detailed.
    One(PathBuf),
    /// Files, folders or patterns.
    Many(Vec<Input>),
}

/// Filter for files in folders and by patterns.
#[derive(Clone, Copy)]
struct Sought<'a> {
    /// Test for a file in a folder.
    belongs: &'a dyn Fn(&Path) -> bool,
    /// Test for a file that a pattern names.
    may: &'a dyn Fn(&Path) -> bool,
    /// Advice when there are no files.
    hint: &'a str,
}

/// Finds the cutter files of some arguments. `belongs` is the test for files in folders. A pattern selects by name; programs of
/// `cutc` are excluded. A path that is neither there nor a pattern is kept, and opening it fails.
pub(in crate::cli) fn find(
    arguments: &[PathBuf],
    belongs: impl Fn(&Path) -> bool,
    hint: &str,
) -> anyhow::Result<Inputs> {
    let is_of_others = |path: &Path| !meta(path).exists();
    let belongs = |path: &Path| belongs(path) && is_of_others(path);
    find_sought(arguments, Sought { belongs: &belongs, may: &is_of_others, hint })
}

/// Finds the programs of some arguments. In folders these are files whose provenance names a target that is judged, or that
/// have no provenance and the extension of such a target. A pattern excludes only provenances and the output of other targets.
pub(in crate::cli) fn find_programs(arguments: &[PathBuf]) -> anyhow::Result<Inputs> {
    let is_judged = |path: &Path| if is_plan(path) { Some(true) } else { provenance::is_judged(path) };
    // The programs of heads are judged with the plan that names them.
    let is_of_plan = |path: &Path| path.with_file_name(PLAN).is_file() && !is_plan(path) && !meta(path).is_file();
    let belongs = |path: &Path| is_judged(path).unwrap_or_else(|| is_named_as_program(path) && !is_of_plan(path));
    let may = |path: &Path| is_judged(path) != Some(false) && !is_meta(path) && !is_of_plan(path);
    let hint = "programs are told by the `.meta.json` beside them; name others by a pattern, as in `'out/**/*.csv'`";
    find_sought(arguments, Sought { belongs: &belongs, may: &may, hint })
}

fn find_sought(arguments: &[PathBuf], sought: Sought) -> anyhow::Result<Inputs> {
    let Sought { belongs, may, hint } = sought;
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
            inputs.push(Input::named(argument));
        } else if argument.is_dir() {
            walk(argument, |path, _| belongs(path), &mut inputs);
        } else if let Some(Pattern { folder, names }) = pattern(argument).filter(|_| !argument.exists()) {
            walk(&folder, |path, name| glob_match(&names, &*name.to_string_lossy()) && may(path), &mut inputs);
        } else {
            inputs.push(Input::named(argument));
        }
        if inputs.len() == before {
            return Err(failure(format!("`{}` holds no files to work on", argument.display()), hint));
        }
    }
    for input in &mut inputs {
        // In the spelling of users: `./a.cut` is `a.cut`.
        if let Ok(path) = input.path.strip_prefix(".") {
            input.path = path.to_owned();
        }
    }
    // A file that is named twice, as by two patterns, is worked on once.
    let mut known = BTreeSet::new();
    inputs.retain(|input| known.insert(input.path.canonicalize().unwrap_or_else(|_| input.path.clone())));
    Ok(Inputs::Many(inputs))
}

/// True if a file in a folder is a program of a machine's motion, by its extension. A rewritten cutter file has the extension
/// of any other.
fn is_named_as_program(path: &Path) -> bool {
    let Some(extension) = path.extension() else { return false };
    let moves = |proof: Option<Proof>| match proof {
        Some(Proof::Setpoints | Proof::Positions) => true,
        Some(Proof::Marker) | None => false,
    };
    let mut known = TARGETS.iter().filter(|target| moves(target.proof)).map(|target| target.extension);
    known.any(|known| extension.eq_ignore_ascii_case(known))
}

/// True if a file in a folder is a cutter file, by its extension.
pub(in crate::cli) fn is_cutter_file(path: &Path) -> bool {
    let extension = path.extension().map(|extension| extension.to_string_lossy().into_owned()).unwrap_or_default();
    let mut known = DIALECTS.iter().flat_map(|dialect| dialect.extensions);
    known.any(|known| known.eq_ignore_ascii_case(&extension))
}

/// Extensions of cutter files in folders.
pub(in crate::cli) fn extensions() -> String {
    let mut known: Vec<&str> = Vec::new();
    for extension in DIALECTS.iter().flat_map(|dialect| dialect.extensions) {
        if !known.contains(extension) {
            known.push(extension);
        }
    }
    known.iter().map(|extension| format!(".{extension}")).collect::<Vec<_>>().join(" ")
}

/// Advice when a folder has no cutter files.
pub(in crate::cli) fn hint() -> String {
    format!("cutter files are told by {}; name others by a pattern, as in `'in/**/*.001'`", extensions())
}

/// Files below a folder, as found by a pattern that fits all names; there may be none.
pub(in crate::cli) fn files_in(folder: &Path) -> Vec<Input> {
    let mut inputs = Vec::new();
    walk(folder, |_, _| true, &mut inputs);
    inputs
}

/// Files below a folder without hidden ones, sorted by name within each folder. Unreadable entries are included: opening them
/// tells the reason.
fn walk(folder: &Path, is_meant: impl Fn(&Path, &Path) -> bool, inputs: &mut Vec<Input>) {
    let is_seen = |entry: &DirEntry| entry.depth() == 0 || !entry.file_name().to_string_lossy().starts_with('.');
    for entry in WalkDir::new(folder).follow_links(true).sort_by_file_name().into_iter().filter_entry(is_seen) {
        let (path, is_file) = match &entry {
            Ok(entry) => (entry.path(), entry.file_type().is_file()),
            // An unreadable folder, or a dangling link.
            Err(error) => (error.path().unwrap_or(folder), true),
        };
        let name = path.strip_prefix(folder).unwrap_or(path);
        if is_file && (path.is_dir() || is_meant(path, name)) {
            inputs.push(Input { path: path.to_owned(), name: name.to_owned() });
        }
    }
}

/// A pattern of names below a folder.
struct Pattern {
    folder: PathBuf,
    names: String,
}

/// The pattern in a path; `None` when it has none.
fn pattern(path: &Path) -> Option<Pattern> {
    let mut folder = PathBuf::new();
    for part in path.components() {
        let next = folder.join(part);
        // A folder may have such characters in its name.
        if part.as_os_str().to_string_lossy().contains(PATTERN) && !next.is_dir() {
            break;
        }
        folder = next;
    }
    let rest = path.strip_prefix(&folder).ok().filter(|rest| !rest.as_os_str().is_empty())?;
    let folder = if folder.as_os_str().is_empty() { PathBuf::from(".") } else { folder };
    Some(Pattern { folder, names: rest.to_string_lossy().into_owned() })
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
    fn programs_are_told_by_what_they_were_made_by() {
        let room = tempfile::tempdir().expect("a directory");
        let made = [("a.csv", "csv"), ("b.svg", "svg"), ("c.ngc", "gcode"), ("d.txt", "no-target")];
        for (name, target) in made {
            fs::write(room.path().join(name), "").expect("writable");
            let provenance = format!("{{\"target\": \"{target}\"}}");
            fs::write(meta(&room.path().join(name)), provenance).expect("writable");
        }
        fs::write(room.path().join("e.csv"), "").expect("writable");
        let found = |argument: &str| match find_programs(&[room.path().join(argument)]).expect("readable") {
            Inputs::One(path) => panic!("{}", path.display()),
            Inputs::Many(inputs) => inputs.iter().map(Input::key).collect::<Vec<_>>(),
        };
        fs::write(room.path().join("f.cut"), "").expect("writable");
        assert_eq!(found(""), ["a.csv", "c.ngc", "e.csv"]);
        assert_eq!(found("*.csv"), ["a.csv", "e.csv"]);
        assert!(find_programs(&[room.path().join("*.svg")]).expect_err("pictures").to_string().contains(".meta.json"));
    }

    #[test]
    fn a_place_without_cutter_files_is_a_mistake() {
        let room = tempfile::tempdir().expect("a directory");
        let of = |argument: &str| find(&[room.path().join(argument)], is_cutter_file, &hint());
        assert!(of("").expect_err("refused").to_string().contains(".cut"));
        assert!(of("*.cut").expect_err("refused").to_string().contains("no files"));
        assert!(of("[.cut").expect_err("refused").to_string().contains("no files"));
    }
}
