//! Figures of a plot: arcs, circles, curves, rectangles and wedges.

use std::f64::consts::TAU;

use super::Lowering;
use crate::front::hpgl::curve::{Arc, Bezier, Through};
use crate::source::Span;
use crate::units::rad;

/// Degrees of a full turn.
const FULL_TURN: f64 = 360.0;

impl Lowering<'_> {
    /// AA, AR: centre, sweep in degrees, and a chord angle that the tolerance replaces.
    pub(super) fn arc(&mut self, is_relative: bool, span: Span) {
        let values = self.values::<4>();
        let [x, y, degrees, ..] = values[..] else { return self.incomplete(span) };
        let pair = [x, y];
        let centre = if is_relative { self.plotter.relative(pair) } else { self.plotter.absolute(pair) };
        let (from, stretch) = (self.plotter.at(), self.plotter.frame.stretch());
        self.follow(Arc { from, centre, sweep: rad(degrees), stretch }, span);
    }

    /// AT, RT: a middle and an end.
    pub(super) fn arc_through(&mut self, is_relative: bool, span: Span) {
        let values = self.values::<5>();
        let [x1, y1, x2, y2, ..] = values[..] else { return self.incomplete(span) };
        let place = |pair| if is_relative { self.plotter.relative(pair) } else { self.plotter.absolute(pair) };
        let (middle, to) = (place([x1, y1]), place([x2, y2]));
        let (from, stretch) = (self.plotter.at(), self.plotter.frame.stretch());
        if let Some(arc) = Arc::through(Through { from, middle, to, stretch }, self.sagitta) {
            self.follow(arc, span);
        }
        let outcome = self.plotter.go(to, span);
        self.check(outcome, span);
        if !is_relative {
            self.plotter.settle();
        }
    }

    fn follow(&mut self, arc: Arc, span: Span) {
        let outcome = self.plotter.follow(arc.flatten(self.sagitta), span);
        self.check(outcome, span);
    }

    /// CI: radius, around the place of the pen.
    pub(super) fn circle(&mut self, span: Span) {
        let Some(radius) = self.values::<2>().first().copied() else { return self.incomplete(span) };
        let centre = self.plotter.at();
        let [across, _] = self.plotter.relative([radius, 0.0]);
        let start = [across, centre[1]];
        let arc = Arc { from: start, centre, sweep: TAU, stretch: self.plotter.frame.stretch() };
        let outcome = self.plotter.figure(start, arc.flatten(self.sagitta), span);
        self.check(outcome, span);
    }

    /// BZ, BR: three control points a curve; those of BR are relative to its start.
    pub(super) fn beziers(&mut self, is_relative: bool) {
        while let Some((first, start)) = self.pair() {
            let (Some((second, _)), Some((third, end))) = (self.pair(), self.pair()) else {
                self.tally.odd(start);
                return self.incomplete(start);
            };
            self.tally.places += 3 * usize::from(self.plotter.is_drawing());
            let span = start.to(end);
            let place = |pair| if is_relative { self.plotter.relative(pair) } else { self.plotter.absolute(pair) };
            let curve = Bezier([self.plotter.at(), place(first), place(second), place(third)]);
            let outcome = self.plotter.follow(curve.flatten(self.sagitta), span);
            self.check(outcome, span);
            if !is_relative {
                self.plotter.settle();
            }
        }
    }

    /// EA, ER: the opposite corner.
    pub(super) fn rectangle(&mut self, is_relative: bool, span: Span) {
        let values = self.values::<2>();
        let [x, y] = values[..] else { return self.incomplete(span) };
        let pair = [x, y];
        let from = self.plotter.at();
        let to = if is_relative { self.plotter.relative(pair) } else { self.plotter.absolute(pair) };
        let corners = [[to[0], from[1]], to, [from[0], to[1]], from];
        let outcome = self.plotter.figure(from, corners, span);
        self.check(outcome, span);
    }

    /// EW: radius, start and sweep in degrees; a negative radius counts the angles from the other side. A full turn is a
    /// circle without radii.
    pub(super) fn wedge(&mut self, span: Span) {
        let values = self.values::<4>();
        let [radius, start, degrees, ..] = values[..] else { return self.incomplete(span) };
        let centre = self.plotter.at();
        let (sin, cos) = rad(start).sin_cos();
        let from = self.plotter.relative([radius * cos, radius * sin]);
        let stretch = self.plotter.frame.stretch();
        let arc = Arc { from, centre, sweep: rad(degrees), stretch }.flatten(self.sagitta);
        let outcome = if degrees.abs() >= FULL_TURN {
            self.plotter.figure(from, arc, span)
        } else {
            self.plotter.figure(centre, std::iter::once(from).chain(arc).chain([centre]), span)
        };
        self.check(outcome, span);
    }
}
