//! Passes over the marker.

use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::geom::budget::Budget;
use crate::ir::Marker;
use crate::ir::marker::Piece;
use crate::machine::Job;

mod cut;
mod depth;
mod inspect;
mod notch;
mod order;
mod sanity;
mod select;
mod slit;
mod spike;
mod table;
mod weld;

/// A pass over the marker: a row of [`MARKER_PASSES`].
#[derive(Debug)]
pub struct MarkerPass {
    /// Name, as `--dump-after` takes it.
    pub name: &'static str,
    /// What it does, in a line.
    pub about: &'static str,
    /// Does it.
    pub run: fn(&mut Marker, &Job, &mut Diagnostics),
}

/// Every pass over the marker, in order.
pub const MARKER_PASSES: &[MarkerPass] = &[
    weld::PASS,
    spike::PASS,
    slit::PASS,
    inspect::PASS,
    order::PASS,
    notch::PASS,
    sanity::PASS,
    select::PASS,
    table::PASS,
    cut::PASS,
];

/// What helps where a search was ended.
const SPLIT: &str = "split the marker, or leave fills, hatchings and patterns of rings out";
/// Parts in which the pieces of a marker are looked at side by side: more than any machine that compiles has cores.
const PARTS: usize = 16;

/// How the pieces of a marker are shared out.
#[derive(Debug, Clone, Copy)]
struct Parts {
    /// Pieces in a part.
    size: usize,
    count: usize,
}

/// Shares out pieces; their number alone decides, so that every machine finds the same.
fn in_parts(pieces: usize) -> Parts {
    let size = pieces.div_ceil(PARTS).max(1);
    Parts { size, count: pieces.div_ceil(size) }
}

impl Parts {
    /// What a search over one of them may do.
    fn budget(self) -> Budget {
        Budget::of_a_part(self.count)
    }
}

/// The search for what lies in what was ended at a piece: no program may come of it.
fn too_many_outlines(piece: &Piece) -> Diagnostic {
    let message = format!(
        "there are too many outlines in or over one another to tell which lies in which, first at piece {}: parts would be \
         cut before their cut-outs",
        piece.number
    );
    Diagnostic::new(&code::MARKER_TOO_MANY, message).at(piece.span).hint(SPLIT)
}

/// The search for something was ended before its time; `left` says what of it may be left.
fn search_ended(left: &str) -> Diagnostic {
    let message = format!("there are too many lines near one another to look at each pair: {left}");
    Diagnostic::new(&code::MARKER_SEARCH_ENDED, message).hint(SPLIT)
}
