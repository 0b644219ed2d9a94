//! Files: reading an input, files beside a program, and faults of both.

use std::fs;
use std::io::{self, Read as _};
use std::path::{MAIN_SEPARATOR, Path, PathBuf};

use super::finished::{failure, say};
use crate::machines::flow::PLAN;
use crate::source::Source;
use crate::units::number::up;

/// Name for standard input and output.
const DASH: &str = "-";
/// Name of standard input in messages.
pub(super) const STDIN: &str = "stdin";

/// True if a path means standard input or output.
pub(super) fn is_dash(path: &Path) -> bool {
    path == Path::new(DASH)
}

/// Reads an input whole; `-` is standard input.
pub(super) fn read(path: &Path) -> anyhow::Result<Source> {
    if is_dash(path) {
        return read_stdin();
    }
    let name = path.display().to_string();
    if path.is_dir() {
        return Err(failure(
            format!("`{name}` is a directory"),
            format!(
                "name the file in it that you mean: `{}{MAIN_SEPARATOR}...`",
                name.trim_end_matches(MAIN_SEPARATOR)
            ),
        ));
    }
    let bytes = fs::read(path).map_err(|error| {
        let hint = match error.kind() {
            io::ErrorKind::NotFound => "check the spelling and the current directory",
            io::ErrorKind::PermissionDenied => "ask its owner for permission to read it, or copy it",
            _ => "check the disk or the network drive that it is on",
        };
        failure(format!("cannot read `{name}`: {}", reason(&error)), hint)
    })?;
    sized(&name, bytes)
}

fn read_stdin() -> anyhow::Result<Source> {
    let mut bytes = Vec::new();
    io::stdin()
        .lock()
        .read_to_end(&mut bytes)
        .map_err(|error| failure(format!("cannot read standard input: {error}"), "pipe a file into it, or name one"))?;
    sized(STDIN, bytes)
}

fn sized(name: &str, bytes: Vec<u8>) -> anyhow::Result<Source> {
    Source::new(name, bytes)
        .map_err(|error| failure(format!("cannot read `{name}`: {error}"), "split the marker into several files"))
}

/// Size from which a program is large, bytes: its size is reported with its name.
const LARGE: u64 = 100_000_000;
/// Size from which a program is reported even with `--quiet`, bytes.
const HUGE: u64 = 1_000_000_000;

/// Message about a written program; with `--quiet` only if it is huge.
pub(super) fn wrote(path: &Path, is_quiet: bool) -> Option<String> {
    let bytes = fs::metadata(path).map_or(0, |metadata| metadata.len());
    wrote_so_much(&path.display().to_string(), bytes, is_quiet)
}

fn wrote_so_much(name: &str, bytes: u64, is_quiet: bool) -> Option<String> {
    let size = if bytes >= LARGE { format!(", {} GB", up(bytes as f64 / HUGE as f64, 1)) } else { String::new() };
    (!is_quiet || bytes >= HUGE).then(|| format!("wrote `{name}`{size}"))
}

/// Opens a program to judge it, from its start.
pub(super) fn open(path: &Path) -> anyhow::Result<fs::File> {
    let name = path.display();
    let cannot = |error: io::Error| {
        failure(
            format!("cannot read `{name}`: {}", reason(&error)),
            "name a program that was compiled to a file, as `cutc compile marker.cut` does",
        )
    };
    if is_dash(path) {
        return Err(failure("a program is not judged from standard input", "write it to a file first"));
    }
    // Checked first: opening a pipe would wait for its writer.
    if !fs::metadata(path).map_err(cannot)?.is_file() {
        let message = format!("`{name}` is not a regular file");
        return Err(failure(message, "write the program to a file first"));
    }
    fs::File::open(path).map_err(cannot)
}

/// Reason of an error, in plain words where the system's are cryptic.
pub(super) fn reason(error: &io::Error) -> String {
    match error.kind() {
        io::ErrorKind::NotFound => "there is no such file".to_owned(),
        io::ErrorKind::PermissionDenied => "permission denied".to_owned(),
        io::ErrorKind::ReadOnlyFilesystem => "the disk is read-only".to_owned(),
        io::ErrorKind::StorageFull => "the disk is full".to_owned(),
        _ => error.to_string(),
    }
}

