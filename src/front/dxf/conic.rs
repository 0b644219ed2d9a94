//! Circles and ellipses, and arcs of them, as chords.

use std::f64::consts::TAU;

use crate::geom::affine::Affine;
use crate::geom::{Point, Vector};

/// Fewest chords of a whole turn: a curve that closes has an inside.
const FEWEST: f64 = 8.0;

/// An arc of an ellipse: `centre + cos(t) across + sin(t) up` for `t` from `start` on.
#[derive(Debug, Clone, Copy)]
pub(super) struct Conic {
    pub(super) centre: Point,
    /// Conjugate half axes of the ellipse, mm.
    pub(super) across: Vector,
    pub(super) up: Vector,
    /// Start, rad.
    pub(super) start: f64,
    /// Sweep, rad; `TAU` = once around.
    pub(super) sweep: f64,
}

impl Conic {
    /// This conic under a map.
    pub(super) fn mapped(&self, map: &Affine) -> Self {
        let [across, up] = [self.across, self.up].map(|way| map.vector(way));
        Self { centre: map.point(self.centre), across, up, ..*self }
    }

    /// Whether it comes back to where it starts.
    pub(super) fn is_closed(&self) -> bool {
        self.sweep.abs() >= TAU
    }

    /// Number of chords that keep within `sagitta` mm of it: of a circle of radius `r` a chord over an angle `a` is
    /// `r (1 - cos(a/2))` off, and an ellipse is nowhere farther off than the circle around it.
    pub(super) fn chords(&self, sagitta: f64) -> usize {
        let radius = self.reach();
        // The same by the half angle, which keeps its digits where the radius is large: 1 - cos(a/2) = 2 sin^2(a/4).
        let step = if sagitta < radius { 4.0 * (sagitta / (2.0 * radius)).sqrt().asin() } else { TAU };
        (self.sweep.abs() / step.min(TAU / FEWEST)).ceil().max(1.0) as usize
    }

    /// Its place after so much of its sweep.
    pub(super) fn place(&self, share: f64) -> Point {
        let (sin, cos) = (self.start + share * self.sweep).sin_cos();
        self.centre + self.across * cos + self.up * sin
    }

    /// Half of its longest diameter, mm.
    pub(super) fn reach(&self) -> f64 {
        Affine::of([self.across, self.up]).stretch()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn chords_of_a_mapped_circle_keep_within_their_sagitta() {
        let circle = Conic {
            centre: Point::new(10.0, 20.0),
            across: Vector::new(50.0, 0.0),
            up: Vector::new(0.0, 50.0),
            start: 0.4,
            sweep: TAU,
        };
        let map = Affine::scale(3.0, 0.5).then(&Affine::turn(0.7));
        let ellipse = circle.mapped(&map);
        let count = ellipse.chords(0.01);
        for k in 0..count {
            let at = |of: f64| ellipse.place((k as f64 + of) / count as f64);
            let middle = at(0.0) + (at(1.0) - at(0.0)) / 2.0;
            assert!((middle - at(0.5)).norm() <= 0.01);
            assert!((map.point(circle.place(k as f64 / count as f64)) - at(0.0)).norm() < 1e-9);
        }
        assert!(ellipse.is_closed() && (ellipse.place(1.0) - ellipse.place(0.0)).norm() < 1e-9);
    }
}
