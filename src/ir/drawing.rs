//! Lines and texts of a plot or a drawing, in mm: strokes of named pens or layers. It does not tell which lines are cut.

use super::label::Label;
use crate::geom::{Extent, Point};
use crate::source::Span;

/// A drawing.
#[derive(Debug, Clone, Default)]
pub struct Drawing {
    /// Vertices of all strokes, stroke after stroke.
    pub vertices: Vec<Vertex>,
    /// Strokes in the order in which they are drawn.
    pub strokes: Vec<PenStroke>,
    /// Pens or layers, in the order of their first use.
    pub pens: Vec<Pen>,
    /// Texts; they are never cut.
    pub texts: Vec<Label>,
    /// Other drawn items, of kinds that are not read: no stroke stands for them.
    pub unread: Vec<Unread>,
    /// Encoded polylines in the order of the file.
    pub encoded: Vec<Encoded>,
    /// Rows of places that the pen passes in the air as if it drew an outline.
    pub passed: Vec<Vec<Vertex>>,
    /// Grid of the numbers in the file, mm; 0 when they are not rounded.
    pub unit: f64,
    /// End of the file.
    pub ending: Ending,
    /// True while the last stroke continues.
    goes_on: bool,
}

/// A point of a stroke.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Vertex {
    /// The place, mm.
    pub at: Point,
    /// Source of the instruction that led there.
    pub span: Span,
}

/// A line between two lifts: a range of [`Drawing::vertices`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct PenStroke {
    /// Index of its first vertex.
    pub first: u32,
    /// Index after its last vertex.
    pub end: u32,
    /// Index of its pen in [`Drawing::pens`].
    pub pen: u16,
}

/// A drawn item that is not read.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Unread {
    /// Name of its kind in the file.
    pub kind: String,
    /// Index of its pen in [`Drawing::pens`].
    pub pen: u16,
    /// Its start in the source.
    pub span: Span,
}

/// An encoded polyline: each vertex depends on the one before, and each number on all of its bytes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Encoded {
    /// Its place in the source.
    pub span: Span,
    /// Number of bits that one byte holds.
    pub digit_bits: u32,
    /// Length of one step of a number, mm.
    pub step: f64,
}

/// A pen of a plotter, or a layer.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Pen {
    /// Its number or its name.
    pub name: String,
    /// True if it leaves a line: plotters move without drawing while no pen is selected.
    pub draws: bool,
    /// True if it is a layer: then its name may tell the meaning of its lines.
    pub is_layer: bool,
}

/// Completeness of the end of a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Ending {
    /// Complete.
    #[default]
    Proper,
    /// Complete instruction, but the pen is still down; the span is that of the last instruction.
    PenDown(Span),
    /// In the middle of a number that draws, or after one that may lack digits.
    AmidNumber(Span),
    /// After the first coordinate of a pair.
    AmidPair(Span),
}

impl PenStroke {
    /// Range of its vertices.
    pub fn range(&self) -> std::ops::Range<usize> {
        self.first as usize..self.end as usize
    }
}

impl Drawing {
    /// An empty drawing on a grid of `unit` mm, with capacity for `vertices` vertices.
    pub fn with_room(unit: f64, vertices: usize) -> Self {
        Self { unit, vertices: Vec::with_capacity(vertices), ..Self::default() }
    }

    /// Selects the pen of that name; it is new unless it has drawn before.
    pub fn pen(&mut self, name: &str, draws: bool) -> u16 {
        self.pen_or_layer(name, draws, false)
    }

    /// Selects the layer of that name; it is new unless it has drawn before.
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

    /// True if the pen is up, so that [`Drawing::begin`] must come before the next line.
    pub fn is_lifted(&self) -> bool {
        !self.goes_on
    }

    /// True if the current stroke has returned to its start.
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

    /// Extends the stroke. A line without length changes nothing.
    pub fn line(&mut self, at: Point, span: Span) {
        let (Some(last), Some(stroke)) = (self.vertices.last(), self.strokes.last_mut()) else { return };
        if last.at == at {
            return;
        }
        stroke.end += 1;
        self.vertices.push(Vertex { at, span });
    }

    /// Lifts the pen. A stroke without length is a dot and is dropped.
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

/// Classification of the lines of a drawing, and the lines that are not cut. With the cuts of the marker it covers everything
/// that was drawn.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Account {
    /// Lines by class, in a fixed order; empty without lines.
    pub classes: Vec<LineClass>,
    /// Layers in the order of their first use; empty for pens.
    pub layers: Vec<LayerLines>,
    /// Length of lines drawn with the pen down, mm, without texts that a plotter letters.
    pub pen_down: f64,
    /// Number of texts in no part: they belong to no piece.
    pub texts_outside: usize,
    /// Lines that are not cut.
    pub aside: Aside,
    /// Marks of notches that are reported and not cut, once for every piece that lacks one.
    pub notches_left_out: Vec<Span>,
    /// Starts of pieces that cannot be cut and that the selection leaves out.
    pub pieces_left_out: Vec<Span>,
}

/// Lines of a drawing in one class.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LineClass {
    /// Name of the class, a word or two.
    pub name: &'static str,
    /// How these lines are told from others, in a phrase.
    pub about: &'static str,
    /// True if they are cut or drilled.
    pub cut: bool,
    /// Number of lines.
    pub count: usize,
    /// Length as drawn, mm.
    pub length: f64,
}

/// Lines of a layer.
#[derive(Debug, Clone, PartialEq)]
pub struct LayerLines {
    /// Name of the layer.
    pub name: String,
    /// Use of its lines, a word or two.
    pub used: &'static str,
    /// Number of lines.
    pub count: usize,
    /// Length as drawn, mm.
    pub length: f64,
}

/// Lines that are drawn and not cut.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Aside {
    /// Vertices of the lines, line after line.
    pub vertices: Vec<Vertex>,
    /// The lines.
    pub lines: Vec<AsideLine>,
    /// Changes by joining.
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
    /// Index of its first vertex in [`Aside::vertices`].
    pub first: u32,
    /// Index after its last vertex.
    pub end: u32,
    /// Its class; `None` for the way back of a mark that is drawn out and back.
    pub class: Option<&'static str>,
}

impl Aside {
    /// Class and vertices of each line.
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

/// Lines before they were joined and straightened.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Moved {
    /// Number of vertices that lines no longer have: at the meeting of two lines that one instruction of the file draws, and
    /// within straight strokes.
    pub points: usize,
    /// Lines whose places have changed.
    pub redrawn: Vec<Redrawn>,
    /// Lines that are not in the drawing: each closes an outline that is cut, from its last place to its first.
    pub closed: Vec<Vec<Point>>,
    /// Edges that are drawn once and bound two parts: the second copy of each.
    pub doubled: Vec<Vec<Vertex>>,
    /// Number of vertices that lines have more than were drawn: where others meet them, and on edges that are doubled.
    pub repeated: usize,
}

/// A line whose places have changed.
#[derive(Debug, Clone, PartialEq)]
pub struct Redrawn {
    /// Its vertices as drawn, mm.
    pub drawn: Vec<Point>,
    /// Its start and end now; both may be the same place.
    pub now: [Point; 2],
}
