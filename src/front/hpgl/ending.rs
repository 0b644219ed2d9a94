//! The end of a plot: lines, moves and languages that it leaves unfinished.

use super::count::Count;
use super::instruction::Instruction;
use super::plotter::Plotter;
use super::reader::Reader;
use crate::diagnostic::{Diagnostic, code};
use crate::ir::drawing::{Ending, Vertex};
use crate::source::Span;

/// The last statement of a plot.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Last {
    /// Its instruction and the place of its mnemonic; `None` for other statements.
    pub(super) instruction: Option<(Instruction, Span)>,
    /// True if it has drawn something.
    pub(super) drew: bool,
    /// The last coordinate without a partner in the file.
    pub(super) odd: Option<Span>,
}

/// Completeness of the last line.
pub(super) fn of_line(last: &Last, reader: &Reader<'_>, plotter: &Plotter) -> Ending {
    if let Some(odd) = last.odd.filter(|odd| reader.ends_with(*odd)) {
        return Ending::AmidPair(odd);
    }
    let drawing = &plotter.drawing;
    let Some(vertex) = drawing.vertices.last() else { return Ending::Proper };
    match (last.drew && reader.ends_with_digit(), drawing.is_lifted()) {
        (true, _) => Ending::AmidNumber(vertex.span),
        (false, false) => Ending::PenDown(vertex.span),
        (false, true) => Ending::Proper,
    }
}

/// The finding on a plot that ends before anything was done at the last place of the pen, or amid its language. Programs park
/// the pen at the origin or beside the drawing, on an axis, and lift it or put it away.
pub(super) fn of_plot(last: &Last, reader: &Reader<'_>, plotter: &Plotter) -> Option<Diagnostic> {
    let (instruction, span) = last.instruction?;
    if plotter.is_gathering() || last.odd.is_some_and(|odd| reader.ends_with(odd)) {
        return None; // reported as what it is
    }
    let moves = instruction.is_move();
    let is_closing =
        matches!(instruction, Instruction::Page(_) | Instruction::Pen | Instruction::Initialize | Instruction::Begin);
    let name = if moves { reader.mnemonic_at(span) } else { String::new() };
    let is_open = last.drew && !plotter.drawing.is_closed(); // reported as an outline that is cut short
    let message = if moves && !is_open && reader.lacks_semicolon(span) {
        format!("the file ends amid {name}, without a semicolon")
    } else if instruction == Instruction::Down && plotter.drawing.is_lifted() {
        format!("the file ends where {name} lowers the pen, and nothing is drawn")
    } else if moves && !plotter.is_drawing() && !plotter.is_parked() && reader.has_numbers(span) {
        format!("the file ends behind a {name} to a place: nothing is drawn there")
    } else if let Some(language) = reader.language().filter(|_| !is_closing) {
        let message = "the file enters HP-GL/2 here, and neither leaves it nor ends its page".to_owned();
        return Some(no_end(message, language));
    } else {
        return None;
    };
    Some(no_end(message, span))
}

fn no_end(message: String, span: Span) -> Diagnostic {
    let finding = Diagnostic::new(&code::HPGL_NO_END, message).at(span);
    finding.hint("it may be cut short: count the pieces, and compare its size with the original")
}

/// Places in a row where the pen is up, and nothing is drawn.
#[derive(Debug, Default)]
pub(super) struct AirMoves {
    /// The places of the current row, mm, and those of them that the moves of an instruction lead to.
    row: Vec<Vertex>,
    places: Vec<[f64; 2]>,
    rows: Count,
    /// The rows, each from where an outline would begin, mm.
    pub(super) outlines: Vec<Vec<Vertex>>,
    /// True if the last place of the row is a start of something: passed with the pen up, and not where pens are parked.
    awaits: bool,
    /// Move of the current row away from such a place.
    left: Option<Span>,
    /// Such moves before something was drawn, and the number of all rows.
    lefts: Count,
    settled: usize,
}

/// Least number of rows for each start that the pen leaves without drawing, if there are several: else a program writes them.
const FEW_LEFT: usize = 10;

/// Least number of places of an outline: one instruction with as many, or a way back over as many, looks like one.
const LEAST_PLACES: usize = 3;
/// Number of places in which a way back is looked for: as many as most outlines have.
const LOOKED_AT: usize = 1000;

impl AirMoves {
    /// Records a place of an instruction with the pen up.
    pub(super) fn go(&mut self, to: Vertex) {
        if self.row.last().is_none_or(|last| last.at != to.at) {
            self.row.push(to);
        }
    }

    /// Records the moves of an instruction with the pen up: their number, and the place that they lead to.
    pub(super) fn pass(&mut self, moves: usize, to: [f64; 2], span: Span) {
        if moves == 0 || moves == 1 && self.places.last() == Some(&to) {
            return;
        }
        let is_back = || self.places.iter().rev().take(LOOKED_AT).skip(LEAST_PLACES - 1).any(|&place| place == to);
        if moves >= LEAST_PLACES || is_back() {
            self.rows.add(span);
            self.places.clear();
            self.end_outline(moves);
        } else if self.awaits && !to.contains(&0.0) {
            self.left.get_or_insert(span);
        }
        self.awaits = !to.contains(&0.0);
        self.places.push(to);
    }

    /// Ends the row with an outline: back at one of its places, or the moves of one instruction and the place before them.
    fn end_outline(&mut self, moves: usize) {
        let Some(last) = self.row.last().copied() else { return };
        let back = self.row.iter().rev().skip(1).take(LOOKED_AT.max(moves)).position(|vertex| vertex.at == last.at);
        let places = back.map_or(moves, |back| back + 1);
        self.outlines.push(self.row.split_off(self.row.len().saturating_sub(places + 1)));
        self.row = vec![last];
    }

    /// The pen is changed: programs lead it aside before.
    pub(super) fn pause(&mut self) {
        self.awaits = false;
    }

    /// The plotter is switched on afresh: the pen was parked before.
    pub(super) fn restart(&mut self) {
        self.left = None;
        self.settle();
    }

    /// Ends a row: something is drawn or written at its last place.
    pub(super) fn settle(&mut self) {
        self.settled += usize::from(self.awaits);
        self.awaits = false;
        if let Some(span) = self.left.take() {
            self.lefts.add(span);
        }
        self.places.clear();
        self.row.clear();
    }

    /// Ends a row, and begins another one at its last place: an outline that begins there ends there, too.
    pub(super) fn settle_at(&mut self, at: [f64; 2], place: Vertex) {
        self.settle();
        self.places.push(at);
        self.row.push(place);
    }

    /// The finding on the rows.
    pub(super) fn finding(&self) -> Option<Diagnostic> {
        if self.rows.first.is_none() {
            let is_few = self.lefts.count == 1 || self.settled >= FEW_LEFT * self.lefts.count;
            self.lefts.first.filter(|_| is_few)?;
            let times = self.lefts.times();
            let message = format!("the pen comes to a place and leaves it without drawing; this happens {times}");
            let finding = self.lefts.diagnostic(&code::HPGL_UNCUT_PLACES, message);
            return Some(finding.hint("a PD may be lost: then a piece is missing; look at the picture (-t svg)"));
        }
        let message = format!("places in a row are passed with the pen up; this happens {}", self.rows.times());
        let finding = self.rows.diagnostic(&code::HPGL_UNCUT_PLACES, message);
        Some(finding.hint("a PD may have become PU or PA: then a piece or mark is lost; look at the picture (-t svg)"))
    }
}
