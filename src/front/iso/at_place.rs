//! Actions of a block at its end position.

use super::arc::Turn;
use super::syntax::Code;
use crate::source::Span;

/// Actions of a block at its end position.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct AtPlace {
    /// True if the knife does not move: the point of the block is not a destination.
    pub(super) rests: bool,
    /// Tool number of a hole.
    pub(super) drill: Option<u8>,
    pub(super) label: Option<Texts>,
    /// Direction of an arc to the position.
    pub(super) turn: Option<Turn>,
    /// Radius code of the arc.
    pub(super) radius: Option<Code>,
    /// True if the block has an end code, obeyed or not, and true if it ends the file.
    pub(super) names_end: bool,
    pub(super) ends: bool,
}

/// A drill code: its tool and its block.
#[derive(Debug, Clone, Copy)]
pub(super) struct Hole {
    pub(super) tool: u8,
    pub(super) span: Span,
}

/// Treatment of a label: kept, or skipped because the profile ignores M31.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Texts {
    Kept,
    Ignored,
}
