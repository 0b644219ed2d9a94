//! Destinations of programs: never over an input, nor over a program that was made from another one.

use std::ffi::OsString;
use std::fs;
use std::path::{MAIN_SEPARATOR, Path, PathBuf};

use super::choices::Format;
use super::files::{STDIN, directory, is_dash, meta, move_aside, path_from, stale};
use super::finished::{FAULTY, Finished, failure};
use super::provenance;
use crate::ir::Target;

/// The current directory, on every system.
const DIRECTORY: &str = ".";

/// Arguments that decide about the destination of the programs of an input.
#[derive(Debug)]
pub(super) struct Asked<'a, E: 'static, P: 'static> {
    /// Every target of the machine; the first is the default.
    pub(super) all: &'static [Target<E, P>],
    /// Destination as typed.
    pub(super) out: Option<&'a Path>,
    /// Targets as typed; empty = by the destination.
    pub(super) targets: &'a [&'static Target<E, P>],
    /// The input file.
    pub(super) input: &'a Path,
    /// Paths of profile, centre line and marks.
    pub(super) beside: [Option<&'a Path>; 3],
    /// True if a program that was made from another input may be overwritten.
    pub(super) force: bool,
}

/// Targets of an input, and the place of their programs.
#[derive(Debug)]
pub(super) struct Destination<E: 'static, P: 'static> {
    /// Targets that are written.
    pub(super) targets: Vec<&'static Target<E, P>>,
    /// Place of the programs.
    pub(super) place: Place,
}

/// Place of programs.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum Place {
    /// Standard output.
    Stdout,
    /// Files, one for each target, with their `.meta.json` beside them.
    Files(Vec<PathBuf>),
}

impl Place {
    /// Paths of its files; empty for standard output.
    pub(super) fn files(&self) -> &[PathBuf] {
        match self {
            Self::Stdout => &[],
            Self::Files(paths) => paths,
        }
    }

    /// Refuses figures as JSON beside a program on standard output.
    pub(super) fn refuse_json(&self, format: Format) -> anyhow::Result<()> {
        if *self == Self::Stdout && format == Format::Json {
            return Err(failure(
                "`-o -` and `--format json` both want standard output",
                "write to a file with -o FILE, or leave --format out",
            ));
        }
        Ok(())
    }

    /// End of a command whose job was refused: older programs are moved aside. A mistake in an argument leaves them.
    pub(super) fn refused(&self, mut refused: Finished) -> Finished {
        if refused.code == FAULTY {
            refused.stderr.extend(self.files().iter().map(|path| move_aside(path)));
        }
        refused
    }
}

