//! What is written of a log, and where.

use std::path::{Path, PathBuf};

use super::arguments::Arguments;
use crate::cli::destination::{names_directory, not_of_another, writable};
use crate::cli::files::{STDIN, directory, is_dash};
use crate::cli::finished::failure;
use crate::track::{TARGETS, Target};

/// Where something is written.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum Place {
    Stdout,
    File(PathBuf),
}

/// Everything that is written, each with its place: never over the input, nor over what was made of another.
pub(super) fn places(arguments: &Arguments) -> anyhow::Result<Vec<(&'static Target, Place)>> {
    let Arguments { file: input, out, targets, plot, .. } = arguments;
    if let Some(twice) = targets.iter().enumerate().find(|(i, t)| targets[..*i].iter().any(|u| u.name == t.name)) {
        return Err(failure(format!("the target `{}` is named twice", twice.1.name), "name each target once"));
    }
    let is_asked = !targets.is_empty() || out.is_some();
    let mut chosen: Vec<&'static Target> = targets.clone();
    if targets.is_empty() && (is_asked || !arguments.simulate) {
        chosen.push(told(out.as_deref()).unwrap_or(&TARGETS[0]));
    }
    let many = chosen.len() > 1;
    let mut places = Vec::new();
    for target in chosen {
        let stem = if is_dash(input) { STDIN.into() } else { input.file_stem().unwrap_or_default().to_string_lossy() };
        let name = format!("{stem}.{}", target.extension);
        places.push((
            target,
            match out.as_deref() {
                None if is_dash(input) => {
                    let hint = "say where it goes with -o FILE, -o DIRECTORY or `-o -`";
                    return Err(failure("what is made from standard input has no name", hint));
                }
                None => Place::File(PathBuf::from(name)),
                Some(out) if names_directory(out) => Place::File(out.join(name)),
                Some(out) if many => {
                    let message = format!("`-o {}` is one place for several files", out.display());
                    return Err(failure(message, "name a directory, as in `-o out/`, or leave -o out"));
                }
                Some(out) if is_dash(out) => Place::Stdout,
                Some(out) => Place::File(out.to_owned()),
            },
        ));
    }
    if let Some(plot) = plot {
        if plot.extension().is_none_or(|extension| !extension.eq_ignore_ascii_case("svg")) {
            let message = format!("`--plot {}`: the picture is SVG", plot.display());
            return Err(failure(message, "give it a name that ends in `.svg`"));
        }
        let picture = TARGETS.iter().find(|target| target.name == "svg").expect("a picture is a target");
        places.push((picture, Place::File(plot.clone())));
    }
    for (_, place) in &places {
        if let Place::File(path) = place {
            check(arguments, path)?;
        }
    }
    Ok(places)
}

/// The target that the end of a name tells.
fn told(out: Option<&Path>) -> Option<&'static Target> {
    let name = out?.file_name()?.to_string_lossy().to_ascii_lowercase();
    TARGETS.iter().find(|target| name.ends_with(&format!(".{}", target.extension)))
}

/// Whether a file may be written.
fn check(arguments: &Arguments, path: &Path) -> anyhow::Result<()> {
    let folder = directory(path);
    let is_made = || arguments.out.as_deref().is_some_and(names_directory) && directory(folder).is_dir();
    if !folder.is_dir() && !is_made() {
        let message = format!("cannot write `{}`: there is no directory `{}`", path.display(), folder.display());
        return Err(failure(message, "create it first, or name another one"));
    }
    let input = arguments.file.as_path();
    let inputs = [Some(input).filter(|input| !is_dash(input)), arguments.machine.profile.as_deref()];
    let inputs: Vec<&Path> = inputs.into_iter().flatten().collect();
    writable(path, &inputs)?;
    if arguments.force { Ok(()) } else { not_of_another(path, input) }
}
