//! Counts of pieces that are cut along curves, by the origin of the curves.

use super::curve::Curve;
use super::fine::FineLayers;
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
    /// Layers of the fine lines.
    pub(in crate::front::pattern) layers: FineLayers,
}

impl CurveCount {
    /// Merges the count of lines of one piece, as one piece.
    fn add(&mut self, those: Self) {
        if those.pieces > 0 {
            self.first = if self.pieces == 0 { those.first } else { self.first };
            self.pieces += 1;
            self.off = self.off.max(those.off);
            self.layers.join(those.layers);
        }
    }
}

impl CurveCounts {
    /// Counts a line of a piece.
    pub(in crate::front::pattern) fn see(&mut self, curved: &Curve) {
        let first = curved.line.vertices.first().map_or(Span::default(), |vertex| vertex.span);
        let layers = curved.layers;
        let count = |off: f64| CurveCount { pieces: 1, off, first, layers };
        if let Some((first, layers)) = curved.missed {
            self.missed.add(CurveCount { pieces: 1, off: 0.0, first, layers });
            if curved.fine.is_none() && curved.laid.is_none() {
                self.chords.add(count(0.0));
            }
        }
        if let Some(first) = curved.stray {
            self.stray.add(CurveCount { pieces: 1, off: 0.0, first, layers });
        }
        curved.fine.into_iter().for_each(|off| self.fine.add(count(off)));
        curved.laid.into_iter().for_each(|off| self.laid.add(count(off)));
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
