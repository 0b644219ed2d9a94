//! Searches over all pieces: how they are shared out, and what is said when one was ended before its time.

use crate::diagnostic::{Diagnostic, code};
use crate::geom::budget::Budget;
use crate::ir::marker::Piece;

/// What helps where a search was ended.
const SPLIT: &str = "split the marker, or leave fills, hatchings and patterns of rings out";
/// Parts in which the pieces of a marker are looked at side by side: more than any machine that compiles has cores.
const PARTS: usize = 16;

/// How the pieces of a marker are shared out.
#[derive(Debug, Clone, Copy)]
pub(super) struct Parts {
    /// Pieces in a part.
    pub(super) size: usize,
    count: usize,
}

/// Shares out pieces; their number alone decides, so that every machine finds the same.
pub(super) fn in_parts(pieces: usize) -> Parts {
    let size = pieces.div_ceil(PARTS).max(1);
    Parts { size, count: pieces.div_ceil(size) }
}

impl Parts {
    /// What a search over one of them may do.
    pub(super) fn budget(self) -> Budget {
        Budget::of_a_part(self.count)
    }
}

/// The search for what lies in what was ended at a piece: no program may come of it.
pub(super) fn too_many_outlines(piece: &Piece) -> Diagnostic {
    let message = format!(
        "there are too many outlines in or over one another to tell which lies in which, first at piece {}: parts would be \
         cut before their cut-outs",
        piece.number
    );
    Diagnostic::new(&code::MARKER_TOO_MANY, message).at(piece.span).hint(SPLIT)
}

/// The search for something was ended before its time; `left` says what of it may be left.
pub(super) fn search_ended(left: &str) -> Diagnostic {
    let message = format!("there are too many lines near one another to look at each pair: {left}");
    Diagnostic::new(&code::MARKER_SEARCH_ENDED, message).hint(SPLIT)
}
