//! The motion of a pass: what is fitted to its stretches, and what that makes of it at each tick.

use super::split::{self, Allowed, Fit};
use super::timeline::Timeline;
use crate::geom::{Point, Rotation};
use crate::ir::toolpath::Pose;
use crate::machine::{Limits, Quintic};
use crate::spray::clock::{Clock, Drives, Timed};
use crate::spray::course::{Role, Stretch};

/// How often the course is sampled to be fitted, s.
const SAMPLE: f64 = 1e-3;
/// The fewest samples of a stretch.
const LEAST_SAMPLES: usize = 24;
/// By how much less than the tolerance pieces are fitted to when transitions miss it.
const LESS: f64 = 0.6;
/// Rounds of that.
const ROUNDS: usize = 8;

/// The motion of a pass.
#[derive(Debug)]
pub(super) struct Planned {
    /// X, Y and C of the axes at each tick, the last one included.
    pub(super) poses: Vec<Pose>,
    /// Speeds of X and Y there, mm/s.
    pub(super) velocities: Vec<[f64; 2]>,
    /// The leg at each tick.
    pub(super) legs: Vec<usize>,
    /// What was fitted to each stretch of the pass, in order; none to a corner without splitting.
    pub(super) fits: Vec<Vec<Fit>>,
}

impl Planned {
    /// Whether the differences of the poses keep the limits of the axes, which rest before and behind.
    pub(super) fn keeps(&self, drives: &Drives) -> bool {
        let Drives { limits, period } = *drives;
        let place = |i: usize| {
            let pose = &self.poses[i.saturating_sub(3).min(self.poses.len() - 1)];
            [pose.centre.x, pose.centre.y, pose.c.0]
        };
        (3..self.poses.len() + 6).all(|i| {
            let [a, b, c, d] = [place(i), place(i - 1), place(i - 2), place(i - 3)];
            (0..3).all(|axis| {
                let Limits { speed, acceleration, jerk } = limits[axis];
                (a[axis] - b[axis]).abs() <= speed * period
                    && (a[axis] - 2.0 * b[axis] + c[axis]).abs() <= acceleration * period.powi(2)
                    && (a[axis] - 3.0 * b[axis] + 3.0 * c[axis] - d[axis]).abs() <= jerk * period.powi(3)
            })
        })
    }
}

/// What polynomials could not be found for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Unfit {
    /// How far from the course they stay, mm and rad.
    pub(super) worst: [f64; 2],
}

/// What is asked of the polynomials of a pass.
#[derive(Debug, Clone, Copy)]
pub(super) struct Asked<'a> {
    pub(super) quintic: &'a Quintic,
    pub(super) allowed: Allowed,
    pub(super) limits: &'a [Limits; 3],
}

/// A stretch of a pass and its places in time.
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

/// Places in time along a stretch, its ends included.
fn sampled(clock: &Clock, stretch: &Stretch) -> Sampled {
    let [from, to] = [stretch.legs.start, stretch.legs.end].map(|leg| clock.at_leg(leg));
    let count = (((to - from) / SAMPLE) as usize).max(LEAST_SAMPLES);
    let samples = (0..=count).map(|i| clock.at(from + (to - from) * i as f64 / count as f64)).collect();
    Sampled { role: stretch.role, samples }
}

/// What is fitted to each stretch.
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
