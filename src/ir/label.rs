//! Texts of pieces.

use crate::geom::{Heading, Point};
use crate::source::Span;

/// A text that belongs to a piece; never cut.
#[derive(Debug, Clone, PartialEq)]
pub struct Label {
    /// Position; `None` when the file gives none.
    pub at: Option<Point>,
    /// Direction; `None` when the file gives no second point.
    pub heading: Option<Heading>,
    /// Bytes of the text in the source.
    pub span: Span,
    /// Bytes of the form for mirrored pieces; `None` when the file gives none.
    pub mirrored: Option<Span>,
}
