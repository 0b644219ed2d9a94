//! Lines of a drawing with their measures, and the table of their classes.

use super::pens::Use;
use crate::geom::{Extent, Point, cross};
use crate::ir::drawing::{BROKEN_OUTLINE, OPEN_LINE, OPEN_OUTLINE, Vertex};
use crate::source::Span;

/// Class of a line.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Class {
    Part,
    Notch,
    Hole,
    Inner,
    Seam,
    Sign,
    SmallOutline,
    Outside,
    FromEdge,
    OpenLine,
    OpenOutline,
    BrokenOutline,
    Letter,
    Frame,
    Other,
    Again,
    Ignored,
}

/// Condition on which lines of a class are cut.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Cut {
    /// Always, unless their pen only draws.
    Always,
    /// If their pen is explicitly a knife.
    Knife,
    /// If their pen is a knife, or if inner lines are requested.
    Inner,
    /// If seam lines are requested as well.
    All,
    /// If every line is requested.
    Every,
    /// Never.
    Never,
}

/// Row of the table.
#[derive(Debug)]
pub(super) struct Rule {
    pub(super) class: Class,
    /// Name for people.
    pub(super) name: &'static str,
    /// Distinguishing feature; the first row that fits a line applies.
    pub(super) about: &'static str,
    pub(super) cut: Cut,
}

/// Classes of lines, in the order in which they are shown, and their conditions for being cut: a wrong cut inside a part cannot
/// be mended, a missing one can.
#[rustfmt::skip] // a table: one row a class
pub(super) const RULES: [Rule; 17] = [
    Rule { class: Class::Part, name: "part", about: "an outermost closed line", cut: Cut::Always },
    Rule { class: Class::Notch, name: "notch", about: "a stroke of 1 to 15 mm from the edge of a part inwards, or from edge to edge", cut: Cut::Always },
    Rule { class: Class::Hole, name: "hole", about: "a closed square or circle up to hpgl.drill_max_mm, drilled", cut: Cut::Always },
    Rule { class: Class::Inner, name: "inner line", about: "a closed line inside a part that is not its seam line", cut: Cut::Inner },
    Rule { class: Class::Seam, name: "seam line", about: "a closed line that follows the outline around it from inside", cut: Cut::All },
    Rule { class: Class::Sign, name: "small sign", about: "a closed line below 10 mm", cut: Cut::Every },
    Rule { class: Class::SmallOutline, name: "small outline", about: "a closed line of 10 to 25 mm in no part", cut: Cut::Knife },
    Rule { class: Class::Outside, name: "outside line", about: "a closed line outside the frame", cut: Cut::Every },
    Rule { class: Class::FromEdge, name: "line from edge", about: "an open line from the edge of a part that is no notch", cut: Cut::Every },
    Rule { class: Class::OpenLine, name: OPEN_LINE, about: "an open line of 100 mm or more in no part, which may be an outline", cut: Cut::Every },
    Rule { class: Class::OpenOutline, name: OPEN_OUTLINE, about: "an open line around a closed one, which is no part", cut: Cut::Every },
    Rule { class: Class::BrokenOutline, name: BROKEN_OUTLINE, about: "one of some open lines around a closed one, which is no part", cut: Cut::Every },
    Rule { class: Class::Letter, name: "letter", about: "one of a row of small strokes", cut: Cut::Every },
    Rule { class: Class::Frame, name: "frame", about: "a rectangle around all parts", cut: Cut::Never },
    Rule { class: Class::Other, name: "other line", about: "an open line", cut: Cut::Every },
    Rule { class: Class::Again, name: "drawn again", about: "a line in the places of another one", cut: Cut::Never },
    Rule { class: Class::Ignored, name: "ignored pen", about: "a line of a pen that does not matter", cut: Cut::Never },
];

impl Class {
    pub(super) fn rule(self) -> &'static Rule {
        RULES.iter().find(|rule| rule.class == self).expect("the table has every class")
    }
}

/// Distance within which two places may be one that was rounded twice, in units of the file: the diagonal of a unit.
pub(super) const ROUNDING: f64 = std::f64::consts::SQRT_2;
/// Least area of a ring, as a share of the squared length: less is the rounding of a line that goes out and back, or of an
/// eight.
const FLAT_EPSILON: f64 = 1e-9;
/// Largest closed line that is not a part, mm.
pub(super) const SMALL_OUTLINE: f64 = 25.0;
/// Largest sign, mm: blades have that width.
pub(super) const SIGN: f64 = 10.0;
/// Shortest notch, mm.
pub(super) const SHORTEST_NOTCH: f64 = 1.0;

/// Way in which a line closes that does not end at its start.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Closing {
    /// Stays as drawn.
    Drawn,
    /// Runs past its start, or goes round again.
    Retraced,
    /// Closes a gap of this length, mm, by a straight line.
    Gap(f64),
    /// Closes by straight bridges between its strokes; length of the longest, mm, and its start.
    Bridged(f64, Point),
    /// Closes along the edge of the frame, over this length, mm.
    Edge(f64),
    /// Nearly encloses something; a gap of this width, mm, stays open.
    Open(f64),
}

