//! Strokes with their measures, what a user or a profile says of them, and what they are taken for.

use super::drawing::{Drawing, NO_PEN, Stroke, Vertex, moments};
use super::spike::{Measure, prune};
use crate::geom::moments::Moments;
use crate::geom::{Extent, Point, cross};
use crate::machine::Job;
use crate::machine::plot::{LineKind, PenUse};

/// What a line is taken for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Class {
    /// The outline of a part.
    Part,
    /// A closed line inside a part.
    CutOut,
    /// A mark on an outline.
    Notch,
    /// A hole to drill.
    Hole,
    /// An open line that is cut, since a pen or an option says so.
    Line,
    /// A rectangle around everything.
    Frame,
    /// A letter.
    Text,
    /// A line that is none of these.
    Other,
    /// A line of a pen that is no knife.
    Pen,
}

/// Every class in the order in which they are shown, with its name.
pub(super) const CLASSES: [(Class, &str); 9] = [
    (Class::Part, "part"),
    (Class::CutOut, "cut-out"),
    (Class::Notch, "notch"),
    (Class::Hole, "hole"),
    (Class::Line, "cut line"),
    (Class::Frame, "frame"),
    (Class::Text, "text"),
    (Class::Other, "other line"),
    (Class::Pen, "other pen"),
];

impl Class {
    /// Whether such lines are cut or drilled.
    pub(super) fn is_cut(self) -> bool {
        match self {
            Self::Part | Self::CutOut | Self::Notch | Self::Hole | Self::Line => true,
            Self::Frame | Self::Text | Self::Other | Self::Pen => false,
        }
    }
}

/// Which lines are cut, as far as pens and options say.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Wanted {
    /// What its shape says.
    Guess,
    /// Every line.
    All,
    /// Those that close.
    Closed,
    /// Those that do not.
    Open,
    /// None: it is no knife's.
    Nothing,
}

/// What is wanted of a pen.
pub(super) fn wanted(pen: u16, job: &Job) -> Wanted {
    let is_knife = match (&job.lines.pens, job.profile.hpgl.pen(pen)) {
        (Some(pens), _) if pens.has(pen.into()) => true,
        (Some(_), _) | (None, Some(PenUse::Pen | PenUse::Ignore)) => return Wanted::Nothing,
        (None, Some(PenUse::Knife)) => true,
        // Pen 0 is no pen: what the plotter does then draws nothing.
        (None, None) if pen == NO_PEN => return Wanted::Nothing,
        (None, None) => false,
    };
    match job.lines.kind {
        Some(LineKind::All) => Wanted::All,
        Some(LineKind::Closed) => Wanted::Closed,
        Some(LineKind::Open) => Wanted::Open,
        None if is_knife => Wanted::All,
        None => Wanted::Guess,
    }
}

/// A stroke with its measures.
#[derive(Debug, Clone, Copy)]
pub(super) struct Shape {
    pub(super) stroke: Stroke,
    pub(super) wanted: Wanted,
    /// Whether it ends where it starts and has an inside.
    pub(super) is_closed: bool,
    /// Whether it goes around something and crosses itself so that the halves cancel each other, like an eight.
    pub(super) is_crossed: bool,
    /// Whether it goes out and straight back somewhere.
    pub(super) has_spikes: bool,
    /// mm.
    pub(super) length: f64,
    /// mm2; positive when it runs counter-clockwise.
    pub(super) area: f64,
    pub(super) class: Class,
}

/// Two places nearer than this, in units of the file, may be one that was rounded twice: the diagonal of a unit.
pub(super) const ROUNDING: f64 = std::f64::consts::SQRT_2;
/// An area below this share of the squared length is the rounding of a line that goes out and back.
const FLAT_EPSILON: f64 = 1e-9;
/// Places of a triangle, its start twice: fewer go around nothing.
pub(super) const LEAST_CORNERS: usize = 4;
/// Shortest line that may be an outline with a gap, mm: shorter ones are letters.
pub(super) const SHORTEST_OUTLINE: f64 = 100.0;
/// Shortest line that is named for its gap, mm.
pub(super) const SHORTEST_NAMED: f64 = 40.0;
/// A gap below this share of its length looks like one.
const GAP_SHARE: f64 = 0.05;
/// Longest notch, mm.
pub(super) const LONGEST_NOTCH: f64 = 25.0;
/// Shortest notch, mm: shorter ones are ticks of the drawing.
pub(super) const SHORTEST_NOTCH: f64 = 1.0;

