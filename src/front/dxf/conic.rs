//! Conversion of circles, ellipses and their arcs to chords.

use std::f64::consts::TAU;

use crate::geom::affine::Affine;
use crate::geom::{Point, Vector};

/// Minimum number of chords per turn, so that a closed curve has an interior.
const FEWEST: f64 = 8.0;

/// An arc of an ellipse: `centre + cos(t) across + sin(t) up`, with `t` starting at `start`.
#[derive(Debug, Clone, Copy)]
pub(super) struct Conic {
    pub(super) centre: Point,
    /// Conjugate semi-axes of the ellipse, mm.
    pub(super) across: Vector,
    pub(super) up: Vector,
    /// Start parameter, rad.
    pub(super) start: f64,
    /// Sweep, rad; `TAU` for a full ellipse.
    pub(super) sweep: f64,
}

impl Conic {
    /// Image of the conic under a map.
    pub(super) fn mapped(&self, map: &Affine) -> Self {
        let [across, up] = [self.across, self.up].map(|way| map.vector(way));
        Self { centre: map.point(self.centre), across, up, ..*self }
    }

    /// True if the conic ends at its start point.
    pub(super) fn is_closed(&self) -> bool {
        self.sweep.abs() >= TAU
    }

    /// Number of chords within `sagitta` mm of the conic. On a circle of radius `r` a chord over an angle `a` deviates by
    /// `r (1 - cos(a/2))`; on an ellipse the deviation is at most that of the circumscribed circle.
    pub(super) fn chords(&self, sagitta: f64) -> usize {
        let radius = self.reach();
        // The formula uses a quarter of the angle, which keeps its precision at large radii: 1 - cos(a/2) = 2 sin^2(a/4).
        let step = if sagitta < radius { 4.0 * (sagitta / (2.0 * radius)).sqrt().asin() } else { TAU };
        (self.sweep.abs() / step.min(TAU / FEWEST)).ceil().max(1.0) as usize
    }

    /// Point at a fraction of the sweep.
    pub(super) fn place(&self, share: f64) -> Point {
        let (sin, cos) = (self.start + share * self.sweep).sin_cos();
        self.centre + self.across * cos + self.up * sin
    }

    /// Half of the longest diameter, mm.
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
