//! Pen in the units of an element: lines and curves of its subpaths.

use super::map::Map;
use super::pen::{Bow, Pen};

/// Pen in the units of an element.
pub(super) struct Trace<'p> {
    pub(super) pen: &'p mut Pen,
    /// Map to mm.
    pub(super) map: Map,
    /// Position of the pen, and start of the subpath.
    pub(super) at: [f64; 2],
    first: [f64; 2],
    /// True once a line of the subpath has been drawn.
    is_down: bool,
    /// Number of the current step; and true if each step is counted separately.
    step: usize,
    is_stepping: bool,
}

impl<'p> Trace<'p> {
    pub(super) fn new(pen: &'p mut Pen, map: Map, is_stepping: bool) -> Self {
        Self { pen, map, at: [0.0; 2], first: [0.0; 2], is_down: false, step: 1, is_stepping }
    }

    /// Starts a subpath.
    pub(super) fn start(&mut self, at: [f64; 2]) {
        self.pen.lift();
        (self.at, self.first, self.is_down) = (at, at, false);
    }

    /// Puts the pen down, and counts the step.
    fn lower(&mut self) {
        if !std::mem::replace(&mut self.is_down, true) {
            self.pen.start(self.map.at(self.first[0], self.first[1]));
        }
        self.step += usize::from(self.is_stepping);
    }

    /// Draws a straight line.
    pub(super) fn line(&mut self, to: [f64; 2]) {
        self.lower();
        self.pen.line(self.map.at(to[0], to[1]), self.step);
        self.at = to;
    }

    /// Draws a curve.
    pub(super) fn bow(&mut self, bow: &Bow, to: [f64; 2]) {
        self.lower();
        self.pen.curve(bow, self.map.at(to[0], to[1]), self.step);
        self.at = to;
    }

    /// Draws a line to the start of the subpath; the next line begins another subpath there.
    pub(super) fn close(&mut self) {
        if self.is_down {
            self.line(self.first);
        }
        self.start(self.first);
    }

    /// Draws a Bezier curve from its control points behind the start, and returns the last control point before its end.
    pub(super) fn bezier(&mut self, controls: &[[f64; 2]]) -> Option<[f64; 2]> {
        let map: Map = self.map;
        let places = std::iter::once(&self.at).chain(controls).map(|[x, y]| map.at(*x, *y)).collect();
        let (&to, before) = controls.split_last()?;
        self.bow(&Bow::Bezier(places), to);
        before.last().copied()
    }

    /// Draws an elliptical arc.
    pub(super) fn arc(&mut self, numbers: [f64; 3], flags: [bool; 2], to: [f64; 2]) {
        match Bow::arc([self.at, to], numbers, flags, self.map) {
            Some(bow) => self.bow(&bow, to),
            None => self.line(to),
        }
    }
}
