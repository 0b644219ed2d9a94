//! The pencil: draws lines and curves of subpaths into a drawing.

use super::curve::{self, Curve};
use super::path::Step;
use super::transform::{Pair, placed};
use crate::diagnostic::{Diagnostic, code};
use crate::geom::Point;
use crate::geom::affine::Affine;
use crate::ir::Drawing;
use crate::source::Span;

/// Maximum number of chords of a file, so that a damaged radius cannot exhaust the memory.
const MOST_CHORDS: usize = 4_000_000;
/// Maximum coordinate, mm: a kilometre, far beyond any table.
const FARTHEST: f64 = 1e6;
/// Minimum length of a line, mm. Sums of relative coordinates return to their start within a thousandth of this.
const SHORTEST: f64 = 1e-6;

/// Converts the steps of paths to strokes.
pub(super) struct Pencil {
    pub(super) drawing: Drawing,
    /// Maximum deviation of a chord from its curve, mm.
    sagitta: f64,
    /// Number of chords so far.
    chords: usize,
    /// Start of the subpath, in units of the file, and its location in the source.
    start: (Pair, Span),
    /// Current position, in units of the file.
    at: Pair,
}

impl Pencil {
    /// A pencil with chords within `sagitta` mm of curves.
    pub(super) fn new(sagitta: f64) -> Self {
        let start = ([0.0; 2], Span::default());
        Self { drawing: Drawing::default(), sagitta, chords: 0, start, at: [0.0; 2] }
    }

    /// Draws a step of a path; `map` converts it to mm.
    pub(super) fn draw(&mut self, step: Step, map: Affine, span: Span) -> Result<(), Diagnostic> {
        let from = self.at;
        let place = |at: Pair| placed(&map, at);
        match step {
            Step::Move(to) => {
                self.lift();
                (self.start, self.at) = ((to, span), to);
                return check(place(to), span);
            }
            Step::Line(to) => {
                self.at = to;
                self.line(map, place(to), span)?;
            }
            Step::Cubic(places) => {
                self.at = places[2];
                let [a, b, c] = places.map(place);
                [a, b].iter().try_for_each(|control| check(*control, span))?;
                self.curve(&Curve::Cubic([place(from), a, b, c]), map, span)?;
            }
            Step::Arc(arc) => {
                self.at = arc.to;
                match curve::arc(from, arc, map) {
                    Some(curve) => self.curve(&curve, map, span)?,
                    None => self.line(map, place(arc.to), span)?,
                }
            }
            Step::Close => {
                self.at = self.start.0;
                if !self.drawing.is_lifted() {
                    self.line(map, place(self.at), span)?;
                }
                self.lift();
            }
        }
        Ok(())
    }

    /// Draws a curve from the current position.
    pub(super) fn curve(&mut self, curve: &Curve, map: Affine, span: Span) -> Result<(), Diagnostic> {
        let chords = curve.chords(self.sagitta);
        self.chords += chords;
        if self.chords > MOST_CHORDS {
            let message = format!("the curves of the file have more than {MOST_CHORDS} chords");
            let finding = Diagnostic::new(&code::SVG_TOO_MUCH, message).at(span);
            return Err(finding.hint("look for a damaged number, or for copies of copies (`use`)"));
        }
        (1..=chords).try_for_each(|chord| self.line(map, curve.place(chord, chords), span))
    }

    /// Draws a line to a point, mm. The caller assigns the strokes to their layers.
    fn line(&mut self, map: Affine, to: Pair, span: Span) -> Result<(), Diagnostic> {
        check(to, span)?;
        if self.drawing.is_lifted() {
            let (start, led) = self.start;
            let [x, y] = placed(&map, start);
            self.drawing.begin(Point::new(x, y), led, 0);
        }
        let to = Point::new(to[0], to[1]);
        if self.drawing.vertices.last().is_none_or(|last| (last.at - to).norm() > SHORTEST) {
            self.drawing.line(to, span);
        }
        Ok(())
    }

    /// Ends a subpath. A subpath that returns to its start ends exactly there.
    pub(super) fn lift(&mut self) {
        if !self.drawing.is_lifted()
            && let Some(stroke) = self.drawing.strokes.last()
        {
            let first = self.drawing.vertices[stroke.first as usize].at;
            if let Some(last) = self.drawing.vertices.last_mut()
                && (last.at - first).norm() <= SHORTEST
            {
                last.at = first;
            }
        }
        self.drawing.lift();
    }
}

/// Refuses a point with NaN or with coordinates beyond any table.
fn check(at: Pair, span: Span) -> Result<(), Diagnostic> {
    if at.iter().all(|number| number.abs() <= FARTHEST) {
        return Ok(());
    }
    let finding = Diagnostic::new(&code::SVG_FAR, "a place here is more than a kilometre from the page").at(span);
    Err(finding.hint("a digit may be doubled or a decimal point lost: save the drawing again"))
}
