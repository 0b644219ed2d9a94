//! Where sewn programs go.

use std::path::{Path, PathBuf};

use super::arguments::Arguments;
use crate::cli::destination::{is_one_file, names_directory, not_of_another, of_many, writable};
use crate::cli::files::{STDIN, directory, is_dash};
use crate::cli::finished::failure;
use crate::sew::{TARGETS, Target};

/// What was typed, else the default.
fn typed(arguments: &Arguments) -> anyhow::Result<Vec<&'static Target>> {
    let typed = &arguments.targets;
    if let Some(twice) = typed.iter().enumerate().find(|(i, t)| typed[..*i].iter().any(|u| u.name == t.name)) {
        return Err(failure(format!("the target `{}` is named twice", twice.1.name), "name each target once"));
    }
    Ok(if typed.is_empty() { vec![&TARGETS[0]] } else { typed.clone() })
}

/// What is written of many files, which go below a folder.
pub(super) fn targets_of_many(arguments: &Arguments) -> anyhow::Result<Vec<&'static Target>> {
    if let Some(out) = arguments.out.as_deref().filter(|out| is_one_file(out)) {
        return Err(of_many(out));
    }
    typed(arguments)
}

/// What is written: what was typed, else what the name says, else the default.
pub(super) fn targets(arguments: &Arguments) -> anyhow::Result<Vec<&'static Target>> {
    let default = typed(arguments)?;
    let typed = &arguments.targets;
    let Some(out) = arguments.out.as_deref().filter(|out| !is_dash(out) && !names_directory(out)) else {
        return Ok(default);
    };
    let name = out.file_name().unwrap_or_default().to_string_lossy().to_ascii_lowercase();
    // `a.csv` is one of two targets: only the whole of an extension tells.
    let told = TARGETS.iter().find(|target| name.ends_with(&format!(".{}", target.extension)));
    match (&typed[..], told) {
        ([], Some(told)) => Ok(vec![told]),
        ([], None) => Err(failure(
            format!("`-o {}` does not say what to write", out.display()),
            "say it with -t, as in `-t queue`; names of their own end in .queue.csv, .pulses.npy, .dst, .exp and the like",
        )),
        ([one], Some(told)) if one.name != told.name => Err(failure(
            format!("`-t {}` and `-o {}` disagree: the name is one of target {}", one.name, out.display(), told.name),
            "leave -t out, or give another name",
        )),
        ([_], _) => Ok(typed.clone()),
        (_, _) => Err(failure(
            format!("`-o {}` is one place for {} programs", out.display(), typed.len()),
            "name a directory, as in `-o out/`, or leave -o out",
        )),
    }
}

/// The file of each program: never the input, nor the program of another.
pub(super) fn paths(arguments: &Arguments, input: &Path, targets: &[&'static Target]) -> anyhow::Result<Vec<PathBuf>> {
    if arguments.out.is_none() && is_dash(input) {
        return Err(failure(
            "a program that is made from standard input has no name",
            "say where it goes with -o FILE, -o DIRECTORY or `-o -`",
        ));
    }
    let stem =
        if is_dash(input) { STDIN.into() } else { input.file_stem().unwrap_or(input.as_os_str()).to_string_lossy() };
    let path = |target: &&Target| {
        let name = format!("{stem}.{}", target.extension);
        let path = match arguments.out.as_deref() {
            None => PathBuf::from(name),
            Some(out) if names_directory(out) => out.join(name),
            Some(out) => out.to_owned(),
        };
        let folder = directory(&path);
        let is_made = || arguments.out.as_deref().is_some_and(names_directory) && directory(folder).is_dir();
        if !folder.is_dir() && !is_made() {
            let message = format!("cannot write `{}`: there is no directory `{}`", path.display(), folder.display());
            return Err(failure(message, "create it first, or name another one"));
        }
        let inputs = [Some(input).filter(|input| !is_dash(input)), arguments.machine.profile.as_deref()];
        let inputs: Vec<&Path> = inputs.into_iter().flatten().collect();
        writable(&path, &inputs)?;
        if !arguments.force {
            not_of_another(&path, input)?;
        }
        Ok(path)
    };
    targets.iter().map(path).collect()
}
