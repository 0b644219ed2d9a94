//! Patterns before stitches are laid: seams as lines, each with an element.

use crate::geom::Point;
use crate::machine::sewing::Ends;
use crate::source::Span;

/// Distance within which points are equal, mm: far below a step of any machine.
pub(super) const SAME_EPSILON: f64 = 1e-6;

/// A line without consecutive equal points.
pub(super) fn distinct(points: &[Point]) -> Vec<Point> {
    let mut distinct = points.to_vec();
    distinct.dedup_by(|next, last| (*next - *last).norm() <= SAME_EPSILON);
    distinct
}

/// Kind of stitching along a line.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Element {
    /// Stitches on the line.
    Straight,
    /// Stitches from side to side of the line.
    Zigzag,
    /// A narrow, close zigzag over a straight underlay; it holds pocket corners and belt loops.
    BarTack,
    /// A box along four corners and its two diagonals, without a thread cut.
    BoxX,
    /// Close stitches from rail to rail; the points of the seam alternate between both rails.
    Satin,
    /// A close zigzag over a straight underlay around a hole.
    Eyelet,
}

/// Meaning of the points of a seam in its file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Shape {
    /// A line from point to point, or rungs of a satin.
    Line,
    /// An arc: its start, a point on it, its end.
    Arc,
    /// A circle: its centre, a point on it.
    Circle,
}

impl Element {
    /// All elements with their words in files.
    pub const WORDS: [(&'static str, Self); 6] = [
        ("straight", Self::Straight),
        ("zigzag", Self::Zigzag),
        ("bar-tack", Self::BarTack),
        ("box-x", Self::BoxX),
        ("satin", Self::Satin),
        ("eyelet", Self::Eyelet),
    ];
}

/// A line and its element.
#[derive(Debug, Clone, PartialEq)]
pub struct Seam {
    /// Points, mm; a closed seam ends with its first point.
    pub points: Vec<Point>,
    /// Meaning of its points in the file.
    pub shape: Shape,
    /// Points in the file of an arc or circle, as drawn; empty for a line.
    pub marks: Vec<Point>,
    /// Kind of stitching.
    pub element: Element,
    /// Locking of its start and of its end; `None` for that of the profile.
    pub ends: [Option<Ends>; 2],
    /// Stitch length, or advance with each stitch, mm; `None` for that of the profile.
    pub pitch: Option<f64>,
    /// Width, mm; `None` for that of the profile.
    pub width: Option<f64>,
    /// Greatest speed, stitches per minute; `None` for that of the profile.
    pub rpm: Option<f64>,
    /// Number of its thread, from 1.
    pub thread: u16,
    /// Its number in the sewing order; `None` for a seam that is sewn after all that have one.
    pub order: Option<u16>,
    /// True if the machine waits for its operator before the seam.
    pub stop: bool,
    /// Location of its start in the source.
    pub span: Span,
}

impl Seam {
    /// A straight seam of the first thread.
    pub fn plain(points: Vec<Point>, span: Span) -> Self {
        let (shape, marks, element, ends) = (Shape::Line, Vec::new(), Element::Straight, [None; 2]);
        Self {
            points,
            shape,
            marks,
            element,
            ends,
            pitch: None,
            width: None,
            rpm: None,
            thread: 1,
            order: None,
            stop: false,
            span,
        }
    }

    /// True if the seam ends at its start.
    pub fn is_closed(&self) -> bool {
        self.points.len() > 2 && self.points.first() == self.points.last()
    }
}

/// Seams in order.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Pattern {
    /// The seams.
    pub seams: Vec<Seam>,
}
