//! Judging: a program is read back, and what is broken is said.

use std::fmt::Write as _;
use std::io::{self, BufReader};

use super::{Input, Medium, read};
use crate::back::Context;
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::front::Dialect;
use crate::ir::Marker;
use crate::machine::Job;
use crate::source::{Source, Span};
use crate::units::number::fixed;
use crate::verify::{self, Census, Verdict};

/// Bytes that are read back at a time.
const BLOCK: usize = 1 << 16;

/// Judges a program of timed setpoints, edited by hand or not, against a source. `None` when that cannot be read.
pub fn judge_program(
    program: &mut dyn Medium,
    source: &Source,
    from: Option<&'static Dialect>,
    job: &Job,
    diagnostics: &mut Diagnostics,
) -> io::Result<Option<Verdict>> {
    let Some(Input { dialect, marker }) = read(source, from, job, diagnostics) else { return Ok(None) };
    if diagnostics.has_errors() {
        return Ok(None);
    }
    let verdict = judge(source, dialect, &Context { job, marker: &marker }, program)?;
    report(&verdict, &marker, diagnostics);
    Ok(Some(verdict))
}

/// Reads a program back from its start and judges it, and the marker against the source.
pub(super) fn judge(
    source: &Source,
    dialect: &Dialect,
    context: &Context,
    program: &mut dyn Medium,
) -> io::Result<Verdict> {
    program.rewind()?;
    let mut verdict = verify::setpoints(&mut BufReader::with_capacity(BLOCK, program), context.marker, context.job);
    let unit = context.marker.unit;
    let audit = verify::source_audit(dialect.name, source.bytes(), &Census::of(context.marker), unit);
    verdict.findings.extend(audit.into_iter().flatten());
    verify::sort(&mut verdict.findings);
    Ok(verdict)
}

/// A diagnostic for each rule that does not hold.
pub(super) fn report(verdict: &Verdict, marker: &Marker, diagnostics: &mut Diagnostics) {
    for finding in verdict.broken() {
        let unit = finding.unit;
        let limit = finding.limit.map_or_else(String::new, |limit| format!(", the most is {}", fixed(limit, 4)));
        let mut message = format!("{}: {} {unit}{limit}", finding.rule, fixed(finding.worst, 4));
        let mut span = None;
        if let Some(place) = finding.place {
            if let Some(time) = place.time {
                let _ = write!(message, ", at {} s", fixed(time, 3));
            }
            let _ = write!(message, ", X {} Y {} mm", fixed(place.point.x, 3), fixed(place.point.y, 3));
            span = span_of(marker, place.block);
        }
        let diagnostic = Diagnostic { span, ..Diagnostic::new(&code::VERIFY_BROKEN, message) };
        diagnostics.push(diagnostic.hint("this program must not run; no program is written"));
    }
}

/// The span of a source block that is cut.
fn span_of(marker: &Marker, block: u32) -> Option<Span> {
    let contours = marker.contours().flat_map(|(_, contour)| marker.list.walk(contour.range)).map(|(_, s)| s.span);
    let notches = marker.pieces.iter().flat_map(|piece| &piece.notches).map(|notch| notch.span);
    contours.chain(notches).find(|span| span.block == block && block > 0)
}
