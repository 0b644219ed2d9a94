//! `cutc sew`: patterns and stitch files to feed pulses, queues and stitch files of a pattern-sewing machine.

mod arguments;
mod made;
mod many;
mod one;
mod place;
mod sewn;
mod summary;

pub(super) use arguments::Arguments;

use std::path::Path;

use super::batch::{self, Inputs};
use super::finished::{Console, Finished};
use crate::sew::FORMATS;

pub(super) fn run(arguments: &Arguments, console: &mut Console) -> anyhow::Result<Finished> {
    let hint = format!("files to sew are told by {} {}", extensions().join(" "), batch::extensions());
    match batch::find(&arguments.files, is_sewn, &hint)? {
        Inputs::One(file) => one::run(arguments, &file),
        Inputs::Many(inputs) => many::run(arguments, &inputs, console),
    }
}

/// The extensions of formats of sewing machines, with their dots.
fn extensions() -> Vec<String> {
    let mut known: Vec<String> =
        FORMATS.iter().flat_map(|format| format.extensions).map(|known| format!(".{known}")).collect();
    known.dedup();
    known
}

/// Whether a file in a folder looks like one to sew, by its extension.
fn is_sewn(path: &Path) -> bool {
    let extension = path.extension().map(|extension| extension.to_string_lossy().into_owned()).unwrap_or_default();
    let mut known = FORMATS.iter().flat_map(|format| format.extensions);
    known.any(|known| known.eq_ignore_ascii_case(&extension)) || batch::is_cutter_file(path)
}
