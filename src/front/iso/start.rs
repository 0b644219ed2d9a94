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
    /// The piece or label that began without a place since then, the more doubtful one of several.
    begun: Option<(Begun, Span)>,
}

/// Beginning of something between two contours.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Begun {
    /// N.
    Piece,
    /// A label.
    Label,
    /// A label whose text ends like a place.
    HoldsPlace,
}

impl Begun {
    /// A label, by its text.
    pub(super) fn label(text: &[u8]) -> Self {
        let before = |text: &[u8], letter: u8| {
            let at = text.iter().rposition(|byte| !byte.is_ascii_digit() && !b"+-.".contains(byte))?;
            (text[at] == letter && at + 1 < text.len()).then_some(at)
        };
        let place = before(text, b'Y').and_then(|at| before(&text[..at], b'X'));
        if place.is_some() { Self::HoldsPlace } else { Self::Label }
    }
}

impl Start {
    /// Records a lift or a hole: the place of the knife has served.
    pub(super) fn serve(&mut self) {
        *self = Self::default();
    }

    /// True if the knife has moved since its last lift.
    pub(super) fn has_moved(&self) -> bool {
        self.has_moved
    }

    /// Records a place in the air.
    pub(super) fn go(&mut self) {
        (self.has_moved, self.begun) = (true, None);
    }

    /// Records a piece or a label. `is_amid` is true where an interrupted contour may go on from.
    pub(super) fn begin(&mut self, begun: Begun, span: Span, is_amid: bool) {
        let is_first = self.begun.is_none_or(|(before, _)| before < begun);
        if !self.has_moved && !is_amid && is_first {
            self.begun = Some((begun, span));
        }
    }

    /// The finding on a plunge at a block, if something has begun and no place was given since. A contour may start where the
    /// last one has ended.
    pub(super) fn finding(&self, span: Span) -> Option<Diagnostic> {
        let (begun, Span { block, .. }) = self.begun?;
        let what = if begun == Begun::Piece { "piece" } else { "label" };
        let message = format!("the knife goes down without a place since the {what} in block {block}");
        Some(if begun == Begun::HoldsPlace {
            let finding = Diagnostic::new(&code::ISO_NO_START, message).at(span);
            finding.hint("the place may stand in the text of the label, whose `*` is lost; transfer the file again")
        } else {
            let finding = Diagnostic::new(&code::ISO_START_AT_END, message).at(span);
            finding.hint("the place where the contour starts may be lost: see it in the picture (-t svg)")
        })
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_place_at_the_end_of_a_label_is_told_from_its_text() {
        for text in ["BACKX3000Y0", "X-3000Y+0.5", "BACK X1Y2"] {
            assert_eq!(Begun::label(text.as_bytes()), Begun::HoldsPlace, "{text}");
        }
        for text in ["", "BACK", "BACK X2", "SIZE 40", "XY", "X1Y", "XY1", "X1Y1 BACK"] {
            assert_eq!(Begun::label(text.as_bytes()), Begun::Label, "{text}");
        }
    }
}
