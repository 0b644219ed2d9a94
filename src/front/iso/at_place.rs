//! What a block asks for at the place where it ends.

use super::arc::Turn;
use super::syntax::Code;
use crate::source::Span;

/// What a block asks for at the place where it ends.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct AtPlace {
    /// Whether the knife stays where it is: the point is none to go to.
    pub(super) rests: bool,
    /// A hole, by its tool.
    pub(super) drill: Option<u8>,
    pub(super) label: Option<Texts>,
    /// An arc leads there.
    pub(super) turn: Option<Turn>,
    /// The radius of the arc.
    pub(super) radius: Option<Code>,
    /// Whether a code of the end stands there, obeyed or not, and whether it is the end.
    pub(super) names_end: bool,
    pub(super) ends: bool,
}

/// A drill code: which drill, and its block.
#[derive(Debug, Clone, Copy)]
pub(super) struct Hole {
    pub(super) tool: u8,
    pub(super) span: Span,
}

/// Whether a label is obeyed, or only passed over because the profile ignores M31.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Texts {
    Kept,
    Ignored,
}
