//! Reading: bytes to a pattern, or to stitches where the file has these already.
//!
//! Receives a source, promises seams in mm or needle points that later stages need not know the format of. Formats of
//! sewing machines stand in [`FORMATS`]; whatever else `cutc` reads comes through `outline`. Faults are reported all in one
//! run. Never guesses silently.

mod dst;
mod exp;
mod format;
mod inset;
mod moves;
mod outline;
mod pattern;
mod queue;

pub use format::{Format, Input};

use super::asked::Asked;
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::machine::Job;
use crate::source::Source;

/// Every format of sewing machines.
pub const FORMATS: &[Format] = &[pattern::FORMAT, queue::FORMAT, dst::FORMAT, exp::FORMAT];

/// Reads a source as what was asked, or as what it looks like; the name of that beside what it says. `None` when it is
/// nothing that is known.
pub(super) fn read(source: &Source, asked: &Asked, job: &Job, out: &mut Diagnostics) -> Option<(&'static str, Input)> {
    let extension = source.name().rsplit_once('.').map_or("", |(_, extension)| extension).to_ascii_lowercase();
    let format = match asked.from.as_deref() {
        Some(name) => FORMATS.iter().find(|format| format.name == name),
        None => FORMATS.iter().find(|format| (format.is_it)(source.bytes(), &extension)),
    };
    match format {
        Some(format) => {
            refuse_choices(format, asked, out);
            Some((format.name, (format.read)(source, out)))
        }
        None => outline::read(source, asked, job, out).map(|(name, pattern)| (name, Input::Pattern(pattern))),
    }
}

/// Refuses choices among lines and contours where a file has none: its seams are where they are sewn.
fn refuse_choices(format: &Format, asked: &Asked, out: &mut Diagnostics) {
    if let Some(line) = &asked.line {
        let message =
            format!("a file of the format {} has no pens or layers, so none has the name `{line}`", format.name);
        out.push(Diagnostic::new(&code::SEW_NO_LINE, message).hint("leave `--line` out: all of the file is sewn"));
    }
    if asked.inset != 0.0 {
        let message = format!("a file of the format {} has no contours inside which to sew", format.name);
        let hint = "leave `--inset` out: the seams of the file are where they are sewn";
        out.push(Diagnostic::new(&code::SEW_INSET, message).hint(hint));
    }
}