impl Shape {
    /// Measures a stroke.
    pub(super) fn of(drawing: &Drawing, stroke: Stroke, job: &Job) -> Self {
        let vertices = &drawing.vertices[stroke.range()];
        let origin = vertices[0].at;
        let (mut length, mut doubled, mut has_spikes) = (0.0, 0.0, false);
        let unit = job.profile.hpgl.unit.mm();
        let mut before = origin;
        for pair in vertices.windows(2) {
            let (from, to) = (pair[0].at, pair[1].at);
            length += (to - from).norm();
            doubled += cross(from - origin, to - origin);
            has_spikes |= is_near(before, to, unit);
            before = from;
        }
        let ends_meet = origin == vertices[vertices.len() - 1].at;
        has_spikes |= ends_meet && is_near(vertices[vertices.len() - 2].at, vertices[1].at, unit);
        let is_flat = doubled.abs() <= FLAT_EPSILON * length * length;
        let wanted = wanted(stroke.pen, job);
        let is_crossed = ends_meet && is_flat && !is_retraced(vertices, unit);
        // Nobody can tell whether an eight is an outline or a digit, so somebody must ask for it.
        let is_asked = match wanted {
            Wanted::All | Wanted::Closed => true,
            Wanted::Guess | Wanted::Open | Wanted::Nothing => false,
        };
        let is_closed = ends_meet && (!is_flat || is_crossed && is_asked);
        Self { stroke, wanted, is_closed, is_crossed, has_spikes, length, area: doubled / 2.0, class: Class::Other }
    }

    /// Its places.
    pub(super) fn vertices<'a>(&self, drawing: &'a Drawing) -> &'a [Vertex] {
        &drawing.vertices[self.stroke.range()]
    }

    /// Places that the pen was led to.
    pub(super) fn points(&self) -> isize {
        (self.stroke.points as usize).cast_signed()
    }

    /// Where it lies.
    pub(super) fn moments(&self, drawing: &Drawing) -> Moments {
        moments(self.vertices(drawing))
    }

    /// Its box, mm.
    pub(super) fn extent(&self) -> &Extent {
        &self.stroke.extent
    }

    /// Greater side of its box, mm.
    pub(super) fn size(&self) -> f64 {
        let (width, height) = self.extent().size();
        width.max(height)
    }

    /// Distance of its ends, mm, when it may be an outline that was meant to close.
    pub(super) fn gap(&self, drawing: &Drawing) -> Option<f64> {
        let vertices = self.vertices(drawing);
        let gap = (vertices[vertices.len() - 1].at - vertices[0].at).norm();
        let is_outline = !self.is_closed && gap > 0.0 && self.length >= SHORTEST_NAMED && vertices.len() > 3;
        (is_outline && gap < GAP_SHARE * self.length).then_some(gap)
    }

    /// Whether it may be an outline.
    pub(super) fn is_outline(&self) -> bool {
        let may_close = match self.wanted {
            Wanted::Guess | Wanted::All | Wanted::Closed => true,
            Wanted::Open | Wanted::Nothing => false,
        };
        may_close && self.is_closed
    }
}

/// Whether a line without area goes out and back the same way, on one straight line or along others.
fn is_retraced(vertices: &[Vertex], unit: f64) -> bool {
    let origin = vertices[0].at;
    let far = vertices.iter().map(|vertex| vertex.at - origin).max_by(|a, b| a.norm().total_cmp(&b.norm()));
    let way = far.unwrap_or_default();
    let is_straight = vertices.iter().all(|v| cross(way, v.at - origin).abs() <= ROUNDING * unit * way.norm());
    is_straight || prune(vertices, Measure { unit, longest: f64::INFINITY }).vertices.len() < LEAST_CORNERS
}

/// Whether two places are one but for rounding.
pub(super) fn is_near(a: Point, b: Point, unit: f64) -> bool {
    let (reach, gap) = (ROUNDING * unit, a - b);
    gap.x.abs() <= reach && gap.y.abs() <= reach
}

/// A mark that may be a notch: one line, or two that meet at its tip.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Mark {
    /// From one end to the other, or there and back.
    Line([Point; 2]),
    /// Two legs; the ends of the mouth, and the tip.
    Vee { mouth: [Point; 2], apex: Point },
}

impl Mark {
    /// Its ends.
    pub(super) fn ends(&self) -> [Point; 2] {
        match *self {
            Self::Line(ends) | Self::Vee { mouth: ends, .. } => ends,
        }
    }
}

/// The mark that a stroke is by its shape.
pub(super) fn mark(vertices: &[Vertex], unit: f64) -> Option<Mark> {
    let is_notch = |a: Point, b: Point| (SHORTEST_NOTCH..=LONGEST_NOTCH).contains(&(b - a).norm());
    match vertices {
        [a, b] if is_notch(a.at, b.at) => Some(Mark::Line([a.at, b.at])),
        [a, b, c] if is_near(a.at, c.at, unit) && is_notch(a.at, b.at) => Some(Mark::Line([a.at, b.at])),
        // The chords of an arc are no legs.
        [a, b, c] if b.span != c.span && is_notch(a.at, b.at) && is_notch(b.at, c.at) => {
            Some(Mark::Vee { mouth: [a.at, c.at], apex: b.at })
        }
        _ => None,
    }
}
