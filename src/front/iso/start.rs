//! Contours without a start: the place of one is lost, and the knife would go down where another contour has ended.

use super::at_place::Hole;
use crate::diagnostic::{Diagnostic, code};
use crate::geom::Point;
use crate::source::Span;

/// Motions of the knife in the air since its last lift.
#[derive(Debug, Default)]
pub(super) struct Start {
    /// True if a place was given since the last lift or hole.
    has_moved: bool,
    /// The piece or label that began without a place since then.
    begun: Option<Span>,
}

impl Start {
    /// Records a lift or a hole: the place of the knife has served.
    pub(super) fn serve(&mut self) {
        *self = Self::default();
    }

    /// Records a place in the air.
    pub(super) fn go(&mut self) {
        (self.has_moved, self.begun) = (true, None);
    }

    /// Records a piece or a label. `is_amid` is true where an interrupted contour may go on from.
    pub(super) fn begin(&mut self, span: Span, is_amid: bool) {
        if !self.has_moved && !is_amid {
            self.begun = Some(span);
        }
    }

    /// The fault of a plunge at a block, if something has begun and no place was given since.
    pub(super) fn fault(&self, span: Span) -> Option<Diagnostic> {
        let begun = self.begun?.block;
        let message = format!("the knife goes down without a place since the piece or label in block {begun}");
        let finding = Diagnostic::new(&code::ISO_NO_START, message).at(span);
        Some(finding.hint("the place may stand in the text of a label whose `*` is lost; transfer the file again"))
    }
}

/// Holes that are drilled twice.
#[derive(Debug, Default)]
pub(super) struct Twice {
    last: Option<(Point, u8)>,
    count: usize,
    first: Option<Span>,
}

impl Twice {
    /// Records a hole.
    pub(super) fn see(&mut self, at: Point, Hole { tool, span }: Hole) {
        if self.last.replace((at, tool)) == Some((at, tool)) {
            self.count += 1;
            self.first.get_or_insert(span);
        }
    }

    /// The finding on them.
    pub(super) fn finding(&self) -> Option<Diagnostic> {
        let times = if self.count == 1 { "once".to_owned() } else { format!("{} times", self.count) };
        let message = format!("a hole is drilled again where the last one is; this happens {times}");
        let finding = Diagnostic::new(&code::ISO_DRILLED_TWICE, message).at(self.first?);
        Some(finding.hint("the place of another hole may be lost before it; count the holes"))
    }
}
