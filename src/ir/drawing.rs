//! What a plot or a drawing draws, in mm: strokes of named pens or layers, and texts. It does not say what is cut.

use super::label::Label;
use crate::geom::{Extent, Point};
use crate::source::Span;

/// Everything that is drawn.
#[derive(Debug, Clone, Default)]
pub struct Drawing {
    /// Places of all strokes, those of one behind the other.
    pub vertices: Vec<Vertex>,
    /// Strokes in the order in which they are drawn.
    pub strokes: Vec<PenStroke>,
    /// The pens or layers that draw, in the order in which they first do.
    pub pens: Vec<Pen>,
    /// Texts; they are never cut.
    pub texts: Vec<Label>,
    /// What else is drawn, and is of kinds that are not read: no stroke stands for it.
    pub unread: Vec<Unread>,
    /// Encoded polylines in the order of the file.
    pub encoded: Vec<Encoded>,
    /// What the numbers of the file are multiples of, mm; 0 when they are not rounded.
    pub unit: f64,
    /// How the file ends.
    pub ending: Ending,
    /// Whether the last stroke goes on.
    goes_on: bool,
}

/// A place that a stroke is led to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Vertex {
    /// The place, mm.
    pub at: Point,
    /// What led there.
    pub span: Span,
}

/// A line between two lifts: places of [`Drawing::vertices`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct PenStroke {
    /// Its first place.
    pub first: u32,
    /// One past its last.
    pub end: u32,
    /// Which of [`Drawing::pens`] draws it.
    pub pen: u16,
}

/// Something that is drawn and not read.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Unread {
    /// What the file calls its kind.
    pub kind: String,
    /// Which of [`Drawing::pens`] draws it.
    pub pen: u16,
    /// Where it begins.
    pub span: Span,
}

/// An encoded polyline: each place hangs on the one before, and each number on all of its bytes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Encoded {
    /// Where it stands.
    pub span: Span,
    /// Bits of a number that one byte holds.
    pub digit_bits: u32,
    /// What one step of a number stands for, mm.
    pub step: f64,
}

/// A pen of a plotter, or a layer.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Pen {
    /// Its number or its name.
    pub name: String,
    /// Whether it leaves a line at all: plotters move without drawing while no pen is taken.
    pub draws: bool,
    /// Whether it is a layer: then its name may say what its lines are.
    pub is_layer: bool,
}

/// How a file ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Ending {
    /// As files end.
    #[default]
    Proper,
    /// With a complete instruction, while the pen draws: what led it there.
    PenDown(Span),
    /// Amid a number that draws, or behind one that may lack digits.
    AmidNumber(Span),
    /// Behind the first coordinate of a pair.
    AmidPair(Span),
}

impl PenStroke {
    /// Its places among the vertices.
    pub fn range(&self) -> std::ops::Range<usize> {
        self.first as usize..self.end as usize
    }
}

impl Drawing {
    /// An empty drawing on a grid of `unit` mm, with room for so many vertices.
    pub fn with_room(unit: f64, vertices: usize) -> Self {
        Self { unit, vertices: Vec::with_capacity(vertices), ..Self::default() }
    }

    /// The pen of that name, which draws from here on; it is new unless it has drawn before.
    pub fn pen(&mut self, name: &str, draws: bool) -> u16 {
        self.pen_or_layer(name, draws, false)
    }

    /// The layer of that name, likewise.
    pub fn layer(&mut self, name: &str) -> u16 {
        self.pen_or_layer(name, true, true)
    }

    fn pen_or_layer(&mut self, name: &str, draws: bool, is_layer: bool) -> u16 {
        let known = self.pens.iter().position(|pen| pen.name == name);
        let place = known.unwrap_or_else(|| {
            self.pens.push(Pen { name: name.to_owned(), draws, is_layer });
            self.pens.len() - 1
        });
        u16::try_from(place).unwrap_or(u16::MAX)
    }

    /// Whether the next line starts a stroke, so that [`Drawing::begin`] comes first.
    pub fn is_lifted(&self) -> bool {
        !self.goes_on
    }

    /// Whether the stroke that goes on has come back to its start.
    pub fn is_closed(&self) -> bool {
        let stroke = self.strokes.last().filter(|_| self.goes_on);
        stroke.is_some_and(|stroke| {
            stroke.end - stroke.first > 1
                && self.vertices[stroke.first as usize].at == self.vertices[stroke.end as usize - 1].at
        })
    }

    /// Starts a stroke.
    pub fn begin(&mut self, at: Point, span: Span, pen: u16) {
        let first = self.vertices.len() as u32;
        self.vertices.push(Vertex { at, span });
        self.strokes.push(PenStroke { first, end: first + 1, pen });
        self.goes_on = true;
    }

