//! Pages: drawing after the end of a page, which overlaps the drawing before it.
//!
//! A page that goes out leaves its place to the next one, the numbers of which begin anew: on the cloth both would be cut into
//! each other, which is an error. Two cases are none: the same page once more, which is cut once, and a page the places of
//! which go on beside those before it. A plotter that starts afresh without new paper draws on: parts that cross there are
//! found later, like all others.

use std::ops::Range;

use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::geom::Extent;
use crate::ir::Drawing;
use crate::source::Span;

/// End of a page, in order of increasing severity.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum End {
    /// IN, BP, `ESC E`: the plotter is reset; programs write these between concatenated plots.
    Afresh,
    /// EC: the paper is cut off.
    CutOff,
    /// PG, AF, AH: the page is ejected.
    Out,
    /// FR: the paper advances by a frame. Coordinates after it restart and lie one frame farther on. (Hewlett-Packard, "HP
    /// 7585B and 7586B Interfacing and Programming Manual", FR.)
    Frame,
}

impl End {
    /// Name in messages.
    fn name(self) -> &'static str {
        match self {
            Self::Afresh => "IN",
            Self::CutOff => "EC",
            Self::Out => "PG",
            Self::Frame => "FR",
        }
    }
}

/// How a page lies to those before it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Lie {
    /// Beside them: its places go on from theirs.
    Beside,
    /// It is the same as one of them.
    Again,
    /// Over them: its places begin anew on paper of its own.
    Over,
}

/// Least share of the smaller one of two pages, along X and along Y, that both cover where one lies over the other: pages that
/// follow each other share an edge of the paper.
const LEAST_OVER: f64 = 0.1;
/// Hint for pages that lie over each other.
const APART: &str = "split the file at that place, or let the CAD system write one long page";
/// Hint for drawing over the same place.
const OVER: &str = "the pages lie on each other; if they do not belong together, split the file";

/// Ends of pages inside a plot.
#[derive(Debug, Default)]
pub(super) struct Pages {
    ends: Vec<PageEnd>,
}

#[derive(Debug)]
struct PageEnd {
    kind: End,
    /// Number of strokes before it.
    drawn: usize,
    span: Span,
}

impl Pages {
    /// Records an end after `drawn` strokes. Consecutive ends count as the most severe of them.
    pub(super) fn end(&mut self, kind: End, drawn: usize, span: Span) {
        match self.ends.last_mut().filter(|last| last.drawn == drawn) {
            Some(last) if last.kind < kind => (last.kind, last.span) = (kind, span),
            None if drawn > 0 => self.ends.push(PageEnd { kind, drawn, span }),
            Some(_) | None => {}
        }
    }

    /// True if something was drawn since the last end; `drawn` is the number of strokes so far.
    pub(super) fn goes_on(&self, drawn: usize) -> bool {
        drawn > self.ends.last().map_or(0, |end| end.drawn)
    }

    /// Reports the first page that lies over another one, or else the first end of each kind with drawing after it.
    pub(super) fn report(&self, drawing: &Drawing, out: &mut Diagnostics) {
        let drawn = drawing.strokes.len();
        let first = |kind| self.ends.iter().find(|end| end.kind == kind && end.drawn < drawn).map(|end| end.span);
        let pages = self.pages(drawing);
        let over = pages.iter().find(|(_, lie)| *lie == Lie::Over);
        if let Some((end, _)) = over {
            let count = pages.iter().filter(|(_, lie)| *lie == Lie::Over).count();
            let pages = if count == 1 { "a page lies".to_owned() } else { format!("{count} pages lie") };
            let message = format!("{pages} over what was drawn before, the first one from here ({})", end.kind.name());
            out.push(Diagnostic::new(&code::HPGL_PAGES_OVER, message).at(end.span).hint(APART));
        }
        let again = pages.iter().find(|(_, lie)| *lie == Lie::Again).map(|(end, _)| end.span);
        let beside = |kind| pages.iter().find(|(end, lie)| end.kind == kind && *lie == Lie::Beside);
        let beside = |kind| beside(kind).map(|(end, _)| end.span);
        let lie = "the pages lie as they are drawn; if they do not belong together, split the file";
        for (span, message, hint) in [
            (self.drawn_over(drawing), "the plotter starts afresh here, and draws over the same place again", OVER),
            (
                again,
                "from here a page is drawn again, the same as one before: it is cut once",
                "for more copies beside each other: `--set sheet.copies=2`",
            ),
            (beside(End::CutOff), "the paper is cut off here (EC), and more is drawn behind it", lie),
            (beside(End::Out), "a page goes out here, and more is drawn behind it", lie),
        ] {
            let Some(span) = span else { continue };
            out.push(Diagnostic::new(&code::HPGL_PAGES, message).at(span).hint(hint));
        }
        if let Some(span) = first(End::Frame) {
            let message = "the paper is moved on by a frame here (FR), and more is drawn behind it";
            let hint = "the frames would lie on each other; let the CAD system write one long plot, without frames";
            out.push(Diagnostic::new(&code::HPGL_FRAMES, message).at(span).hint(hint));
        }
    }

