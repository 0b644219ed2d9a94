//! What pictures show of a program that was refused: the errors, each at the place that it speaks of.

use crate::back::{Emit, Proof, Target};
use crate::diagnostic::{Diagnostic, Diagnostics, Severity, code};
use crate::geom::Point;
use crate::ir::finding::Sighting;
use crate::ir::marker::Notch;
use crate::ir::{Finding, Marker};
use crate::source::Span;

/// The most errors that a picture marks: it is looked at, the messages tell the rest.
const MOST: usize = 24;

/// Whether a target draws what the knife would do, and may do so where no program is written.
pub(super) fn is_picture(target: &Target) -> bool {
    matches!(target.emit, Emit::Toolpath(_)) && target.proof == Proof::None
}

/// The errors that refuse a program, as findings that do not hold; those of the verifier are findings already.
pub(super) fn findings(marker: &Marker, diagnostics: &Diagnostics) -> Vec<Finding> {
    let is_error = |d: &&Diagnostic| d.code.severity == Severity::Error && d.code != &code::VERIFY_BROKEN;
    let finding = |d: &Diagnostic| Finding {
        rule: d.code.name,
        worst: f64::INFINITY,
        limit: Some(0.0),
        unit: "",
        place: d
            .span
            .and_then(|span| place(marker, span).map(|point| Sighting { time: None, point, block: span.block })),
    };
    diagnostics.iter().filter(is_error).map(finding).take(MOST).collect()
}

/// A place on what the block of a span cuts or drills: the middle of a line, a hole.
fn place(marker: &Marker, span: Span) -> Option<Point> {
    let is_it = |other: Span| span.block > 0 && other.block == span.block;
    let middle = |from: Point, to: Point| from + (to - from) / 2.0;
    let contours = marker.contours().flat_map(|(_, contour)| marker.list.walk(contour.range));
    let lines =
        contours.filter(|(_, segment)| is_it(segment.span)).map(|(_, segment)| middle(segment.from, segment.to));
    let notches = marker.pieces.iter().flat_map(|piece| &piece.notches).flat_map(Notch::strokes);
    let cuts = notches.filter(|cut| is_it(cut.span)).map(|cut| middle(cut.from, cut.to));
    let drills = marker.pieces.iter().flat_map(|piece| &piece.drills);
    let holes = drills.filter(|drill| is_it(drill.span)).map(|drill| drill.at);
    lines.chain(cuts).chain(holes).next()
}