    /// Draws on. A line without length changes nothing.
    pub fn line(&mut self, at: Point, span: Span) {
        let (Some(last), Some(stroke)) = (self.vertices.last(), self.strokes.last_mut()) else { return };
        if last.at == at {
            return;
        }
        stroke.end += 1;
        self.vertices.push(Vertex { at, span });
    }

    /// Lifts the pen. A stroke without length is a dot, and none.
    pub fn lift(&mut self) {
        if !std::mem::take(&mut self.goes_on) {
            return;
        }
        if self.strokes.last().is_some_and(|stroke| stroke.end - stroke.first == 1) {
            self.strokes.pop();
            self.vertices.pop();
        }
    }

    /// The box around all strokes.
    pub fn extent(&self) -> Extent {
        let mut extent = Extent::EMPTY;
        self.vertices.iter().for_each(|vertex| extent.add(vertex.at));
        extent
    }
}

/// What the lines of a drawing were taken for, and which of them are not cut. Together with what the marker cuts, this is
/// all that was drawn.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Account {
    /// Lines by what they were taken for, in a fixed order; none without lines.
    pub classes: Vec<LineClass>,
    /// Layers in the order in which they first draw; none of what pens draw.
    pub layers: Vec<LayerLines>,
    /// Way of the pen while it is down, mm; texts that a plotter letters are not in it.
    pub pen_down: f64,
    /// Texts that stand in no part: they belong to no piece.
    pub texts_outside: usize,
    /// What is drawn and not cut.
    pub aside: Aside,
    /// Where notches are asked for that were told and are not cut, once for every piece that lacks one.
    pub notches_left_out: Vec<Span>,
    /// Pieces that cannot be cut and that the selection leaves out: where each begins.
    pub pieces_left_out: Vec<Span>,
}

/// Lines of a drawing that were taken for the same thing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LineClass {
    /// What they were taken for, in a word or two.
    pub name: &'static str,
    /// How they are told from others, in a phrase.
    pub about: &'static str,
    /// Whether these are cut or drilled.
    pub cut: bool,
    /// How many there are.
    pub count: usize,
    /// Length as drawn, mm.
    pub length: f64,
}

/// Lines of a layer.
#[derive(Debug, Clone, PartialEq)]
pub struct LayerLines {
    /// Name of the layer.
    pub name: String,
    /// What is said of its lines, in a word or two.
    pub used: &'static str,
    /// How many there are.
    pub count: usize,
    /// Length as drawn, mm.
    pub length: f64,
}

/// What is drawn and not cut.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Aside {
    /// Places of the lines, those of one behind the other.
    pub vertices: Vec<Vertex>,
    /// The lines.
    pub lines: Vec<AsideLine>,
    /// What joining has changed.
    pub moved: Moved,
}

/// Class of a long open line in no part, which may be an outline with a gap.
pub const OPEN_LINE: &str = "open line";
/// Class of an open line around a closed line: an outline with a gap.
pub const OPEN_OUTLINE: &str = "open outline";
/// Class of the open lines that together make an outline around a closed line.
pub const BROKEN_OUTLINE: &str = "broken outline";

/// A line that is not cut.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AsideLine {
    /// Its first place in [`Aside::vertices`].
    pub first: u32,
    /// One past its last.
    pub end: u32,
    /// What it was taken for; `None` for the way back of a mark that is drawn out and back.
    pub class: Option<&'static str>,
}

impl Aside {
    /// Each line: what it was taken for, and its places.
    pub fn each(&self) -> impl Iterator<Item = (Option<&'static str>, &[Vertex])> {
        self.lines.iter().map(|line| (line.class, &self.vertices[line.first as usize..line.end as usize]))
    }

    /// Adds a line.
    pub fn add(&mut self, class: Option<&'static str>, vertices: &[Vertex]) {
        let first = self.vertices.len() as u32;
        self.vertices.extend_from_slice(vertices);
        self.lines.push(AsideLine { first, end: self.vertices.len() as u32, class });
    }
}

/// What lines were before they were joined and straightened.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Moved {
    /// Places that lines no longer have of their own: where two meet that one instruction of the file draws, and those
    /// that a straight stroke has on its way.
    pub points: usize,
    /// Lines that were drawn a little otherwise.
    pub redrawn: Vec<Redrawn>,
    /// Lines that nobody drew: each closes an outline that is cut, from its last place to its first.
    pub closed: Vec<Vec<Point>>,
    /// Edges that are drawn once and bound two parts: each as it stands a second time.
    pub doubled: Vec<Vec<Vertex>>,
    /// Places that lines have more than were drawn: where others meet them, and on edges that stand twice.
    pub repeated: usize,
}

/// A line that was drawn a little otherwise than it is now.
#[derive(Debug, Clone, PartialEq)]
pub struct Redrawn {
    /// Its places as drawn, mm.
    pub drawn: Vec<Point>,
    /// Where it starts and ends now; both may be the same place.
    pub now: [Point; 2],
}
