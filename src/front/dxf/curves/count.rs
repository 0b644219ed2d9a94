//! Counts of pieces whose curves their outlines do not have in the file.

use super::curved::{Curved, Origin};
use crate::source::Span;

/// How many pieces are cut along curves that their outlines do not have in the file, by where these are from.
#[derive(Debug, Clone, Copy, Default)]
pub(in crate::front::dxf) struct CurvedPieces {
    pub(in crate::front::dxf) fine: CurvedFrom,
    pub(in crate::front::dxf) laid: CurvedFrom,
    /// Pieces with fine lines that miss vertices of their lines, and are not used.
    pub(in crate::front::dxf) missed: CurvedFrom,
}

/// Pieces with curves from one origin.
#[derive(Debug, Clone, Copy, Default)]
pub(in crate::front::dxf) struct CurvedFrom {
    pub(in crate::front::dxf) pieces: usize,
    /// How far the curves leave the chords, mm.
    pub(in crate::front::dxf) off: f64,
    pub(in crate::front::dxf) first: Span,
}

impl CurvedFrom {
    /// Counts the lines of a piece as one.
    fn add(&mut self, those: Self) {
        if those.pieces > 0 {
            self.first = if self.pieces == 0 { those.first } else { self.first };
            self.pieces += 1;
            self.off = self.off.max(those.off);
        }
    }
}

impl CurvedPieces {
    /// Counts a line of a piece.
    pub(in crate::front::dxf) fn see(&mut self, curved: &Curved) {
        let first = curved.line.vertices.first().map_or(Span::default(), |vertex| vertex.span);
        let line = CurvedFrom { pieces: 1, off: curved.off, first };
        if let Some(first) = curved.missed {
            self.missed.add(CurvedFrom { pieces: 1, off: 0.0, first });
        }
        match curved.origin {
            Origin::Drawn => {}
            Origin::Fine => self.fine.add(line),
            Origin::Laid => self.laid.add(line),
        }
    }

    /// Counts the lines of a piece as one.
    pub(in crate::front::dxf) fn add(&mut self, those: Self) {
        self.fine.add(those.fine);
        self.laid.add(those.laid);
        self.missed.add(those.missed);
    }
}
