//! What is to be sewn, before a stitch is laid: seams as lines, with what is to be made along each.

use crate::geom::Point;
use crate::machine::sewing::Ends;
use crate::source::Span;

/// Places nearer than this are one, mm: far below a step of any machine.
pub(super) const SAME_EPSILON: f64 = 1e-6;

/// A line without points that repeat the one before them.
pub(super) fn distinct(points: &[Point]) -> Vec<Point> {
    let mut distinct = points.to_vec();
    distinct.dedup_by(|next, last| (*next - *last).norm() <= SAME_EPSILON);
    distinct
}

/// What is made along a line.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Element {
    /// Stitches on the line.
    Straight,
    /// Stitches from side to side of the line.
    Zigzag,
    /// A narrow, close zigzag over an underlay, a straight seam: it holds pocket corners and belt loops.
    BarTack,
    /// A box along four corners and its two diagonals, without a cut of the thread.
    BoxX,
}

impl Element {
    /// Every element, by the word that files have for it.
    pub const WORDS: [(&'static str, Self); 4] =
        [("straight", Self::Straight), ("zigzag", Self::Zigzag), ("bar-tack", Self::BarTack), ("box-x", Self::BoxX)];
}

/// A line, and what is made along it.
#[derive(Debug, Clone, PartialEq)]
pub struct Seam {
    /// Its points, mm; a closed one ends with its first.
    pub points: Vec<Point>,
    /// What is made along it.
    pub element: Element,
    /// How its ends are locked; `None` = as the profile says.
    pub ends: Option<Ends>,
    /// The number of its thread, from 1.
    pub thread: u16,
    /// Whether the machine waits for its operator before it.
    pub stop: bool,
    /// Where it begins in the source.
    pub span: Span,
}

impl Seam {
    /// A straight seam of the first thread.
    pub fn plain(points: Vec<Point>, span: Span) -> Self {
        Self { points, element: Element::Straight, ends: None, thread: 1, stop: false, span }
    }

    /// Whether it ends where it starts.
    pub fn is_closed(&self) -> bool {
        self.points.len() > 2 && self.points.first() == self.points.last()
    }
}

/// What is to be sewn, in order.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Pattern {
    /// The seams.
    pub seams: Vec<Seam>,
}
