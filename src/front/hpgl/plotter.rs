//! The state of the plotter: pen, mode, place, scale, polygon buffer. Makes strokes of moves.

use super::count::Count;
use super::scale::{Frame, Pair};
use super::syntax::VALUE_MAX;
use crate::geom::Point;
use crate::ir::Drawing;
use crate::ir::drawing::Encoded;
use crate::source::Span;

/// The pen that draws when the file takes none: many files do.
const FIRST_PEN: u16 = 1;
/// The number that stands for no pen (SP0).
pub(super) const NO_PEN: u16 = 0;
/// Farthest place from the origin, mm: no table is a kilometre long.
const FARTHEST: f64 = 1e6;
/// Moves that curves and repeated polygons may make beyond one for each byte of the file: a hundred times what the largest
/// plots need, and no more than the memory of a small computer holds.
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
    /// Moves that it may still make, drawing or not.
    moves_left: usize,
    standing: Standing,
    /// Whether a letter that lowers or lifts the pen may be lost: where it was.
    torn: Option<Span>,
    /// Lines that were drawn from a place that hangs on letters, and from one that hangs on what could not be read.
    pub(super) adrift: Count,
    pub(super) lost: Count,
    pen: u16,
    /// The same among the pens of the drawing, once it draws.
    drawing_pen: Option<u16>,
    is_down: bool,
    is_relative: bool,
    /// Where it is, in units of the plotter before RO.
    at: Pair,
    /// Corners of the polygon that PM gathers, and where its last part starts; `None` outside PM.
    gathering: Option<usize>,
    /// Whether the next place starts another part of it.
    awaits_part: bool,
    polygon: Vec<Corner>,
}

/// A corner of a polygon.
#[derive(Debug, Clone, Copy)]
struct Corner {
    at: Pair,
    span: Span,
    /// Whether the edge that ends here is drawn.
    is_edge: bool,
}

/// Whether the file says where the pen is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Standing {
    /// It does.
    Known,
    /// A text was written since the last absolute place: it depends on the letters.
    Lettered,
    /// Something that stood there could not be read.
    Lost(Span),
}

/// Why a move is refused.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Refusal {
    /// The place is beyond any table.
    TooFar,
    /// Curves and polygons have more moves than a plot may take.
    TooMany,
}

/// What is drawn by a plotter.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sheet {
    /// Length of a unit, mm.
    pub(super) unit: f64,
    /// Bytes of the file.
    pub(super) bytes: usize,
}

