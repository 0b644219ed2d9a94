//! Counts of pieces that are cut along curves, by the origin of the curves.

use super::curve::{Curve, Origin};
use crate::source::Span;

/// Counts of pieces that are cut along curves instead of the chords of their outlines.
#[derive(Debug, Clone, Copy, Default)]
pub(in crate::front::pattern) struct CurveCounts {
    pub(in crate::front::pattern) fine: CurveCount,
    pub(in crate::front::pattern) laid: CurveCount,
    /// Pieces with fine lines that miss vertices of the outline; those lines are ignored.
    pub(in crate::front::pattern) missed: CurveCount,
    /// Pieces with such lines that are cut along the chords.
    pub(in crate::front::pattern) chords: CurveCount,
    /// Pieces with curve points that mark no vertex.
    pub(in crate::front::pattern) stray: CurveCount,
}

/// Count of pieces with curves from one origin.
#[derive(Debug, Clone, Copy, Default)]
pub(in crate::front::pattern) struct CurveCount {
    pub(in crate::front::pattern) pieces: usize,
    /// Largest distance of the curves from the chords, mm.
    pub(in crate::front::pattern) off: f64,
    pub(in crate::front::pattern) first: Span,
}

impl CurveCount {
    /// Merges the count of lines of one piece, as one piece.
    fn add(&mut self, those: Self) {
        if those.pieces > 0 {
            self.first = if self.pieces == 0 { those.first } else { self.first };
            self.pieces += 1;
            self.off = self.off.max(those.off);
        }
    }
}

impl CurveCounts {
    /// Counts a line of a piece.
    pub(in crate::front::pattern) fn see(&mut self, curved: &Curve) {
        let first = curved.line.vertices.first().map_or(Span::default(), |vertex| vertex.span);
        let line = CurveCount { pieces: 1, off: curved.off, first };
        if let Some(first) = curved.missed {
            self.missed.add(CurveCount { pieces: 1, off: 0.0, first });
            if curved.origin == Origin::Drawn {
                self.chords.add(line);
            }
        }
        if let Some(first) = curved.stray {
            self.stray.add(CurveCount { pieces: 1, off: 0.0, first });
        }
        match curved.origin {
            Origin::Drawn => {}
            Origin::Fine => self.fine.add(line),
            Origin::Laid => self.laid.add(line),
        }
    }

    /// Merges the counts of lines of one piece, as one piece.
    pub(in crate::front::pattern) fn add(&mut self, those: Self) {
        self.fine.add(those.fine);
        self.laid.add(those.laid);
        self.missed.add(those.missed);
        self.chords.add(those.chords);
        self.stray.add(those.stray);
    }
}
