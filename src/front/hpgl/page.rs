//! Pages: drawing after the end of a page, which overlaps the drawing before it.

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

    /// Reports the first end of each kind with drawing after it.
    pub(super) fn report(&self, drawing: &Drawing, out: &mut Diagnostics) {
        let drawn = drawing.strokes.len();
        let first = |kind| self.ends.iter().find(|end| end.kind == kind && end.drawn < drawn).map(|end| end.span);
        for (span, message) in [
            (self.drawn_over(drawing), "the plotter starts afresh here, and draws over the same place again"),
            (first(End::CutOff), "the paper is cut off here (EC), and more is drawn behind it"),
            (first(End::Out), "a page goes out here, and more is drawn behind it"),
        ] {
            let Some(span) = span else { continue };
            let hint = "the pages lie on each other; if they do not belong together, split the file";
            out.push(Diagnostic::new(&code::HPGL_PAGES, message).at(span).hint(hint));
        }
        if let Some(span) = first(End::Frame) {
            let message = "the paper is moved on by a frame here (FR), and more is drawn behind it";
            let hint = "the frames would lie on each other; let the CAD system write one long plot, without frames";
            out.push(Diagnostic::new(&code::HPGL_FRAMES, message).at(span).hint(hint));
        }
    }

    /// The first reset whose strokes, up to the next end, overlap the strokes before it.
    fn drawn_over(&self, drawing: &Drawing) -> Option<Span> {
        let extent = |from: usize, to: usize| {
            let mut extent = Extent::EMPTY;
            let places = drawing.strokes[from..to].iter().flat_map(|stroke| &drawing.vertices[stroke.range()]);
            places.for_each(|vertex| extent.add(vertex.at));
            extent
        };
        let mut before = extent(0, self.ends.first()?.drawn);
        for (i, end) in self.ends.iter().enumerate() {
            let next = self.ends.get(i + 1).map_or(drawing.strokes.len(), |next| next.drawn);
            let behind = extent(end.drawn, next);
            if end.kind == End::Afresh && before.overlaps(&behind) {
                return Some(end.span);
            }
            before.join(&behind);
        }
        None
    }
}