impl<E, P> Asked<'_, E, P> {
    /// Finds targets and place: `out` as typed, a directory for `<stem>.<extension>`, or the current directory without it.
    /// Never over the input itself, nor the profile. Without a target the extension of `out` chooses it.
    pub(super) fn destination(&self) -> anyhow::Result<Destination<E, P>> {
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

    /// The targets: those typed, else by the extension of the place, else the default.
    fn targets(&self) -> anyhow::Result<Vec<&'static Target<E, P>>> {
        let extensions: Vec<&str> = self.targets.iter().map(|target| target.extension).collect();
        if let Some(twice) = extensions.iter().enumerate().find_map(|(i, e)| extensions[..i].contains(e).then_some(e)) {
            return Err(failure(
                format!("two of the targets would write the same file, of extension `{twice}`"),
                "name each target once",
            ));
        }
        let file = self.out.filter(|out| !is_dash(out) && !names_directory(out));
        let name = file.and_then(Path::file_name).map(|name| name.to_string_lossy().to_ascii_lowercase());
        let ends = |target: &&Target<E, P>| {
            name.as_ref().is_some_and(|name| name.ends_with(&format!(".{}", target.extension)))
        };
        // The longest matching extension: `.timing.svg` also ends with `.svg`.
        let told = self.all.iter().filter(ends).max_by_key(|target| target.extension.len());
        let is_ambiguous = |file: &Path| names_program(file) && self.all.iter().any(|target| target.name == "gcode");
        match (self.targets, told, file) {
            ([one], Some(told), Some(file)) if one.extension != told.extension => Err(failure(
                format!(
                    "`-t {}` and `-o {}` disagree: the name is one of target {}",
                    one.name,
                    file.display(),
                    told.name
                ),
                renamed(file, told, one),
            )),
            ([], Some(told), _) => Ok(vec![told]),
            ([], None, Some(file)) if is_ambiguous(file) => Err(failure(
                format!("`-o {}` may be G-code or a cut file: its name does not say", file.display()),
                "say which with `-t gcode` or `-t iso`; alone `.ngc` is G-code here, `.iso` a cut file",
            )),
            ([], None, Some(file)) if names_other_format(file) => Err(failure(
                format!("`-o {}` is the name of no target", file.display()),
                format!(
                    "choose a target with -t, such as `-t {}`, or end the name as one does: {}",
                    self.all[0].name,
                    self.all.iter().map(|target| format!("`.{}`", target.extension)).collect::<Vec<_>>().join(", ")
                ),
            )),
            ([], None, _) => Ok(vec![&self.all[0]]),
            (typed, _, _) => Ok(typed.to_vec()),
        }
    }

    /// The file of one program.
    fn path(&self, target: &Target<E, P>) -> anyhow::Result<PathBuf> {
        let Self { out, input, beside, force, .. } = *self;
        let name = program_name(input, target.extension);
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
            // A file of that name would surprise a user who meant a directory, and vice versa.
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
        // A missing directory is created if its parent exists.
        let is_made = || out.is_some_and(names_directory) && !folder.exists() && directory(folder).is_dir();
        if !folder.is_dir() && !is_made() {
            let message = format!("cannot write `{shown}`: there is no directory `{}`", folder.display());
            return Err(failure(message, "create it first, or name another one"));
        }
        let inputs = [Some(input).filter(|input| !is_dash(input))].into_iter().chain(beside);
        let inputs: Vec<&Path> = inputs.into_iter().flatten().collect();
        writable(&path, &inputs)?;
        if !force {
            not_of_another(&path, input)?;
        }
        Ok(path)
    }
}

/// Hint with the name of a file under the extension of another target.
fn renamed<E, P>(file: &Path, told: &Target<E, P>, asked: &Target<E, P>) -> String {
    let shown = file.display().to_string();
    let stem = &shown[..shown.len() - told.extension.len()];
    format!("leave -t out, or write to `-o {stem}{}`", asked.extension)
}

/// The name of the program that is made from an input, by the extension of its target.
fn program_name(input: &Path, extension: &str) -> OsString {
    let stem = if is_dash(input) { STDIN.as_ref() } else { input.file_stem().unwrap_or(input.as_os_str()) };
    let mut name = OsString::from(stem);
    name.push(format!(".{extension}"));
    name
}

/// True if a place is for one program: standard output, or a path that is a file or is named like one.
pub(super) fn is_one_file(out: &Path) -> bool {
    is_dash(out) || (!out.is_dir() && (out.is_file() || (!names_directory(out) && out.extension().is_some())))
}

/// Error about many programs with one such place.
pub(super) fn of_many(out: &Path) -> anyhow::Error {
    failure(format!("`-o {}` is one place for many programs", out.display()), "name a directory, as in `-o out/`")
}

/// The targets of many files, with places below a folder.
pub(super) fn targets_of_many<E, P>(
    out: &Path,
    all: &'static [Target<E, P>],
    typed: &[&'static Target<E, P>],
) -> anyhow::Result<Vec<&'static Target<E, P>>> {
    if is_one_file(out) {
        return Err(of_many(out));
    }
    let folder = Path::new(DIRECTORY);
    Asked { all, out: Some(folder), targets: typed, input: folder, beside: [None; 3], force: false }.targets()
}

/// Places of the programs of one of many files, by the extensions of their targets: below a folder, in the folder structure of
/// the inputs.
pub(super) fn below(out: &Path, name: &Path, extensions: &[&str]) -> Vec<PathBuf> {
    let folder = out.join(name.parent().unwrap_or(Path::new("")));
    extensions.iter().map(|extension| folder.join(program_name(name, extension))).collect()
}

