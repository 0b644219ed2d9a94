//! `cutc sew`: patterns and stitch files to feed pulses, queues and stitch files of a pattern-sewing machine.

mod arguments;
mod made;
mod many;
mod one;
mod sewn;
mod summary;

pub(super) use arguments::{Arguments, inset};
pub(super) use sewn::typed;

use std::collections::BTreeSet;
use std::path::Path;

use super::batch::{self, Input, Inputs};
use super::finished::{Console, Finished};
use crate::front::DIALECTS;
use crate::sew::FORMATS;

pub(super) fn run(arguments: &Arguments, console: &mut Console) -> anyhow::Result<Finished> {
    let dotted: Vec<String> = extensions().iter().map(|known| format!(".{known}")).collect();
    let hint = format!("files to sew are told by {}", dotted.join(" "));
    match batch::find(&arguments.files, is_sewn, &hint)? {
        Inputs::One(file) if !arguments.chosen.is_of_many() => one::run(arguments, &file),
        Inputs::One(file) => many::run(arguments, &[Input::named(&file)], console),
        Inputs::Many(inputs) => many::run(arguments, &inputs, console),
    }
}

/// Extensions of files that can be sewn, formats of sewing machines first.
fn extensions() -> Vec<&'static str> {
    let formats = FORMATS.iter().flat_map(|format| format.extensions);
    let mut known: Vec<&str> = formats.chain(DIALECTS.iter().flat_map(|dialect| dialect.extensions)).copied().collect();
    let mut seen = BTreeSet::new();
    known.retain(|known| seen.insert(*known));
    known
}

/// True if a file in a folder can be sewn, by its extension.
fn is_sewn(path: &Path) -> bool {
    let extension = path.extension().map(|extension| extension.to_string_lossy().into_owned()).unwrap_or_default();
    extensions().iter().any(|known| known.eq_ignore_ascii_case(&extension))
}
