//! A text of a piece.

use crate::geom::{Heading, Point};
use crate::source::Span;

/// A text that belongs to a piece; never cut.
#[derive(Debug, Clone, PartialEq)]
pub struct Label {
    /// Where it stands; `None` when the file gives no place.
    pub at: Option<Point>,
    /// Its direction, when the file gives a second point.
    pub heading: Option<Heading>,
    /// The bytes of the text in the source.
    pub span: Span,
    /// The bytes of the form that it takes on mirrored pieces, when the file gives one.
    pub mirrored: Option<Span>,
}
