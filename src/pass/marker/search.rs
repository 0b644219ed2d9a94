//! Searches over all pieces: their distribution over threads, and the messages when a search was stopped early.

use crate::diagnostic::{Diagnostic, code};
use crate::geom::budget::Budget;
use crate::ir::marker::Piece;

/// Remedy for a search that was stopped.
const SPLIT: &str = "split the marker, or leave fills, hatchings and patterns of rings out";
/// Number of parts in which the pieces of a marker are searched in parallel: more than the cores of any machine that compiles.
const PARTS: usize = 16;

/// Distribution of the pieces of a marker.
#[derive(Debug, Clone, Copy)]
pub(super) struct Parts {
    /// Number of pieces in a part.
    pub(super) size: usize,
    count: usize,
}

/// Distributes pieces by their number alone, so that every machine finds the same.
pub(super) fn in_parts(pieces: usize) -> Parts {
    let size = pieces.div_ceil(PARTS).max(1);
    Parts { size, count: pieces.div_ceil(size) }
}

impl Parts {
    /// Budget of a search over one part.
    pub(super) fn budget(self) -> Budget {
        Budget::of_a_part(self.count)
    }
}

/// Error of a nesting search that was stopped at a piece: no program may result.
pub(super) fn too_many_outlines(piece: &Piece) -> Diagnostic {
    let message = format!(
        "there are too many outlines in or over one another to tell which lies in which, first at piece {}: parts would be \
         cut before their cut-outs",
        piece.number
    );
    Diagnostic::new(&code::MARKER_TOO_MANY, message).at(piece.span).hint(SPLIT)
}

/// Warning of a search that was stopped early; `left` tells which findings may be missing.
pub(super) fn search_ended(left: &str) -> Diagnostic {
    let message = format!("there are too many lines near one another to look at each pair: {left}");
    Diagnostic::new(&code::MARKER_SEARCH_ENDED, message).hint(SPLIT)
}
