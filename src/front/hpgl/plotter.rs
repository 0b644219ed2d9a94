//! State of the plotter: pen, mode, place, scale, polygon buffer. Makes strokes of moves.

use super::count::Count;
use super::scale::{Frame, Pair};
use super::syntax::VALUE_MAX;
use crate::geom::Point;
use crate::ir::Drawing;
use crate::ir::drawing::{Encoded, Vertex};
use crate::source::Span;

/// The pen that draws if the file selects none, as many files do.
const FIRST_PEN: u16 = 1;
/// The number for no pen (SP0).
pub(super) const NO_PEN: u16 = 0;
/// Greatest pen number, as plotters have at most 256 pens; a greater one is damage and is taken as no pen.
pub(super) const MOST_PENS: f64 = 256.0;
/// Farthest place from the origin, mm: no table is a kilometre long.
const FARTHEST: f64 = 1e6;
/// Number of moves that curves and repeated polygons may add to one per byte of the file: a hundred times the need of the
/// largest plots, and within the memory of a small computer.
const MOST_CURVED: usize = 5_000_000;

/// Follows the moves.
#[derive(Debug)]
pub(super) struct Plotter {
    pub(super) frame: Frame,
    pub(super) drawing: Drawing,
    /// Length of a unit, mm.
    unit: f64,
    /// Farthest place from the origin, units.
    farthest: f64,
    /// Number of moves that it may still make, drawing or not.
    moves_left: usize,
    standing: Standing,
    /// Place of a possibly lost letter that lowers or lifts the pen.
    torn: Option<Span>,
    /// Lines drawn from a place that depends on letters, and from one that depends on unreadable items.
    pub(super) adrift: Count,
    pub(super) lost: Count,
    /// Place where the pen was lowered, as long as it has not moved since.
    dot: Option<Span>,
    /// Dots off the axes: the pen is lowered and lifted at one place, where no stroke ends.
    pub(super) dots: Count,
    pen: u16,
    /// Its pen among the pens of the drawing, once it draws.
    drawing_pen: Option<u16>,
    is_down: bool,
    is_relative: bool,
    /// Its place, in units of the plotter before RO.
    at: Pair,
    /// Index of the start of the current part of the polygon that PM gathers; `None` outside PM.
    gathering: Option<usize>,
    /// Place of the last corner of a polygon that another one replaced before its end.
    abandoned: Option<Span>,
    /// True if the next place starts another part of it.
    awaits_part: bool,
    polygon: Vec<Corner>,
}

/// A corner of a polygon.
#[derive(Debug, Clone, Copy)]
struct Corner {
    at: Pair,
    span: Span,
    /// True if the edge that ends here is drawn.
    is_edge: bool,
}

/// Knowledge of the pen's place.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Standing {
    /// The place is known.
    Known,
    /// A text was written since the last absolute place: the place depends on the letters.
    Lettered,
    /// Something before it could not be read.
    Lost(Span),
}

/// Reason that a move is refused.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Refusal {
    /// The place is beyond any table.
    TooFar,
    /// Curves and polygons have more moves than a plot may have.
    TooMany,
}

/// Measures of the file that a plotter draws.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sheet {
    /// Length of a unit, mm.
    pub(super) unit: f64,
    /// Bytes of the file.
    pub(super) bytes: usize,
}

/// Number of bytes of a large plot for each of its vertices: more than in most, so that no memory is wasted.
const BYTES_A_VERTEX: usize = 16;

impl Plotter {
    /// A plotter as switched on.
    pub(super) fn new(Sheet { unit, bytes }: Sheet) -> Self {
        Self {
            frame: Frame::new(),
            drawing: Drawing::with_room(unit, bytes / BYTES_A_VERTEX),
            unit,
            farthest: (FARTHEST / unit).min(VALUE_MAX),
            moves_left: bytes + MOST_CURVED,
            standing: Standing::Known,
            torn: None,
            adrift: Count::default(),
            lost: Count::default(),
            dot: None,
            dots: Count::default(),
            pen: FIRST_PEN,
            drawing_pen: None,
            is_down: false,
            is_relative: false,
            at: [0.0, 0.0],
            gathering: None,
            abandoned: None,
            awaits_part: false,
            polygon: Vec::new(),
        }
    }

    /// IN and similar: state as switched on, the pen up at the origin.
    pub(super) fn reset(&mut self) {
        self.dot = None;
        self.lift();
        self.frame.reset();
        (self.is_relative, self.gathering, self.awaits_part) = (false, None, false);
        self.polygon.clear();
        (self.at, self.standing, self.torn) = ([0.0, 0.0], Standing::Known, None);
        self.take_pen(FIRST_PEN);
    }

    /// DF: places are absolute and not scaled; the pen keeps its place and state.
    pub(super) fn set_default(&mut self) {
        self.is_relative = false;
        self.frame.set_default();
    }

