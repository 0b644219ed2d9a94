//! Conversion of arcs to chords.

use std::f64::consts::TAU;

use crate::geom::{Point, Vector, left};

/// A circular arc.
#[derive(Debug, Clone, Copy)]
pub(in crate::front) struct Arc {
    pub(in crate::front) centre: Point,
    /// Radius, mm.
    pub(in crate::front) radius: f64,
    /// Start angle, rad from +X.
    pub(in crate::front) start: f64,
    /// Sweep, rad, counter-clockwise positive.
    pub(in crate::front) sweep: f64,
}

impl Arc {
    /// Number of chords within `sagitta` mm of the arc. A chord over an angle `a` deviates by `r (1 - cos(a/2))`.
    pub(in crate::front) fn chords(&self, sagitta: f64) -> usize {
        // The formula uses a quarter of the angle, which keeps its precision at large radii: 1 - cos(a/2) = 2 sin^2(a/4).
        let step = if sagitta < self.radius { 4.0 * (sagitta / (2.0 * self.radius)).sqrt().asin() } else { TAU / 4.0 };
        // At least four chords per turn, so that a closed curve has an interior.
        (self.sweep.abs() / step.min(TAU / 4.0)).ceil().max(1.0) as usize
    }

    /// Point at a fraction of the sweep.
    pub(in crate::front) fn place(&self, share: f64) -> Point {
        let (sin, cos) = (self.start + share * self.sweep).sin_cos();
        self.centre + self.radius * Vector::new(cos, sin)
    }
}

/// Arc between two points with a bulge, the tangent of a quarter of its sweep (DXF reference, group 42). `None` if the arc
/// stays within `sagitta` mm of its chord: it is then straight, and its centre may be beyond all numbers.
pub(in crate::front) fn bulged([from, to]: [Point; 2], bulge: f64, sagitta: f64) -> Option<Arc> {
    let chord = to - from;
    if height(chord, bulge) <= sagitta {
        return None;
    }
    let sweep = 4.0 * bulge.atan();
    // The centre is on the left of the chord for a sweep below half a turn.
    let centre = from + chord / 2.0 + left(chord) * ((1.0 - bulge * bulge) / (4.0 * bulge));
    let spoke = from - centre;
    Some(Arc { centre, radius: spoke.norm(), start: spoke.y.atan2(spoke.x), sweep })
}

/// Height of an arc above its chord, mm: half the chord length times the bulge.
pub(in crate::front) fn height(chord: Vector, bulge: f64) -> f64 {
    bulge.abs() * chord.norm() / 2.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_bulge_of_one_is_half_a_circle_to_the_right_of_its_chord() {
        let [from, to] = [Point::new(0.0, 0.0), Point::new(10.0, 0.0)];
        let arc = bulged([from, to], 1.0, 0.01).expect("an arc");
        assert!((arc.centre - Point::new(5.0, 0.0)).norm() < 1e-12);
        assert!((arc.place(0.5) - Point::new(5.0, -5.0)).norm() < 1e-12);
        assert!((arc.place(1.0) - to).norm() < 1e-12);
        let arc = bulged([from, to], -0.2, 0.01).expect("an arc");
        assert!((arc.place(0.0) - from).norm() < 1e-9 && (arc.place(1.0) - to).norm() < 1e-9);
        assert!((arc.place(0.5) - Point::new(5.0, 1.0)).norm() < 1e-9);
    }

    #[test]
    fn a_bulge_that_nobody_could_cut_is_straight() {
        let ends = [Point::new(0.0, 0.0), Point::new(1000.0, 0.0)];
        assert!([0.0, 1e-7, -1e-5, 1e-300].iter().all(|&bulge| bulged(ends, bulge, 0.01).is_none()));
        let flat = bulged(ends, 1e-4, 0.01).expect("it is 0.05 mm high");
        assert!((2..=4).contains(&flat.chords(0.01)) && (flat.place(1.0) - ends[1]).norm() < 1e-6);
    }

    #[test]
    fn chords_keep_within_their_sagitta() {
        let arc = Arc { centre: Point::origin(), radius: 100.0, start: 0.3, sweep: 2.0 };
        let count = arc.chords(0.01);
        let middle = arc.place(0.5 / count as f64);
        let [a, b] = [0.0, 1.0].map(|k| arc.place(k / count as f64));
        assert!((a + (b - a) / 2.0 - middle).norm() <= 0.01);
        assert!(Arc { radius: 0.001, sweep: TAU, ..arc }.chords(0.01) >= 4);
    }
}