/// The directory of a file.
pub(super) fn directory(path: &Path) -> &Path {
    path.parent().filter(|parent| !parent.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

/// Path of a file from a folder, with `/` between its names; the whole path if they have nothing in common, `None` if either
/// does not exist.
pub(super) fn path_from(folder: &Path, file: &Path) -> Option<String> {
    let (folder, file) = (folder.canonicalize().ok()?, file.canonicalize().ok()?);
    let common = folder.components().zip(file.components()).take_while(|(a, b)| a == b).count();
    if common == 0 {
        return Some(file.to_string_lossy().into_owned());
    }
    let up = folder.components().skip(common).map(|_| "..".into());
    let down = file.components().skip(common).map(|name| name.as_os_str().to_string_lossy());
    Some(up.chain(down).collect::<Vec<_>>().join("/"))
}

/// Suffix of the name of a provenance.
const META: &str = ".meta.json";

fn with_end(path: &Path, end: &str) -> PathBuf {
    let mut name = path.as_os_str().to_owned();
    name.push(end);
    PathBuf::from(name)
}

/// Path of the provenance of a program.
pub(super) fn meta(program: &Path) -> PathBuf {
    with_end(program, META)
}

/// True if a file is a plan by its name.
pub(super) fn is_plan(path: &Path) -> bool {
    path.file_name().is_some_and(|name| name == PLAN)
}

/// True if a file is a provenance by its name.
pub(super) fn is_meta(path: &Path) -> bool {
    path.to_string_lossy().ends_with(META)
}

/// Path of an outdated program.
pub(super) fn stale(program: &Path) -> PathBuf {
    with_end(program, ".stale")
}

/// Error about a file that cannot be written.
pub(super) fn cannot_write(path: &Path, error: &io::Error) -> anyhow::Error {
    let hint = match error.kind() {
        io::ErrorKind::PermissionDenied | io::ErrorKind::ReadOnlyFilesystem => {
            "name a place where you may write, with -o FILE or -o DIRECTORY"
        }
        io::ErrorKind::StorageFull => "make room, or name another disk with -o",
        _ => "name another place with -o FILE or -o DIRECTORY",
    };
    failure(format!("cannot write `{}`: {}", path.display(), reason(error)), hint)
}

/// Moves an older program and its provenance aside, because the compile that should replace it failed, and returns a message. A
/// file without a provenance beside it is not from `cutc` and stays.
pub(super) fn move_aside(program: &Path) -> String {
    let mut said = String::new();
    if !meta(program).is_file() {
        return said;
    }
    for path in [program.to_owned(), meta(program)] {
        let aside = stale(&path);
        let moved = fs::rename(&path, &aside);
        let (path, aside) = (path.display(), aside.display());
        match moved {
            Ok(()) => say(&mut said, format_args!("`{path}` is of an earlier compile: moved to `{aside}`")),
            Err(error) if error.kind() == io::ErrorKind::NotFound => {}
            Err(error) => say(
                &mut said,
                format_args!(
                    "`{path}` is of an earlier compile and cannot be moved aside ({}): do not use it",
                    reason(&error)
                ),
            ),
        }
    }
    said
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_size_of_a_large_program_is_told_and_that_of_a_huge_one_to_everyone() {
        let told = |bytes, is_quiet| wrote_so_much("x.csv", bytes, is_quiet).unwrap_or_default();
        assert_eq!(told(99_999_999, false), "wrote `x.csv`");
        assert_eq!(told(100_000_000, false), "wrote `x.csv`, 0.1 GB");
        assert_eq!(told(999_999_999, true), "");
        assert_eq!(told(3_210_000_000, true), "wrote `x.csv`, 3.3 GB");
    }

    #[test]
    fn an_older_program_is_moved_aside_with_its_provenance() {
        let directory = tempfile::tempdir().expect("a directory");
        let path = directory.path().join("x.csv");
        assert_eq!(move_aside(&path), "");
        fs::write(&path, "old").expect("writable");
        fs::write(meta(&path), "{}").expect("writable");
        assert_eq!(move_aside(&path).lines().count(), 2);
        assert!(!path.exists() && !meta(&path).exists());
        assert!(stale(&path).exists() && stale(&meta(&path)).exists());
    }
}
