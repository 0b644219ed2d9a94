//! Circular arcs of a program.

use std::f64::consts::TAU;

use crate::geom::{Point, Vector};
use crate::machine::gcode::Gcode;
use crate::units::number::fixed;

/// Greatest difference between the radii at the two ends of an arc, in steps of the last decimal.
const RADIUS_STEPS: f64 = 8.0;
/// Smallest sweep of an arc and smallest distance of a sweep from a full turn, rad: controllers may read a smaller one either
/// way.
const SWEEP_MIN: f64 = 1e-5;

/// Circular arc about a centre, with a radius that may change linearly.
#[derive(Debug, Clone, Copy)]
pub(super) struct Arc {
    pub(super) centre: Point,
    /// Start point relative to the centre.
    pub(super) start: Vector,
    /// Radius at the end divided by the radius at the start.
    pub(super) grown: f64,
    pub(super) sweep: f64,
}

impl Arc {
    /// Arc from one point to another about a centre at `[i, j]` mm from the first; `way` is 1 for a left turn, -1 for a right
    /// turn. The error is the end of a message about the line.
    pub(super) fn new([from, to]: [Point; 2], [i, j]: [f64; 2], way: f64, keys: &Gcode) -> Result<Self, String> {
        let start = Vector::new(-i, -j);
        let centre = from - start;
        let end = to - centre;
        let radii = [start.norm(), end.norm()];
        if radii[0] == 0.0 || (radii[0] - radii[1]).abs() > RADIUS_STEPS * keys.step() {
            return Err(format!(
                "is an arc whose ends lie {} and {} mm from its centre",
                fixed(radii[0], keys.decimals + 1),
                fixed(radii[1], keys.decimals + 1)
            ));
        }
        if keys.max_radius_mm.is_some_and(|most| radii[0] > most + RADIUS_STEPS * keys.step()) {
            return Err(format!("is an arc of radius {} mm, which this controller misses", fixed(radii[0], 0)));
        }
        let angle = |v: Vector| v.y.atan2(v.x);
        let turned = (way * (angle(end) - angle(start))).rem_euclid(TAU);
        if turned != 0.0 && turned.min(TAU - turned) < SWEEP_MIN {
            return Err("is an arc that may be none or a whole turn".to_owned());
        }
        let sweep = way * if turned == 0.0 { TAU } else { turned };
        Ok(Self { centre, start, grown: radii[1] / radii[0], sweep })
    }

    /// Point at a share of the sweep, and its derivative with respect to the share.
    pub(super) fn at(&self, share: f64) -> (Point, Vector) {
        let (sin, cos) = (self.sweep * share).sin_cos();
        let arm = Vector::new(self.start.x * cos - self.start.y * sin, self.start.x * sin + self.start.y * cos)
            * (1.0 + (self.grown - 1.0) * share);
        (self.centre + arm, Vector::new(-arm.y, arm.x) * self.sweep)
    }
}
