//! Figures: arcs, circles, rectangles, wedges and polygons.

use std::f64::consts::TAU;

use super::scan::{Corner, Scan};

/// Full turn, degrees.
const FULL_TURN: f64 = 360.0;
impl Scan<'_> {
    /// Executes figures and arcs.
    pub(super) fn figure(&mut self, mnemonic: [u8; 2], numbers: &[f64], cause: usize) {
        match &mnemonic {
            b"AA" | b"AR" => self.arc_about(mnemonic == *b"AR", numbers, cause),
            b"AT" | b"RT" => self.arc_by_way_of(mnemonic == *b"RT", numbers, cause),
            b"CI" => self.whole_circle(numbers, cause),
            b"EA" | b"ER" => self.rectangle(mnemonic == *b"ER", numbers, cause),
            b"EW" => self.wedge(numbers, cause),
            b"PM" => self.gather(numbers, cause),
            b"EP" if self.part.is_none() => self.polygon(),
            _ => {}
        }
    }

    /// AA, AR: arc about a centre.
    fn arc_about(&mut self, is_relative: bool, numbers: &[f64], cause: usize) {
        let &[x, y, degrees, ..] = numbers else { return };
        let from = self.pen.at;
        let centre = self.target([x, y], is_relative);
        if self.leaves_trace() {
            let chords = self.arc(from, centre, degrees.to_radians());
            self.follow(&chords, cause);
        } else {
            let to = self.on_arc([from, centre], degrees.to_radians());
            self.go(to, cause, false);
        }
    }

    /// AT, RT: arc through a place.
    fn arc_by_way_of(&mut self, is_relative: bool, numbers: &[f64], cause: usize) {
        let &[x1, y1, x2, y2, ..] = numbers else { return };
        let from = self.pen.at;
        let middle = self.target([x1, y1], is_relative);
        let to = self.target([x2, y2], is_relative);
        if self.leaves_trace()
            && let Some((centre, sweep)) = self.circle([from, middle, to])
        {
            let chords = self.arc(from, centre, sweep);
            self.follow(&chords, cause);
        }
        self.go(to, cause, self.pen.is_down);
    }

    /// CI: circle about the pen.
    fn whole_circle(&mut self, numbers: &[f64], cause: usize) {
        let &[radius, ..] = numbers else { return };
        let from = self.pen.at;
        let start = [self.target([radius, 0.0], true)[0], from[1]];
        let chords = self.arc(start, from, TAU);
        self.go(start, cause, false);
        self.draw_along(&chords, cause);
        self.go(from, cause, false);
    }

    /// EA, ER: rectangle from the pen.
    fn rectangle(&mut self, is_relative: bool, numbers: &[f64], cause: usize) {
        let &[x, y, ..] = numbers else { return };
        let from = self.pen.at;
        let to = self.target([x, y], is_relative);
        self.go(from, cause, false);
        for corner in [[to[0], from[1]], to, [from[0], to[1]], from] {
            self.go(corner, cause, true);
        }
        self.go(from, cause, false);
    }

    /// EW: wedge about the pen.
    fn wedge(&mut self, numbers: &[f64], cause: usize) {
        let &[radius, start, degrees, ..] = numbers else { return };
        let from = self.pen.at;
        let angle = start.to_radians();
        let start = self.target([radius * angle.cos(), radius * angle.sin()], true);
        let chords = self.arc(start, from, degrees.to_radians());
        let has_radii = degrees.abs() < FULL_TURN;
        if has_radii {
            self.go(from, cause, false);
        }
        self.go(start, cause, has_radii);
        self.draw_along(&chords, cause);
        self.go(from, cause, has_radii);
        self.go(from, cause, false);
    }

    /// PM: starts a polygon, begins its next part, or ends it.
    fn gather(&mut self, numbers: &[f64], cause: usize) {
        let from = self.pen.at;
        let kind = numbers.first().copied().unwrap_or(0.0);
        if kind == 0.0 {
            self.pen.cause = None;
            (self.polygon, self.curves) = (vec![Corner { at: from, cause, draws: false }], Vec::new());
            self.part = Some(0);
            return;
        }
        let Some(part) = self.part else { return };
        let first = self.polygon[part].at;
        self.go(first, cause, true);
        self.go(first, cause, false);
        (self.part, self.is_fresh) = (None, kind == 1.0);
        if self.is_fresh {
            self.part = Some(self.polygon.len() - 1);
        }
    }

    /// EP: draws the current polygon; the pen keeps its place.
    fn polygon(&mut self) {
        let from = self.pen.at;
        self.pen.cause = None;
        self.allow_polygon();
        for Corner { at, cause, draws } in std::mem::take(&mut self.polygon) {
            self.go(at, cause, draws);
            self.polygon.push(Corner { at, cause, draws });
        }
        (self.pen.at, self.pen.cause) = (from, None);
    }
}
