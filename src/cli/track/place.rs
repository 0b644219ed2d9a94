//! Targets of a log and the places of their files.

use super::arguments::Arguments;
use crate::cli::destination::{Asked, Destination, Place};
use crate::cli::finished::failure;
use crate::track::{Reader, TARGETS, Writer};

/// Files of a run: the chosen targets, by default one for a log and none for a scenario, and the picture of `--plot`.
pub(super) fn destinations(arguments: &Arguments) -> anyhow::Result<Vec<Destination<Writer, Reader>>> {
    let Arguments { file: input, out, targets, plot, simulate, force, machine, .. } = arguments;
    let beside = [machine.profile.as_deref(), None, None];
    let asked = Asked { all: TARGETS, out: out.as_deref(), targets, input, beside, force: *force };
    let mut found = Vec::new();
    if !simulate || !targets.is_empty() || out.is_some() {
        found.push(asked.destination()?);
    }
    let Some(plot) = plot else { return Ok(found) };
    if plot.extension().is_none_or(|extension| !extension.eq_ignore_ascii_case("svg")) {
        let message = format!("`--plot {}`: the picture is SVG", plot.display());
        return Err(failure(message, "give it a name that ends in `.svg`"));
    }
    let picture = TARGETS.iter().find(|target| target.name == "svg").expect("a picture is a target");
    let picture =
        Asked { all: TARGETS, out: Some(plot), targets: &[picture], input, beside, force: *force }.destination()?;
    match &mut found[..] {
        // One list: all files are published together or not at all.
        [Destination { targets, place: Place::Files(paths) }] => {
            targets.extend(picture.targets);
            paths.extend_from_slice(picture.place.files());
        }
        _ => found.push(picture),
    }
    Ok(found)
}
