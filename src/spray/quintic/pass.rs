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
/// How far below what the axes can do a leg is slowed down, and the least share of its speed at once.
const LOWERED: f64 = 0.97;
const LEAST_SHARE: f64 = 0.5;

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
    /// By what share the head must be slower on each leg so that the differences of the poses keep the limits of the axes,
    /// which rest before and behind; `None` where they do.
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

/// How many times too fast four places in a row are for the axes: a motion that is slower by so much keeps each order of
/// difference.
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
