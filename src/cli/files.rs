//! Files: reading an input, finding where a program goes, writing it whole or not at all.

use std::ffi::OsString;
use std::fs;
use std::io::{self, Read as _};
use std::path::{MAIN_SEPARATOR, Path, PathBuf};

use tempfile::NamedTempFile;

use super::{failure, say};
use crate::back::{TARGETS, Target};
use crate::source::Source;

/// What stands for standard input and output.
const DASH: &str = "-";
/// How messages name what was read from standard input.
const STDIN: &str = "stdin";

/// Whether a path means standard input or output.
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
    // Asked first: opening a pipe would wait for its writer.
    if !fs::metadata(path).map_err(cannot)?.is_file() {
        let message = format!("`{name}` is not a regular file");
        return Err(failure(message, "write the program to a file first"));
    }
    fs::File::open(path).map_err(cannot)
}

/// What went wrong, in plain words where the usual ones are cryptic.
fn reason(error: &io::Error) -> String {
    match error.kind() {
        io::ErrorKind::NotFound => "there is no such file".to_owned(),
        io::ErrorKind::PermissionDenied => "permission denied".to_owned(),
        io::ErrorKind::ReadOnlyFilesystem => "the disk is read-only".to_owned(),
        io::ErrorKind::StorageFull => "the disk is full".to_owned(),
        _ => error.to_string(),
    }
}

/// What a compile reads, and what the user said of where its programs go.
#[derive(Debug, Clone, Copy)]
pub(super) struct Asked<'a> {
    /// The place as typed.
    pub(super) out: Option<&'a Path>,
    /// The targets as typed; none = what the place says.
    pub(super) targets: &'a [&'static Target],
    /// The cutter file.
    pub(super) input: &'a Path,
    /// The machine profile.
    pub(super) profile: Option<&'a Path>,
}

/// The programs of a compile, and where they go.
#[derive(Debug, Clone)]
pub(super) struct Destination {
    /// What is written, at least one.
    pub(super) targets: Vec<&'static Target>,
    /// Where.
    pub(super) place: Place,
}

/// Where programs go.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum Place {
    /// Standard output.
    Stdout,
    /// Files, one for each target, with their `.meta.json` beside them.
    Files(Vec<PathBuf>),
}