/// Checks that a program can be written to a path: no directory or device is there, and neither the path nor that of its
/// provenance is one of some inputs.
pub(super) fn writable(path: &Path, inputs: &[&Path]) -> anyhow::Result<()> {
    if fs::metadata(path).is_ok_and(|target| !target.is_file()) {
        return Err(failure(
            format!("`{}` is not a regular file", path.display()),
            "write to a file, or to a pipe with `-o -`",
        ));
    }
    for made in [path.to_owned(), meta(path), stale(path), stale(&meta(path))] {
        if let Some(read) = inputs.iter().find(|read| same_file(&made, read)) {
            let message = format!("`{}` is an input: it is never overwritten", read.display());
            return Err(failure(message, "give the program another name with -o"));
        }
    }
    Ok(())
}

/// Checks that the file at a path, if any, was made by `cutc` from the same input: one of the same name, in the same place if
/// that is known, or with the same bytes. An empty file holds nothing that could be lost.
pub(super) fn not_of_another(path: &Path, input: &Path) -> anyhow::Result<()> {
    const HINT: &str = "give the new program another place with -o, or say --force";
    let name = if is_dash(input) { STDIN.into() } else { input.file_name().unwrap_or_default().to_string_lossy() };
    if fs::metadata(path).map_or(true, |file| file.len() == 0) {
        return Ok(());
    }
    let shown = path.display();
    match provenance::source_of(path) {
        Some(made_from) if made_from == name => {
            let (known, here) = (provenance::source_path_of(path), path_from(directory(path), input));
            let is_same = || fs::read(input).is_ok_and(|bytes| provenance::is_made_from(path, &bytes));
            match (known, here) {
                (Some(known), Some(here)) if known != here && !is_same() => Err(failure(
                    format!(
                        "`{shown}` was made from `{known}`, not from `{here}` (paths from its folder): it is not overwritten"
                    ),
                    HINT,
                )),
                _ => Ok(()),
            }
        }
        Some(made_from) => Err(failure(
            format!("`{shown}` was made from `{made_from}`, not from `{name}`: it is not overwritten"),
            HINT,
        )),
        None => {
            let meta = meta(path);
            let name = meta.file_name().unwrap_or_default().to_string_lossy();
            Err(failure(format!("`{shown}` is not overwritten: no `{name}` says that `cutc` made it"), HINT))
        }
    }
}

/// True if a path is a directory, or is written as one.
pub(super) fn names_directory(path: &Path) -> bool {
    path.is_dir() || path.as_os_str().to_string_lossy().ends_with(MAIN_SEPARATOR)
}

/// True if a path has an extension that is common for programs of machines: setpoints must not get such a name unnoticed.
fn names_program(path: &Path) -> bool {
    let extension = path.extension().map(|extension| extension.to_string_lossy().to_ascii_lowercase());
    matches!(extension.as_deref(), Some("nc" | "gcode" | "gco" | "tap" | "cnc" | "cut" | "gbr" | "ggt"))
}

/// True if a path has an extension of some other format: a user who asks for a picture or a document must not get setpoints
/// under its name. Plain text may have any name.
fn names_other_format(path: &Path) -> bool {
    path.extension().is_some_and(|extension| !extension.eq_ignore_ascii_case("txt"))
}

