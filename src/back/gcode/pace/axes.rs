//! Axes of a controller: their limits, and what they allow along a direction.

use crate::machine::{Job, Limits};
use crate::units::deg;

/// Speed and acceleration of an axis, mm or degrees.
#[derive(Debug, Clone, Copy)]
pub(super) struct Axis {
    pub(super) speed: f64,
    pub(super) acceleration: f64,
}

/// Letters of the axes, in the order of their distances.
pub(super) const AXES_XYZC: [char; 4] = ['x', 'y', 'z', 'c'];

/// Limits of X, Y, Z and the axis of the blade with the knife down, and with the knife up, mm and degrees.
pub(super) fn axes(job: &Job) -> [[Axis; 4]; 2] {
    let (keys, axes) = (&job.profile.gcode, &job.profile.axes);
    let linear = |limits: &Limits| Axis { speed: limits.speed, acceleration: limits.acceleration };
    let z = Axis {
        speed: keys.z_speed_mm_s.unwrap_or(f64::INFINITY),
        acceleration: keys.z_acceleration_mm_s2.unwrap_or(f64::INFINITY),
    };
    [axes.limits(), axes.travel_limits()].map(|[x, y, c]| {
        let c = Axis { speed: deg(c.speed), acceleration: deg(c.acceleration) };
        [linear(&x), linear(&y), z, c]
    })
}

/// Greatest value along a direction at which no axis exceeds its own, and the letter of the axis that limits it.
pub(super) fn slowest(along: [f64; 4], most: [f64; 4]) -> (f64, char) {
    let shares =
        along.iter().zip(most).map(|(share, most)| if *share == 0.0 { f64::INFINITY } else { most / share.abs() });
    shares.zip(AXES_XYZC).fold((f64::INFINITY, 'x'), |least, next| if next.0 < least.0 { next } else { least })
}

/// Length of a way along all axes, degrees counted as mm.
pub(super) fn norm(ways: [f64; 4]) -> f64 {
    ways.iter().map(|way| way * way).sum::<f64>().sqrt()
}