impl Asked<'_> {
    /// Finds what is written and where: `out` as typed, a directory for `<stem>.<extension>`, or without it the current
    /// directory. Never over the input itself, nor the profile. Without a target the extension of `out` chooses it.
    pub(super) fn destination(self) -> anyhow::Result<Destination> {
        let targets = self.targets()?;
        let is_stdout = self.out.is_some_and(is_dash);
        if let Some(out) = self.out.filter(|out| targets.len() > 1 && (is_stdout || !names_directory(out))) {
            return Err(failure(
                format!("`-o {}` is one place for {} programs", out.display(), targets.len()),
                "name a directory, as in `-o out/`, or leave -o out: each gets a name of its own",
            ));
        }
        if is_stdout {
            return Ok(Destination { targets, place: Place::Stdout });
        }
        let paths: anyhow::Result<_> = targets.iter().map(|target| self.path(target)).collect();
        Ok(Destination { targets, place: Place::Files(paths?) })
    }

    /// What is written: what was typed, else what the extension of the place says, else the default.
    fn targets(&self) -> anyhow::Result<Vec<&'static Target>> {
        let extensions: Vec<&str> = self.targets.iter().map(|target| target.extension).collect();
        if let Some(twice) = extensions.iter().enumerate().find_map(|(i, e)| extensions[..i].contains(e).then_some(e)) {
            return Err(failure(
                format!("two of the targets would write the same file, of extension `{twice}`"),
                "name each target once",
            ));
        }
        let file = self.out.filter(|out| !is_dash(out) && !names_directory(out));
        let name = file.and_then(Path::file_name).map(|name| name.to_string_lossy().to_ascii_lowercase());
        let ends =
            |target: &&Target| name.as_ref().is_some_and(|name| name.ends_with(&format!(".{}", target.extension)));
        let told = TARGETS.iter().find(ends);
        match (self.targets, told, file) {
            ([one], Some(told), Some(file)) if one.extension != told.extension => Err(failure(
                format!(
                    "`-t {}` and `-o {}` disagree: the name is one of target {}",
                    one.name,
                    file.display(),
                    told.name
                ),
                format!("leave -t out, or write to `-o {}`", file.with_extension(one.extension).display()),
            )),
            ([], Some(told), _) => Ok(vec![told]),
            ([], None, Some(file)) if names_program(file) => Err(failure(
                format!("`-o {}` may be G-code or a cut file: its name does not say", file.display()),
                "say which with `-t gcode` or `-t iso`; alone `.ngc` is G-code here, `.iso` a cut file",
            )),
            ([], None, _) => Ok(vec![&TARGETS[0]]),
            (typed, _, _) => Ok(typed.to_vec()),
        }
    }

    /// The file of one program.
    fn path(&self, target: &Target) -> anyhow::Result<PathBuf> {
        let Self { out, input, profile, .. } = *self;
        let stem = if is_dash(input) { STDIN.as_ref() } else { input.file_stem().unwrap_or(input.as_os_str()) };
        let mut name = OsString::from(stem);
        name.push(format!(".{}", target.extension));
        let path = match out {
            None if is_dash(input) => {
                return Err(failure(
                    "a program that is made from standard input has no name",
                    "say where it goes with -o FILE, -o DIRECTORY or `-o -`",
                ));
            }
            None if input.file_name() == Some(&name) => {
                return Err(failure(
                    format!("the program would have the name of its input, `{}`", name.display()),
                    "say where it goes with -o FILE or -o DIRECTORY",
                ));
            }
            None => PathBuf::from(&name),
            Some(out) if names_directory(out) => out.join(&name),
            // A file of that name would surprise whoever meant a directory, and the other way round.
            Some(out) if out.extension().is_none() && !out.exists() => {
                let shown = out.display();
                return Err(failure(
                    format!("`-o {shown}` may be a file or a directory"),
                    format!("write `-o {shown}/` for a directory, which is made, or `-o {shown}.{}`", target.extension),
                ));
            }
            Some(out) => out.to_owned(),
        };
        let (shown, folder) = (path.display(), directory(&path));
        // A directory that is not there yet is made where another holds it.
        let is_made = || out.is_some_and(names_directory) && !folder.exists() && directory(folder).is_dir();
        if !folder.is_dir() && !is_made() {
            let message = format!("cannot write `{shown}`: there is no directory `{}`", folder.display());
            return Err(failure(message, "create it first, or name another one"));
        }
        if fs::metadata(&path).is_ok_and(|target| !target.is_file()) {
            return Err(failure(
                format!("`{shown}` is not a regular file"),
                "write to a file, or to a pipe with `-o -`",
            ));
        }
        let inputs = [Some(input).filter(|input| !is_dash(input)), profile];
        for made in [path.clone(), meta(&path), stale(&path), stale(&meta(&path))] {
            if let Some(read) = inputs.into_iter().flatten().find(|read| same_file(&made, read)) {
                let message = format!("`{}` is an input: it is never overwritten", read.display());
                return Err(failure(message, "give the program another name with -o"));
            }
        }
        Ok(path)
    }
}

/// Whether a path is a directory, or written as one.
fn names_directory(path: &Path) -> bool {
    path.is_dir() || path.as_os_str().to_string_lossy().ends_with(MAIN_SEPARATOR)
}

/// Whether a path has an extension that others give to programs of machines: setpoints must not come by such a name unseen.
fn names_program(path: &Path) -> bool {
    let extension = path.extension().map(|extension| extension.to_string_lossy().to_ascii_lowercase());
    matches!(extension.as_deref(), Some("nc" | "gcode" | "gco" | "tap" | "cnc" | "cut" | "gbr" | "ggt"))
}

/// A directory that was made for programs; it goes when it is still empty in the end.
#[derive(Debug)]
pub(super) struct MadeDirectory(PathBuf);

impl MadeDirectory {
    /// Makes the directory of a file; `None` when it is there.
    pub(super) fn of(path: &Path) -> anyhow::Result<Option<Self>> {
        let folder = directory(path);
        if folder.is_dir() {
            return Ok(None);
        }
        fs::create_dir(folder).map_err(|error| cannot_write(path, &error))?;
        Ok(Some(Self(folder.to_owned())))
    }
}