/// Bytes of a large plot for each of its vertices: more than most have, so that no memory is taken in vain.
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
            pen: FIRST_PEN,
            drawing_pen: None,
            is_down: false,
            is_relative: false,
            at: [0.0, 0.0],
            gathering: None,
            awaits_part: false,
            polygon: Vec::new(),
        }
    }

    /// IN and the like: as switched on, the pen up at the origin.
    pub(super) fn reset(&mut self) {
        self.lift();
        self.frame.reset();
        (self.is_relative, self.gathering, self.awaits_part) = (false, None, false);
        self.polygon.clear();
        (self.at, self.standing, self.torn) = ([0.0, 0.0], Standing::Known, None);
        self.take_pen(FIRST_PEN);
    }

    /// DF: places are absolute and not scaled; the pen stays where and as it is.
    pub(super) fn set_default(&mut self) {
        self.is_relative = false;
        self.frame.set_default();
    }

    /// Changes what numbers mean. The pen stays where it is on the table, even where its numbers change: "the physical
    /// location of the pen does not change when you rotate". (Hewlett-Packard, "HP-GL/2 and HP RTL Reference Guide", RO.)
    pub(super) fn reframe<T>(&mut self, change: impl FnOnce(&mut Frame) -> T) -> T {
        let on_table = self.frame.turned(self.at);
        let outcome = change(&mut self.frame);
        if self.frame.turned(self.at) != on_table {
            self.at = self.frame.turned_back(on_table);
        }
        outcome
    }

    /// The pen moves by letters, whose size is not known.
    pub(super) fn drift(&mut self) {
        self.standing = Standing::Lettered;
    }

    /// What stands in the file there cannot be read, and may have led the pen somewhere. Amid a line that is a place less.
    pub(super) fn lose(&mut self, span: Span) {
        if self.is_down && !self.drawing.is_closed() {
            self.lost.add(span);
        } else {
            self.standing = Standing::Lost(span);
        }
    }

    /// What stands there may have lowered or lifted the pen.
    pub(super) fn tear(&mut self, span: Span) {
        self.torn = Some(span);
    }

    /// A move whose instruction says nothing of whether the pen is down.
    pub(super) fn trust_pen(&mut self) {
        if let Some(span) = self.torn.take() {
            self.lost.add(span);
        }
    }

    /// What was drawn by the encoded polyline that stands there, its numbers in steps of so many units.
    pub(super) fn encoded(&mut self, span: Span, digit_bits: u32, step: f64) {
        if self.frame.is_plain() {
            self.drawing.encoded.push(Encoded { span, digit_bits, step: step * self.unit });
        }
    }

    /// An absolute move ends that.
    pub(super) fn settle(&mut self) {
        self.standing = Standing::Known;
    }

    /// What a move in the mode in force does to that.
    pub(super) fn settle_by_mode(&mut self) {
        if !self.is_relative {
            self.settle();
        }
    }

    /// Where it is, mm.
    pub(super) fn place(&self) -> Point {
        self.point(self.at)
    }

    /// Where it is, in units of the plotter.
    pub(super) fn at(&self) -> Pair {
        self.at
    }

    /// PA, PR: places from here on are relative to the one before, or are not.
    pub(super) fn set_relative(&mut self, is_relative: bool) {
        self.is_relative = is_relative;
    }

    /// PU.
    pub(super) fn lift(&mut self) {
        (self.is_down, self.torn) = (false, None);
        self.drawing.lift();
    }

    /// PD.
    pub(super) fn lower(&mut self) {
        (self.is_down, self.torn) = (true, None);
    }

    /// Whether the pen is down.
    pub(super) fn is_drawing(&self) -> bool {
        self.is_down
    }

    /// SP.
    pub(super) fn take_pen(&mut self, pen: u16) {
        if pen != self.pen {
            self.drawing.lift();
            (self.pen, self.drawing_pen) = (pen, None);
        }
    }

    /// Where two numbers lead in the mode in force.
    pub(super) fn target(&self, pair: Pair) -> Pair {
        if self.is_relative { self.relative(pair) } else { self.absolute(pair) }
    }

    /// Where two numbers lead that are a place.
    pub(super) fn absolute(&self, pair: Pair) -> Pair {
        if self.frame.is_plain() { pair } else { self.frame.place(pair) }
    }

    /// Where two numbers lead that are a way.
    pub(super) fn relative(&self, pair: Pair) -> Pair {
        let way = if self.frame.is_plain() { pair } else { self.frame.way(pair) };
        [self.at[0] + way[0], self.at[1] + way[1]]
    }

    /// Along the ends of the chords of a curve, with the pen as it is. Where they leave no trace, only the last one counts.
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

    /// A move with the pen as it is.
    pub(super) fn go(&mut self, to: Pair, span: Span) -> Result<(), Refusal> {
        if self.is_down { self.draw(to, span) } else { self.jump(to, span) }
    }

    /// A move that draws.
    pub(super) fn draw(&mut self, to: Pair, span: Span) -> Result<(), Refusal> {
        self.check(to)?;
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

    /// A figure of its own, drawn whether the pen is up or down; the pen is then where it was.
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

    /// PM 0: what follows is gathered.
    pub(super) fn begin_polygon(&mut self, span: Span) {
        self.drawing.lift();
        self.polygon.clear();
        self.polygon.push(Corner { at: self.at, span, is_edge: false });
        (self.gathering, self.awaits_part) = (Some(0), false);
    }

    /// PM 1: the part is closed, and the next place starts another.
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

    /// A move to a place that the file gives. The first one behind PM 1 starts a part, pen up or down.
    pub(super) fn lead(&mut self, to: Pair, span: Span) -> Result<(), Refusal> {
        if !self.awaits_part {
            return self.go(to, span);
        }
        self.jump(to, span)?;
        (self.gathering, self.awaits_part) = (Some(self.polygon.len() - 1), false);
        Ok(())
    }

    /// A polygon that PM is still gathering and that has edges: the place of its last corner.
    pub(super) fn unfinished(&self) -> Option<Span> {
        self.gathering?;
        let last = self.polygon.iter().rfind(|corner| corner.is_edge)?;
        Some(last.span)
    }

    /// PM 2: the polygon is whole.
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

    /// A place of the plotter, mm. One multiplication, so that equal places of the file are equal to the bit.
    fn point(&self, at: Pair) -> Point {
        let [x, y] = if self.frame.is_turned() { self.frame.turned(at) } else { at };
        Point::new(x * self.unit, y * self.unit)
    }

    /// One move more, to a place on a table; what is not a number is none.
    fn check(&mut self, to: Pair) -> Result<(), Refusal> {
        let is_near = to[0].abs() <= self.farthest && to[1].abs() <= self.farthest;
        if !is_near {
            return Err(Refusal::TooFar);
        }
        self.moves_left = self.moves_left.checked_sub(1).ok_or(Refusal::TooMany)?;
        Ok(())
    }
}