    /// Changes the meaning of numbers. The pen keeps its place on the table, even if its numbers change: "the physical location
    /// of the pen does not change when you rotate". (Hewlett-Packard, "HP-GL/2 and HP RTL Reference Guide", RO.)
    pub(super) fn reframe<T>(&mut self, change: impl FnOnce(&mut Frame) -> T) -> T {
        let on_table = self.frame.turned(self.at);
        let outcome = change(&mut self.frame);
        if self.frame.turned(self.at) != on_table {
            self.at = self.frame.turned_back(on_table);
        }
        outcome
    }

    /// Records that letters of unknown size move the pen.
    pub(super) fn drift(&mut self) {
        self.standing = Standing::Lettered;
    }

    /// Records an unreadable item that may have moved the pen. Inside a line it is a missing place.
    pub(super) fn lose(&mut self, span: Span) {
        if self.is_down && !self.drawing.is_closed() {
            self.lost.add(span);
        } else {
            self.standing = Standing::Lost(span);
        }
    }

    /// Records an item that may have lowered or lifted the pen.
    pub(super) fn tear(&mut self, span: Span) {
        self.torn = Some(span);
    }

    /// Records a move whose instruction does not tell whether the pen is down.
    pub(super) fn trust_pen(&mut self) {
        if let Some(span) = self.torn.take() {
            self.lost.add(span);
        }
    }

    /// Records an encoded polyline, with numbers in steps of `step` units.
    pub(super) fn encoded(&mut self, span: Span, digit_bits: u32, step: f64) {
        if self.frame.is_plain() {
            self.drawing.encoded.push(Encoded { span, digit_bits, step: step * self.unit });
        }
    }

    /// Records an absolute move: the place is known again.
    pub(super) fn settle(&mut self) {
        self.standing = Standing::Known;
    }

    /// Records a move in the current mode: if it is absolute, the place is known again.
    pub(super) fn settle_by_mode(&mut self) {
        if !self.is_relative {
            self.settle();
        }
    }

    /// Its place, mm.
    pub(super) fn place(&self) -> Point {
        self.point(self.at)
    }

    /// Its place, mm, to which something in the source led.
    pub(super) fn vertex(&self, span: Span) -> Vertex {
        Vertex { at: self.place(), span }
    }

    /// Its place, in units of the plotter.
    pub(super) fn at(&self) -> Pair {
        self.at
    }

    /// PA, PR: following places are absolute, or relative to the one before.
    pub(super) fn set_relative(&mut self, is_relative: bool) {
        self.is_relative = is_relative;
    }

    /// PU.
    pub(super) fn lift(&mut self) {
        (self.is_down, self.torn) = (false, None);
        if let Some(span) = self.dot.take() {
            self.dots.add(span);
        }
        self.drawing.lift();
    }

    /// PD.
    pub(super) fn lower(&mut self, span: Span) {
        let is_dot = !self.is_down && !self.is_parked() && !self.is_gathering() && !self.ends_here();
        self.dot = Some(span).filter(|_| is_dot);
        (self.is_down, self.torn) = (true, None);
    }

    /// True if the pen is down.
    pub(super) fn is_drawing(&self) -> bool {
        self.is_down
    }

    /// True amid a stroke: the pen is down, has drawn, and is not back at the start of the stroke.
    pub(super) fn is_amid_stroke(&self) -> bool {
        self.is_down && !self.drawing.is_lifted() && !self.drawing.is_closed()
    }

    /// True if it is on an axis, where programs park the pen.
    pub(super) fn is_parked(&self) -> bool {
        self.at.contains(&0.0)
    }

    /// True if the last stroke ends at its place.
    fn ends_here(&self) -> bool {
        self.drawing.vertices.last().is_some_and(|vertex| vertex.at == self.point(self.at))
    }

    /// True if PM gathers the moves.
    pub(super) fn is_gathering(&self) -> bool {
        self.gathering.is_some()
    }

    /// SP.
    pub(super) fn take_pen(&mut self, pen: u16) {
        if pen != self.pen {
            self.drawing.lift();
            (self.pen, self.drawing_pen) = (pen, None);
        }
    }

    /// Target of two numbers in the current mode.
    pub(super) fn target(&self, pair: Pair) -> Pair {
        if self.is_relative { self.relative(pair) } else { self.absolute(pair) }
    }

    /// Target of two numbers that are an absolute place.
    pub(super) fn absolute(&self, pair: Pair) -> Pair {
        if self.frame.is_plain() { pair } else { self.frame.place(pair) }
    }

    /// Target of two numbers that are a displacement.
    pub(super) fn relative(&self, pair: Pair) -> Pair {
        let way = if self.frame.is_plain() { pair } else { self.frame.way(pair) };
        [self.at[0] + way[0], self.at[1] + way[1]]
    }

    /// Moves along the ends of the chords of a curve, in the current state of the pen. If the pen is up, only the last one
    /// counts.
    pub(super) fn follow(
        &mut self,
        mut chords: impl DoubleEndedIterator<Item = Pair>,
        span: Span,
    ) -> Result<(), Refusal> {
        if self.is_down || self.gathering.is_some() {
            return chords.try_for_each(|to| self.go(to, span));
        }
        chords.next_back().map_or(Ok(()), |to| self.go(to, span))
    }

