//! Reading: bytes become a pattern, or stitches if the file contains them.
//!
//! Receives a source. Promises seams in mm or needle points that are independent of the format. Formats of sewing machines are
//! in [`FORMATS`]; all other input of `cutc` comes through `outline`. All faults are reported in one run. Never guesses
//! silently.

mod cursor;
mod dst;
mod exp;
mod format;
mod inset;
mod jef;
mod moves;
mod outline;
mod pattern;
mod pec;
mod queue;
mod records;
mod u01;
mod vp3;
mod xxx;

pub(super) use format::Speed;
pub use format::{Format, Input};

use super::asked::Asked;
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::front::DIALECTS;
use crate::machine::Job;
use crate::source::Source;

/// All formats of sewing machines.
pub const FORMATS: &[Format] = &[
    pattern::FORMAT,
    queue::FORMAT,
    dst::FORMAT,
    exp::FORMAT,
    pec::PES,
    pec::PEC,
    jef::FORMAT,
    vp3::FORMAT,
    xxx::FORMAT,
    u01::FORMAT,
];

/// Format and content of a source.
pub(super) struct Reading {
    /// Name of the format or dialect.
    pub(super) format: &'static str,
    /// Word for its records.
    pub(super) record_word: &'static str,
    pub(super) input: Input,
}

/// Reads a source in the chosen format or dialect, otherwise in the detected one. `None` if it is unknown.
pub(super) fn read(source: &Source, asked: &Asked, job: &Job, out: &mut Diagnostics) -> Option<Reading> {
    let extension = source.name().rsplit_once('.').map_or("", |(_, extension)| extension).to_ascii_lowercase();
    let format = match asked.from.as_deref() {
        Some(name) => FORMATS.iter().find(|format| format.name == name),
        None => FORMATS.iter().find(|format| (format.is_it)(source.bytes(), &extension)),
    };
    let Some(Format { name, record_word, read, .. }) = format else {
        let first = out.iter().len();
        let Some((format, pattern)) = outline::read(source, asked, job, out) else {
            // Advice on the conversion of a stitch file stands; that on cutter files does not help here.
            let is_stitches = |found: &Diagnostic| found.message.contains("embroidery");
            out.revise(first, |found| {
                if !is_stitches(found) {
                    found.hints = vec![known()];
                }
            });
            return None;
        };
        return Some(Reading { format, record_word: outline::RECORD_WORD, input: Input::Pattern(pattern) });
    };
    refuse_choices(name, asked, out);
    Some(Reading { format: name, record_word, input: read(source, out) })
}

/// Hint that lists the supported input.
fn known() -> String {
    let formats: Vec<&str> = FORMATS.iter().map(|format| format.name).collect();
    let dialects: Vec<&str> = DIALECTS.iter().map(|dialect| dialect.name).collect();
    let (formats, dialects) = (formats.join(", "), dialects.join(", "));
    format!(
        "`cutc sew` reads {formats}, and the lines of {dialects}; if it is one of them all the same, name it with `--from`"
    )
}

/// Refuses the choice of lines or insets for a format with fixed seams.
fn refuse_choices(format: &str, asked: &Asked, out: &mut Diagnostics) {
    if let Some(line) = &asked.line {
        let message = format!("a file of the format {format} has no pens or layers, so none has the name `{line}`");
        out.push(Diagnostic::new(&code::SEW_NO_LINE, message).hint("leave `--line` out: all of the file is sewn"));
    }
    if asked.inset != 0.0 {
        let message = format!("a file of the format {format} has no contours inside which to sew");
        let hint = "leave `--inset` out: the seams of the file are where they are sewn";
        out.push(Diagnostic::new(&code::SEW_INSET, message).hint(hint));
    }
}
