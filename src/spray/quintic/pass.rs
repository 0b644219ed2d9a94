//! Motion of a pass: the polynomials of its stretches, and the setpoint at each tick.

use super::split::{self, Allowed, Fit};
use super::timeline::Timeline;
use crate::geom::{Point, Rotation};
use crate::ir::toolpath::Pose;
use crate::machine::{Limits, Quintic};
use crate::spray::clock::{Clock, Drives, Timed};
use crate::spray::course::{Role, Stretch};

/// Sampling interval of the course for fitting, s.
const SAMPLE: f64 = 1e-3;
/// Minimum number of samples of a stretch.
const LEAST_SAMPLES: usize = 24;
/// Factor by which the tolerance of the pieces shrinks when transitions exceed the tolerance.
const LESS: f64 = 0.6;
/// Maximum number of rounds with a smaller tolerance.
const ROUNDS: usize = 8;
/// Ratio of a lowered speed to the limit of the axes, and the minimum ratio by which a speed is lowered at once.
const LOWERED: f64 = 0.97;
const LEAST_SHARE: f64 = 0.5;

/// The motion of a pass.
#[derive(Debug)]
pub(super) struct Planned {
    /// Poses of the axes at each tick, with the last one.
    pub(super) poses: Vec<Pose>,
    /// Speeds of X and Y at each tick, mm/s.
    pub(super) velocities: Vec<[f64; 2]>,
    /// Index of the leg at each tick.
    pub(super) legs: Vec<usize>,
    /// Fits of each stretch of the pass, in order; empty for a corner without splitting.
    pub(super) fits: Vec<Vec<Fit>>,
}

impl Planned {
    /// Factors of the speed on each leg with which the differences of the poses stay within the limits of the axes, which rest
    /// before and after; `None` if they already do.
    pub(super) fn strain(&self, legs: usize, drives: &Drives) -> Option<Vec<f64>> {
        let last = self.poses.len() - 1;
        let tick = |i: usize| i.saturating_sub(3).min(last);
        let place = |i: usize| {
            let pose = &self.poses[tick(i)];
            [pose.centre.x, pose.centre.y, pose.c.0]
        };
        let mut shares = vec![1.0_f64; legs];
        for i in 3..last + 7 {
            let strain = strain([i, i - 1, i - 2, i - 3].map(place), drives);
            if strain > 1.0 {
                for leg in &mut shares[self.legs[tick(i - 3)]..=self.legs[tick(i)]] {
                    *leg = leg.min((LOWERED / strain).max(LEAST_SHARE));
                }
            }
        }
        shares.iter().any(|&share| share < 1.0).then_some(shares)
    }
}

/// Factor by which four consecutive positions are too fast for the axes. A motion that is slower by it keeps the limit of every
/// order of difference.
fn strain([a, b, c, d]: [[f64; 3]; 4], drives: &Drives) -> f64 {
    let Drives { limits, period } = *drives;
    let of_axis = |axis: usize| {
        let (Limits { speed, acceleration, jerk }, [a, b, c, d]) =
            (limits[axis], [a, b, c, d].map(|place| place[axis]));
        let speed = (a - b).abs() / (speed * period);
        let acceleration = (a - 2.0 * b + c).abs() / (acceleration * period.powi(2));
        let jerk = (a - 3.0 * b + 3.0 * c - d).abs() / (jerk * period.powi(3));
        speed.max(acceleration.sqrt()).max(jerk.cbrt())
    };
    (0..3).map(of_axis).fold(0.0, f64::max)
}

/// Failure of the polynomials to follow the course.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Unfit {
    /// Deviation from the course, mm and rad.
    pub(super) worst: [f64; 2],
}

/// Requirements on the polynomials of a pass.
#[derive(Debug, Clone, Copy)]
pub(super) struct Asked<'a> {
    pub(super) quintic: &'a Quintic,
    pub(super) allowed: Allowed,
    pub(super) limits: &'a [Limits; 3],
}

/// A stretch of a pass with its timed positions.
struct Sampled {
    role: Role,
    samples: Vec<Timed>,
}

/// Plans a pass.
pub(super) fn plan(clock: &Clock, stretches: &[Stretch], asked: &Asked) -> Result<Planned, Unfit> {
    let Asked { quintic, allowed, limits } = *asked;
    let sampled: Vec<Sampled> = stretches.iter().map(|stretch| sampled(clock, stretch)).collect();
    let mut share = 1.0;
    let mut worst = [f64::INFINITY; 2];
    for _ in 0..ROUNDS {
        let within = Allowed { distance: share * allowed.distance, turn: share * allowed.turn };
        let fits = fitted(&sampled, quintic, within).ok_or(Unfit { worst })?;
        let ends = [clock.at(0.0), clock.at(clock.duration())];
        let timeline = Timeline::new(fits.iter().flatten(), ends, limits).ok_or(Unfit { worst })?;
        worst = timeline.worst(sampled.iter().flat_map(|stretch| &stretch.samples));
        if !quintic.split || (worst[0] <= allowed.distance && worst[1] <= allowed.turn) {
            return Ok(ticked(clock, &timeline, fits));
        }
        share *= LESS;
    }
    Err(Unfit { worst })
}

/// Timed positions along a stretch, with its ends.
fn sampled(clock: &Clock, stretch: &Stretch) -> Sampled {
    let [from, to] = [stretch.legs.start, stretch.legs.end].map(|leg| clock.at_leg(leg));
    let count = (((to - from) / SAMPLE) as usize).max(LEAST_SAMPLES);
    let samples = (0..=count).map(|i| clock.at(from + (to - from) * i as f64 / count as f64)).collect();
    Sampled { role: stretch.role, samples }
}

/// The fits of each stretch; `None` if a fit cannot be solved.
fn fitted(stretches: &[Sampled], quintic: &Quintic, within: Allowed) -> Option<Vec<Vec<Fit>>> {
    let Quintic { basis, split } = *quintic;
    let fit = |Sampled { role, samples }: &Sampled| match (split, role) {
        (true, _) => split::split(samples, basis, within),
        (false, Role::Edge) => Some(vec![Fit::of(samples, basis)?]),
        (false, Role::Corner | Role::Air) => Some(Vec::new()),
    };
    stretches.iter().map(fit).collect()
}

/// The motion at each tick.
fn ticked(clock: &Clock, timeline: &Timeline, fits: Vec<Vec<Fit>>) -> Planned {
    let mut planned = Planned { poses: Vec::new(), velocities: Vec::new(), legs: Vec::new(), fits };
    for time in (0..=clock.periods()).map(|tick| clock.at_tick(tick)) {
        let [x, y, aim] = timeline.at(time);
        planned.poses.push(Pose { centre: Point::new(x[0], y[0]), c: Rotation(aim[0]) });
        planned.velocities.push([x[1], y[1]]);
        planned.legs.push(clock.at(time).leg);
    }
    planned
}