    /// Moves in the current state of the pen.
    pub(super) fn go(&mut self, to: Pair, span: Span) -> Result<(), Refusal> {
        if self.is_down { self.draw(to, span) } else { self.jump(to, span) }
    }

    /// A move that draws.
    pub(super) fn draw(&mut self, to: Pair, span: Span) -> Result<(), Refusal> {
        self.check(to)?;
        self.dot = self.dot.filter(|_| to == self.at);
        match self.standing {
            Standing::Known => {}
            Standing::Lettered => self.adrift.add(span),
            Standing::Lost(span) => self.lost.add(span),
        }
        if self.gathering.is_some() {
            self.polygon.push(Corner { at: to, span, is_edge: true });
        } else {
            if self.drawing.is_lifted() {
                let (number, drawing) = (self.pen, &mut self.drawing);
                let pen = *self.drawing_pen.get_or_insert_with(|| drawing.pen(&number.to_string(), number != NO_PEN));
                self.drawing.begin(self.point(self.at), span, pen);
            }
            self.drawing.line(self.point(to), span);
        }
        self.at = to;
        Ok(())
    }

    /// A move that does not draw.
    pub(super) fn jump(&mut self, to: Pair, span: Span) -> Result<(), Refusal> {
        self.check(to)?;
        if self.gathering.is_some() {
            self.polygon.push(Corner { at: to, span, is_edge: false });
        } else {
            self.drawing.lift();
        }
        self.at = to;
        Ok(())
    }

    /// Draws a separate figure, whether the pen is up or down; the pen then returns.
    pub(super) fn figure(
        &mut self,
        start: Pair,
        points: impl IntoIterator<Item = Pair>,
        span: Span,
    ) -> Result<(), Refusal> {
        let back = self.at;
        self.jump(start, span)?;
        let drawn = points.into_iter().try_for_each(|to| self.draw(to, span));
        self.jump(back, span)?;
        drawn
    }

    /// PM 0: the following moves are gathered.
    pub(super) fn begin_polygon(&mut self, span: Span) {
        self.abandoned = self.unfinished();
        self.drawing.lift();
        self.polygon.clear();
        self.polygon.push(Corner { at: self.at, span, is_edge: false });
        (self.gathering, self.awaits_part) = (Some(0), false);
    }

    /// PM 1: the part is closed, and the next place starts another one.
    pub(super) fn close_part(&mut self, span: Span) {
        let Some(start) = self.gathering else { return };
        let first = self.polygon[start].at;
        if self.polygon.last().is_some_and(|last| last.at != first) {
            self.polygon.push(Corner { at: first, span, is_edge: true });
        }
        self.at = first;
        self.polygon.push(Corner { at: first, span, is_edge: false });
        (self.gathering, self.awaits_part) = (Some(self.polygon.len() - 1), true);
    }

    /// Moves to a place that the file gives. The first one after PM 1 starts a part, whether the pen is up or down.
    pub(super) fn lead(&mut self, to: Pair, span: Span) -> Result<(), Refusal> {
        if !self.awaits_part {
            return self.go(to, span);
        }
        self.jump(to, span)?;
        (self.gathering, self.awaits_part) = (Some(self.polygon.len() - 1), false);
        Ok(())
    }

    /// Place of the last corner of a polygon that PM is still gathering, or that another one replaced; `None` without corners.
    pub(super) fn unfinished(&self) -> Option<Span> {
        if self.abandoned.is_some() {
            return self.abandoned;
        }
        self.gathering?;
        let (_, corners) = self.polygon.split_first()?;
        corners.last().map(|last| last.span)
    }

    /// PM 2: the polygon is complete.
    pub(super) fn end_polygon(&mut self, span: Span) {
        self.close_part(span);
        (self.gathering, self.awaits_part) = (None, false);
    }

    /// EP: draws the edges that the pen was down for.
    pub(super) fn edge_polygon(&mut self) -> Result<(), Refusal> {
        if self.gathering.is_some() {
            return Ok(());
        }
        let back = self.at;
        self.drawing.lift();
        let polygon = std::mem::take(&mut self.polygon);
        for corner in &polygon {
            if corner.is_edge { self.draw(corner.at, corner.span)? } else { self.jump(corner.at, corner.span)? }
        }
        self.polygon = polygon;
        self.drawing.lift();
        self.at = back;
        Ok(())
    }

    /// A place of the plotter, mm. A single multiplication, so that equal places of the file are equal to the bit.
    fn point(&self, at: Pair) -> Point {
        let [x, y] = if self.frame.is_turned() { self.frame.turned(at) } else { at };
        Point::new(x * self.unit, y * self.unit)
    }

    /// Counts a move, and refuses places beyond any table and NaN.
    fn check(&mut self, to: Pair) -> Result<(), Refusal> {
        let is_near = to[0].abs() <= self.farthest && to[1].abs() <= self.farthest;
        if !is_near {
            return Err(Refusal::TooFar);
        }
        self.moves_left = self.moves_left.checked_sub(1).ok_or(Refusal::TooMany)?;
        Ok(())
    }
}
