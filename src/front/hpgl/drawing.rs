//! What the pen draws: strokes, each a chain of places that the pen was led to without being lifted.

use crate::geom::moments::Moments;
use crate::geom::{Extent, Point};
use crate::source::Span;

/// A place of a stroke, mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Vertex {
    pub(super) at: Point,
    /// What led the pen there.
    pub(super) span: Span,
}

/// How often the pen is led on along a line; the chords of a curve are one.
pub(super) fn led_to(vertices: &[Vertex]) -> isize {
    led_on(None, vertices.iter().skip(1))
}

/// The same behind a place that was led to before.
pub(super) fn led_on<'a>(mut before: Option<Span>, vertices: impl Iterator<Item = &'a Vertex>) -> isize {
    vertices.filter(|vertex| before.replace(vertex.span) != Some(vertex.span)).count().cast_signed()
}

/// Where a line lies.
pub(super) fn moments(vertices: &[Vertex]) -> Moments {
    Moments::of(vertices.iter().map(|vertex| vertex.at))
}

/// The number that stands for no pen (SP0).
pub(super) const NO_PEN: u16 = 0;

/// A line between two lifts: places of [`Drawing::vertices`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Stroke {
    pub(super) first: u32,
    /// One past the last.
    pub(super) end: u32,
    pub(super) pen: u16,
    /// Places of the file that it was led to; the chords of a curve are one.
    pub(super) points: u32,
    pub(super) extent: Extent,
}

/// What lines had before they were joined.
#[derive(Debug, Clone, Copy)]
pub(super) struct Moved {
    /// Places that were counted twice: where two strokes meet that one and the same line of the file draws.
    pub(super) points: isize,
    /// What lines had more than they have now; less than nothing where they were shorter.
    pub(super) moments: Moments,
    /// The box around the places as they were.
    pub(super) bounds: Extent,
}

impl Default for Moved {
    fn default() -> Self {
        Self { points: 0, moments: Moments::default(), bounds: Extent::EMPTY }
    }
}

/// All strokes.
#[derive(Debug, Default)]
pub(super) struct Drawing {
    pub(super) vertices: Vec<Vertex>,
    pub(super) strokes: Vec<Stroke>,
    /// What was drawn beyond them before ends that miss each other by rounding were moved together.
    pub(super) moved: Moved,
    /// What led the pen to the place where it stands, down, when the file ends.
    pub(super) unended: Option<Span>,
    /// Whether the last stroke goes on.
    goes_on: bool,
}

impl Stroke {
    /// Its places among the vertices.
    pub(super) fn range(&self) -> std::ops::Range<usize> {
        self.first as usize..self.end as usize
    }
}

impl Drawing {
    /// An empty drawing with room for so many vertices.
    pub(super) fn with_room(vertices: usize) -> Self {
        Self { vertices: Vec::with_capacity(vertices), ..Self::default() }
    }

    /// Whether the next line starts a stroke, so that [`Drawing::begin`] comes first.
    pub(super) fn is_lifted(&self) -> bool {
        !self.goes_on
    }

    /// Starts a stroke.
    pub(super) fn begin(&mut self, at: Point, span: Span, pen: u16) {
        let first = self.vertices.len() as u32;
        self.vertices.push(Vertex { at, span });
        let mut extent = Extent::EMPTY;
        extent.add(at);
        self.strokes.push(Stroke { first, end: first + 1, pen, points: 0, extent });
        self.goes_on = true;
    }

    /// Draws on. A line without length changes nothing.
    pub(super) fn line(&mut self, at: Point, span: Span) {
        let (Some(last), Some(stroke)) = (self.vertices.last(), self.strokes.last_mut()) else { return };
        if last.at == at {
            return;
        }
        stroke.points += u32::from(stroke.end - stroke.first == 1 || last.span != span);
        stroke.end += 1;
        stroke.extent.add(at);
        self.vertices.push(Vertex { at, span });
    }

    /// Starts a stroke without places, for others to be put together in it.
    pub(super) fn open(&mut self, pen: u16) {
        let first = self.vertices.len() as u32;
        self.strokes.push(Stroke { first, end: first, pen, points: 0, extent: Extent::EMPTY });
    }

    /// Adds the places of a stroke to the last one of all.
    pub(super) fn append(&mut self, stroke: &Stroke) {
        let seam = self.vertices.len();
        for k in stroke.range() {
            self.put(self.vertices[k]);
        }
        self.account(stroke, seam);
    }

    /// The same the other way round: each line keeps what drew it.
    pub(super) fn append_turned(&mut self, stroke: &Stroke) {
        let (range, seam) = (stroke.range(), self.vertices.len());
        let last = range.end - 1;
        for k in range.rev() {
            let span = self.vertices[(k + 1).min(last)].span;
            self.put(Vertex { span, ..self.vertices[k] });
        }
        self.account(stroke, seam);
    }

    /// A place of the last stroke; where two strokes meet it is there already.
    fn put(&mut self, vertex: Vertex) {
        let Some(stroke) = self.strokes.last_mut() else { return };
        let goes_on = stroke.end > stroke.first;
        if goes_on && self.vertices.last().is_some_and(|last| last.at == vertex.at) {
            return;
        }
        stroke.end += 1;
        self.vertices.push(vertex);
    }

    /// Counts the places of a stroke whose first one behind the seam has this index.
    fn account(&mut self, stroke: &Stroke, seam: usize) {
        if let Some(joined) = self.strokes.last_mut() {
            let is_seam = joined.first < seam as u32;
            let is_one =
                is_seam && self.vertices.get(seam).is_some_and(|next| next.span == self.vertices[seam - 1].span);
            joined.points += stroke.points - u32::from(is_one);
            self.moved.points += isize::from(is_one);
            joined.extent.add(stroke.extent.min);
            joined.extent.add(stroke.extent.max);
        }
    }

    /// Lifts the pen. A stroke without length is a dot, and none.
    pub(super) fn lift(&mut self) {
        if !std::mem::take(&mut self.goes_on) {
            return;
        }
        if self.strokes.last().is_some_and(|stroke| stroke.end - stroke.first == 1) {
            self.strokes.pop();
            self.vertices.pop();
        }
    }
}