/// Line with its measures.
#[derive(Debug, Clone, Copy)]
pub(super) struct Line {
    /// Range of its places among the vertices, end exclusive; those of the ring if it closes in another way than by its last
    /// place.
    pub(super) first: u32,
    pub(super) end: u32,
    /// Range of its places as drawn, end exclusive.
    pub(super) drawn: [u32; 2],
    /// Way in which it closes.
    pub(super) closing: Closing,
    /// Use of its pen.
    pub(super) usage: Use,
    /// True if it ends at its start and has an inside.
    pub(super) is_closed: bool,
    /// True if it is open and connects two places where strokes of other lines meet.
    pub(super) is_between: bool,
    /// Length, mm.
    pub(super) length: f64,
    /// Area, mm2; never negative.
    pub(super) area: f64,
    pub(super) extent: Extent,
    pub(super) class: Class,
    pub(super) is_cut: bool,
}

impl Line {
    /// Measures the line through some places.
    pub(super) fn of(vertices: &[Vertex], first: u32, usage: Use) -> Self {
        let origin = vertices[0].at;
        let (mut length, mut doubled, mut extent) = (0.0, 0.0, Extent::EMPTY);
        extent.add(origin);
        for pair in vertices.windows(2) {
            let (from, to) = (pair[0].at, pair[1].at);
            length += (to - from).norm();
            doubled += cross(from - origin, to - origin);
            extent.add(to);
        }
        let is_flat = doubled.abs() <= FLAT_EPSILON * length * length;
        let is_closed = !is_flat && origin == vertices[vertices.len() - 1].at;
        let class = if usage == Use::Ignore { Class::Ignored } else { Class::Other };
        let end = first + vertices.len() as u32;
        let (drawn, closing) = ([first, end], Closing::Drawn);
        let area = doubled.abs() / 2.0;
        let (is_between, is_cut) = (false, false);
        Self { first, end, drawn, closing, usage, is_closed, is_between, length, area, extent, class, is_cut }
    }

    /// Line with a ring in place of its own places.
    pub(super) fn as_ring(&self, vertices: &[Vertex], first: u32, closing: Closing) -> Self {
        let ring = Self::of(vertices, first, self.usage);
        let is_closed = ring.is_closed && !matches!(closing, Closing::Open(_));
        Self { drawn: self.drawn, length: self.length, class: self.class, closing, is_closed, ..ring }
    }

    /// Places as drawn.
    pub(super) fn as_drawn<'a>(&self, all: &'a [Vertex]) -> &'a [Vertex] {
        &all[self.drawn[0] as usize..self.drawn[1] as usize]
    }

    /// Places, with their spans.
    pub(super) fn vertices<'a>(&self, all: &'a [Vertex]) -> &'a [Vertex] {
        &all[self.first as usize..self.end as usize]
    }

    /// Places, without spans.
    pub(super) fn points(&self, all: &[Vertex]) -> Vec<Point> {
        self.vertices(all).iter().map(|vertex| vertex.at).collect()
    }

    /// Span of its first drawn segment.
    pub(super) fn span(&self, all: &[Vertex]) -> Span {
        self.vertices(all)[1].span
    }

    /// Greater side of its box, mm.
    pub(super) fn size(&self) -> f64 {
        let (width, height) = self.extent.size();
        width.max(height)
    }

    /// True if it is not classified yet.
    pub(super) fn is_open_question(&self) -> bool {
        self.class == Class::Other
    }

    /// True if it is a closed line that may contain others: neither ignored nor a frame.
    pub(super) fn is_outline(&self) -> bool {
        self.is_closed && self.may_hold()
    }

    /// True if it goes around something, with a gap or without.
    pub(super) fn may_hold(&self) -> bool {
        let goes_around = self.is_closed || matches!(self.closing, Closing::Open(_));
        goes_around && !self.is_set_aside() && self.class != Class::Frame
    }

    /// True if it is irrelevant: ignored by its pen, or repeated.
    pub(super) fn is_set_aside(&self) -> bool {
        matches!(self.class, Class::Ignored | Class::Again)
    }

    /// True if it equals its box within rounding.
    pub(super) fn is_rectangle(&self, slack: f64) -> bool {
        let (width, height) = self.extent.size();
        self.area >= width * height - slack * (width + height)
    }
}

/// Greatest distance of a place of a straight stroke from it, mm.
const STRAIGHT: f64 = 0.1;

/// True if a stroke is one straight line, drawn once or there and back.
pub(super) fn is_straight(vertices: &[Vertex]) -> bool {
    let first = vertices[0].at;
    let far = vertices.iter().map(|vertex| vertex.at).max_by(|a, b| (a - first).norm().total_cmp(&(b - first).norm()));
    far.is_some_and(|far| {
        let off = |vertex: &Vertex| crate::geom::polyline::distance_to_segment(vertex.at, first, far);
        vertices.iter().all(|vertex| off(vertex) <= STRAIGHT)
    })
}