fn same_file(a: &Path, b: &Path) -> bool {
    a.canonicalize().is_ok_and(|a| b.canonicalize().is_ok_and(|b| a == b))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::back::{self, TARGETS};
    use crate::cli::files;

    fn find(out: Option<&Path>, input: &Path) -> Result<Place, String> {
        let asked = Asked { all: TARGETS, out, targets: &[], input, beside: [None; 3], force: false };
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
        let written = |out: &str, targets: &[&'static back::Target]| {
            let asked = Asked {
                all: TARGETS,
                out: Some(Path::new(out)),
                targets,
                input: Path::new("a.cut"),
                beside: [None; 3],
                force: false,
            };
            let found = asked.destination().map_err(|error| error.to_string())?;
            Ok::<_, String>(found.targets.iter().map(|target| target.name).collect::<Vec<_>>())
        };
        for target in TARGETS {
            assert_eq!(written(&format!("x.{}", target.extension), &[]), Ok(vec![target.name]));
            assert_eq!(written(&format!("x.{}", target.extension.to_uppercase()), &[]), Ok(vec![target.name]));
            assert_eq!(written("x.txt", &[target]), Ok(vec![target.name]));
        }
        assert_eq!(written("x.txt", &[]), Ok(vec![TARGETS[0].name]));
        for other in ["x.pdf", "x.PNG", "x.dxf", "x.plt", "x.xlsx", "x.prg"] {
            let refused = written(other, &[]).expect_err("no target has this name");
            assert!(refused.contains(other) && refused.contains("`.csv`") && refused.contains("-t csv"), "{refused}");
            assert_eq!(written(other, &[&TARGETS[0]]), Ok(vec![TARGETS[0].name]));
        }
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
    fn a_program_of_another_source_is_not_overwritten() {
        let directory = tempfile::tempdir().expect("a directory");
        let program = directory.path().join("m05.csv");
        fs::write(&program, "t_s").expect("writable");
        fs::write(meta(&program), r#"{"source": "m05.cut"}"#).expect("writable");
        let find = |input: &str, force| {
            let (out, input) = (Some(directory.path()), Path::new(input));
            let asked = Asked { all: TARGETS, out, targets: &[], input, beside: [None; 3], force };
            asked.destination().map(|found| found.place).map_err(|error| error.to_string())
        };
        assert!(find("in/m05.plt", false).expect_err("refused").contains("made from `m05.cut`, not from `m05.plt`"));
        let written = Ok(Place::Files(vec![program.clone()]));
        assert_eq!(find("in/m05.cut", false), written);
        assert_eq!(find("in/m05.plt", true), written);
        // A file without provenance is the user's own work, unless it is empty.
        fs::remove_file(meta(&program)).expect("removable");
        assert!(find("in/m05.cut", false).expect_err("refused").contains("no `m05.csv.meta.json` says"));
        assert_eq!(find("in/m05.cut", true), written);
        fs::write(&program, "").expect("writable");
        assert_eq!(find("in/m05.cut", false), written);
        fs::remove_file(&program).expect("removable");
        assert_eq!(find("in/m05.plt", false), written);
    }

    #[test]
    fn inputs_of_one_name_are_told_apart_by_their_place() {
        let directory = tempfile::tempdir().expect("a directory");
        let at = |name: &str| directory.path().join(name);
        for (folder, bytes) in [("a", "one"), ("b", "two"), ("c", "one")] {
            fs::create_dir(at(folder)).expect("writable");
            fs::write(at(folder).join("m.cut"), bytes).expect("writable");
        }
        fs::create_dir(at("out")).expect("writable");
        let program = at("out/m.csv");
        fs::write(&program, "t_s").expect("writable");
        let digest = crate::machine::sha256_hex(b"one");
        let made = format!(r#"{{"source": "m.cut", "source_path": "../a/m.cut", "source_sha256": "{digest}"}}"#);
        fs::write(meta(&program), made).expect("writable");
        let check = |input: &str| not_of_another(&program, &at(input)).map_err(|error| error.to_string());
        assert_eq!(check("a/m.cut"), Ok(()));
        assert_eq!(check("c/m.cut"), Ok(()), "a copy of it");
        assert!(check("b/m.cut").expect_err("refused").contains("made from `../a/m.cut`, not from `../b/m.cut`"));
        fs::write(at("a/m.cut"), "edited").expect("writable");
        assert_eq!(check("a/m.cut"), Ok(()));
        fs::write(meta(&program), r#"{"source": "m.cut"}"#).expect("writable");
        assert_eq!(check("b/m.cut"), Ok(()), "the place is not known");
    }

    #[test]
    fn places_that_cannot_be_written_are_named() {
        let directory = tempfile::tempdir().expect("a directory");
        let nowhere = directory.path().join("no").join("x.csv");
        assert!(find(Some(&nowhere), Path::new("x.cut")).expect_err("refused").contains("there is no directory"));
        let slash = PathBuf::from(format!("{}{MAIN_SEPARATOR}", directory.path().join("no").join("no").display()));
        assert!(find(Some(&slash), Path::new("x.cut")).expect_err("refused").contains("create it first"));
        assert!(files::read(directory.path()).expect_err("refused").to_string().contains("is a directory"));
    }
}