impl Drop for MadeDirectory {
    fn drop(&mut self) {
        // Only an empty one can be removed: that is what is meant.
        let _ = fs::remove_dir(&self.0);
    }
}

/// The directory of a file.
fn directory(path: &Path) -> &Path {
    path.parent().filter(|parent| !parent.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

fn same_file(a: &Path, b: &Path) -> bool {
    a.canonicalize().is_ok_and(|a| b.canonicalize().is_ok_and(|b| a == b))
}

fn with_end(path: &Path, end: &str) -> PathBuf {
    let mut name = path.as_os_str().to_owned();
    name.push(end);
    PathBuf::from(name)
}

/// Where the provenance of a program stands.
pub(super) fn meta(program: &Path) -> PathBuf {
    with_end(program, ".meta.json")
}

/// Where an outdated program goes.
fn stale(program: &Path) -> PathBuf {
    with_end(program, ".stale")
}

/// A file that is not there yet: written beside its place, and moved there when it is whole.
#[derive(Debug)]
pub(super) struct Draft {
    file: NamedTempFile,
    path: PathBuf,
}

impl Draft {
    /// Opens a draft of the file at `path`.
    pub(super) fn new(path: &Path) -> anyhow::Result<Self> {
        let mut builder = tempfile::Builder::new();
        builder.prefix(".cutc-").suffix(".tmp");
        #[cfg(unix)]
        {
            use std::os::unix::fs::PermissionsExt as _;
            // Readable to whom the umask lets it be, as any new file: a temporary one would be its owner's alone.
            builder.permissions(fs::Permissions::from_mode(0o666));
        }
        let file = builder.tempfile_in(directory(path)).map_err(|error| cannot_write(path, &error))?;
        Ok(Self { file, path: path.to_owned() })
    }

    /// The file to write to.
    pub(super) fn file(&mut self) -> &mut fs::File {
        self.file.as_file_mut()
    }

    /// Moves the whole file to its place, over what was there.
    pub(super) fn publish(self) -> anyhow::Result<()> {
        let Self { file, path } = self;
        file.as_file().sync_all().map_err(|error| cannot_write(&path, &error))?;
        file.persist(&path).map_err(|error| cannot_write(&path, &error.error))?;
        Ok(())
    }

    /// Moves the whole file to its place, where nothing may be.
    pub(super) fn publish_new(self) -> anyhow::Result<()> {
        let Self { file, path } = self;
        file.persist_noclobber(&path).map_err(|error| match error.error.kind() {
            io::ErrorKind::AlreadyExists => exists(&path),
            _ => cannot_write(&path, &error.error),
        })?;
        Ok(())
    }
}

fn exists(path: &Path) -> anyhow::Error {
    failure(format!("`{}` exists: it is not overwritten", path.display()), "give another name, or move it away first")
}

/// The error of a file that cannot be written.
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

/// Moves an older program and its provenance aside, because the compile that should replace it failed. Says so. A file
/// that has no provenance beside it is not one of ours and stays.
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
    use std::io::Write as _;

    use super::*;

    fn find(out: Option<&Path>, input: &Path) -> Result<Place, String> {
        let asked = Asked { out, targets: &[], input, profile: None };
        asked.destination().map(|found| found.place).map_err(|error| error.to_string())
    }

    #[test]
    fn a_program_takes_the_stem_of_its_input() {
        let directory = tempfile::tempdir().expect("a directory");
        let at = |name: &str| directory.path().join(name);
        let input = at("marker.one.cut");
        assert_eq!(find(None, &input), Ok(Place::Files(vec!["marker.one.csv".into()])));
        assert_eq!(find(Some(directory.path()), &input), Ok(Place::Files(vec![at("marker.one.csv")])));
        assert_eq!(find(Some(&at("x.txt")), &input), Ok(Place::Files(vec![at("x.txt")])));
        assert_eq!(find(Some(Path::new("-")), &input), Ok(Place::Stdout));
        assert_eq!(find(Some(directory.path()), Path::new("-")), Ok(Place::Files(vec![at("stdin.csv")])));
        assert!(find(None, Path::new("-")).expect_err("refused").contains("-o FILE"));
    }

    #[test]
    fn without_a_target_the_extension_chooses_it() {
        let written = |out: &str, targets: &[&'static Target]| {
            let asked = Asked { out: Some(Path::new(out)), targets, input: Path::new("a.cut"), profile: None };
            let found = asked.destination().map_err(|error| error.to_string())?;
            Ok::<_, String>(found.targets.iter().map(|target| target.name).collect::<Vec<_>>())
        };
        for target in TARGETS {
            assert_eq!(written(&format!("x.{}", target.extension), &[]), Ok(vec![target.name]));
            assert_eq!(written(&format!("x.{}", target.extension.to_uppercase()), &[]), Ok(vec![target.name]));
            assert_eq!(written("x.txt", &[target]), Ok(vec![target.name]));
        }
        assert_eq!(written("x.txt", &[]), Ok(vec![TARGETS[0].name]));
        assert!(written("x.NC", &[]).expect_err("refused").contains("-t gcode"));
        assert_eq!(written("x.nc", &[&TARGETS[1]]), Ok(vec![TARGETS[1].name]));
        let [first, second] = [&TARGETS[0], &TARGETS[1]];
        let refused = written(&format!("x.{}", second.extension), &[first]).expect_err("refused");
        assert!(refused.contains("disagree") && refused.contains("x.csv"), "{refused}");
        assert!(written("x.csv", &[first, second]).expect_err("refused").contains("one place for 2"));
        assert!(written("x", &[]).expect_err("refused").contains("`-o x/`"));
    }

    #[test]
    fn an_input_is_never_written() {
        let directory = tempfile::tempdir().expect("a directory");
        for name in ["x.csv", "y.csv.meta.json", "y.csv.stale", "y.csv.meta.json.stale"] {
            let input = directory.path().join(name);
            fs::write(&input, "x_mm,y_mm\n").expect("writable");
            let program = directory.path().join(".").join(if name == "x.csv" { "x.csv" } else { "y.csv" });
            assert!(find(Some(&program), &input).expect_err("refused").contains("is an input"), "{name}");
            fs::remove_file(&input).expect("removable");
        }
        assert!(find(None, &directory.path().join("x.csv")).expect_err("refused").contains("name of its input"));
    }

    #[test]
    fn places_that_cannot_be_written_are_named() {
        let directory = tempfile::tempdir().expect("a directory");
        let nowhere = directory.path().join("no").join("x.csv");
        assert!(find(Some(&nowhere), Path::new("x.cut")).expect_err("refused").contains("there is no directory"));
        let slash = PathBuf::from(format!("{}{MAIN_SEPARATOR}", directory.path().join("no").join("no").display()));
        assert!(find(Some(&slash), Path::new("x.cut")).expect_err("refused").contains("create it first"));
        assert!(read(directory.path()).expect_err("refused").to_string().contains("is a directory"));
    }

    #[test]
    fn a_directory_that_was_made_stays_with_what_is_in_it() {
        let directory = tempfile::tempdir().expect("a directory");
        let program = directory.path().join("out").join("x.csv");
        drop(MadeDirectory::of(&program).expect("writable").expect("it was not there"));
        assert!(!directory.path().join("out").exists());
        let made = MadeDirectory::of(&program).expect("writable");
        fs::write(&program, "t_s").expect("writable");
        drop(made);
        assert!(program.exists() && MadeDirectory::of(&program).expect("writable").is_none());
    }

    #[test]
    fn a_draft_leaves_nothing_until_it_is_whole() {
        let directory = tempfile::tempdir().expect("a directory");
        let path = directory.path().join("x.csv");
        let mut draft = Draft::new(&path).expect("a draft");
        draft.file().write_all(b"half").expect("writable");
        assert!(!path.exists());
        drop(draft);
        assert_eq!(fs::read_dir(directory.path()).expect("readable").count(), 0);
        let mut draft = Draft::new(&path).expect("a draft");
        draft.file().write_all(b"whole").expect("writable");
        draft.publish().expect("published");
        assert_eq!(fs::read(&path).expect("readable"), b"whole");
        let refused = Draft::new(&path).expect("a draft").publish_new().expect_err("refused");
        assert!(refused.to_string().contains("not overwritten"));
        assert_eq!(fs::read(&path).expect("readable"), b"whole");
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