    /// Pages behind the first one, on paper of their own, and how they lie: the end before each of them.
    fn pages(&self, drawing: &Drawing) -> Vec<(&PageEnd, Lie)> {
        let drawn = drawing.strokes.len();
        let is_page = |end: &&PageEnd| matches!(end.kind, End::CutOff | End::Out) && end.drawn < drawn;
        let ends: Vec<&PageEnd> = self.ends.iter().filter(is_page).collect();
        let Some(first) = ends.first() else { return Vec::new() };
        // Copies are compared with the first page and with the last one: they stand in a row.
        let first_page = 0..first.drawn;
        let mut last = first_page.clone();
        let mut before = extent(drawing, first_page.clone());
        let lie = |(i, end): (usize, &&PageEnd)| {
            let page = end.drawn..ends.get(i + 1).map_or(drawn, |next| next.drawn);
            let around = extent(drawing, page.clone());
            let is_again = [&first_page, &last].into_iter().any(|one| repeats(drawing, one, &page));
            let is_over = lies_over(&before, &around);
            before.join(&around);
            last = page;
            match (is_again, is_over) {
                (true, _) => Lie::Again,
                (false, true) => Lie::Over,
                (false, false) => Lie::Beside,
            }
        };
        let lies: Vec<Lie> = ends.iter().enumerate().map(lie).collect();
        ends.into_iter().zip(lies).collect()
    }

    /// The first reset whose strokes, up to the next end, overlap the strokes before it.
    fn drawn_over(&self, drawing: &Drawing) -> Option<Span> {
        let mut before = extent(drawing, 0..self.ends.first()?.drawn);
        for (i, end) in self.ends.iter().enumerate() {
            let next = self.ends.get(i + 1).map_or(drawing.strokes.len(), |next| next.drawn);
            let behind = extent(drawing, end.drawn..next);
            if end.kind == End::Afresh && before.overlaps(&behind) {
                return Some(end.span);
            }
            before.join(&behind);
        }
        None
    }
}

/// Box around some strokes.
fn extent(drawing: &Drawing, strokes: Range<usize>) -> Extent {
    let mut extent = Extent::EMPTY;
    for stroke in &drawing.strokes[strokes] {
        drawing.vertices[stroke.range()].iter().for_each(|vertex| extent.add(vertex.at));
    }
    extent
}

/// True if the strokes of one page are those of another one, at the same places.
fn repeats(drawing: &Drawing, one: &Range<usize>, other: &Range<usize>) -> bool {
    let places = |page: &Range<usize>| {
        let strokes = drawing.strokes[page.clone()].iter();
        strokes.flat_map(|stroke| drawing.vertices[stroke.range()].iter().map(|vertex| (vertex.at, stroke.pen)))
    };
    one.len() == other.len() && places(one).eq(places(other))
}

/// True if two boxes share at least [`LEAST_OVER`] of the smaller one along X and along Y.
fn lies_over(one: &Extent, other: &Extent) -> bool {
    (0..2).all(|axis| {
        let [a, b] = [one, other].map(|extent| [extent.min[axis], extent.max[axis]]);
        let smaller = (a[1] - a[0]).min(b[1] - b[0]);
        let common = a[1].min(b[1]) - a[0].max(b[0]);
        common >= 0.0 && common >= LEAST_OVER * smaller
    })
}
