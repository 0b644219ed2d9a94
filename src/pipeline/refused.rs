//! Findings in pictures and pages: the errors of a program that was refused, each at its place, and the doubts about pieces.

use std::io::{self, BufWriter, Write};

use super::product::Product;
use crate::back::{Context, Emit, Outcome, Target};
use crate::diagnostic::{Diagnostic, Diagnostics, Severity, code};

/// Greatest number of errors that a picture marks; the messages tell the rest.
const MOST: usize = 24;

/// True if a target draws the motion of the knife, so that it may be written even for a refused program.
pub(super) fn is_picture(target: &Target) -> bool {
    matches!(target.emit, Emit::Picture(_) | Emit::Page(_))
}

/// The errors that refuse a program; those of the verifier are findings.
pub(super) fn errors(diagnostics: &Diagnostics) -> Vec<&Diagnostic> {
    let is_error = |d: &&Diagnostic| d.code.severity == Severity::Error && d.code != &code::VERIFY_BROKEN;
    diagnostics.iter().filter(is_error).take(MOST).collect()
}

/// Warnings about some of the pieces, or about uncut lines that may be outlines.
pub(super) fn doubts(diagnostics: &Diagnostics) -> Vec<&Diagnostic> {
    let is_uncut = |d: &Diagnostic| *d.code == code::DRAWING_OPEN_PART || *d.code == code::DRAWING_OPEN_OUTLINES;
    let is_of_some = |d: &Diagnostic| !d.pieces.is_empty() || is_uncut(d);
    let is_doubt = |d: &&Diagnostic| d.code.severity == Severity::Warning && is_of_some(d);
    diagnostics.iter().filter(is_doubt).take(MOST).collect()
}

/// Draws a marker that was refused before anything was planned.
pub(super) fn draw(context: &Context, products: &mut [Product], diagnostics: &Diagnostics) -> io::Result<()> {
    let (refusals, doubts) = (errors(diagnostics), doubts(diagnostics));
    let messages: Vec<&Diagnostic> = diagnostics.iter().collect();
    let outcome = Outcome { refusals: &refusals, doubts: &doubts, messages: &messages, ..Outcome::default() };
    for Product { target, out, shows_refusal, .. } in products {
        let mut out = BufWriter::new(&mut **out);
        match &target.emit {
            Emit::Picture(parts) => {
                (parts.head)(context, &mut out)?;
                (parts.tail)(context, outcome, &mut out)?;
            }
            Emit::Page(begin) => begin(context).write(outcome, &mut out)?,
            Emit::Marker(_) | Emit::Toolpath(_) | Emit::Arcs(_) | Emit::Motion(_) => continue,
        }
        out.flush()?;
        *shows_refusal = true;
    }
    Ok(())
}
