//! Planning of all passes by polynomials, at a speed that the axes can follow.

use std::f64::consts::FRAC_PI_2;

use super::pass::{self, Asked, Planned, Unfit};
use super::split::{Allowed, Fit};
use crate::diagnostic::{Diagnostic, code};
use crate::machine::Job;
use crate::plan::Cut;
use crate::spray::clock::{Clock, Drives};
use crate::spray::course::{Course, Leg, Pace, Reach, stretches};
use crate::spray::{cuts, slower};
use crate::units::deg;
use crate::units::number::fixed;

/// Fraction of the direction error permitted by the verifier that polynomials use.
const SHARE: f64 = 0.9;
/// Fractions of the axis limits that the clock of polynomials uses, tried in turn.
const GENTLER: [f64; 4] = [1.0, 0.6, 0.35, 0.2];

/// Maximum number of rounds that lower the speed where the jet is too fast or the axes cannot follow. The certificate and the
/// verifier judge any excess that remains.
const ROUNDS: usize = 12;

/// Minimum ratio of a lowered speed of a leg to its original speed.
const LEAST_SHARE: f64 = 0.1;

/// Motion of the head before passes are joined.
#[derive(Debug, Default)]
pub(in crate::spray) struct Solved {
    /// Cut of each pass.
    pub(in crate::spray) cuts: Vec<Cut>,
    /// Speeds of X and Y of each pass at its ticks, mm/s; empty with another planner.
    pub(in crate::spray) velocities: Vec<Vec<[f64; 2]>>,
    /// Fits of each stretch of each pass; empty with another planner.
    pub(in crate::spray) fits: Vec<Vec<Vec<Fit>>>,
}

/// A planned pass.
struct Driven {
    cut: Cut,
    velocities: Vec<[f64; 2]>,
    fits: Vec<Vec<Fit>>,
    /// Factors of the speed on each leg that the axes can follow; `None` if they can follow everywhere.
    strain: Option<Vec<f64>>,
}

/// Solves all passes of a course. The error tells why a pass cannot be fitted.
pub(in crate::spray) fn solve(course: &Course, job: &Job) -> Result<Solved, Diagnostic> {
    let mut solved = Solved::default();
    let mut first = 1;
    for pass in &course.passes {
        let mut slowed = pass.clone();
        let driven = |pass: &[Leg]| {
            let planned = gentle(pass, course, job)?;
            let strain = strain(&planned, pass, job);
            Ok(Driven { strain, ..driven(planned, first, job) })
        };
        let mut last = driven(&slowed).map_err(unfit)?;
        for _ in 0..ROUNDS {
            let mut slower =
                [slower::shares(&last.cut, &slowed, job), last.strain.take()].into_iter().flatten().peekable();
            if slower.peek().is_none() {
                break;
            }
            for shares in slower {
                slowed.iter_mut().zip(&shares).for_each(|(leg, share)| leg.speed *= share);
            }
            // If the speed would drop this far, the axes cannot follow polynomials. The certificate reports it.
            if slowed.iter().zip(pass).any(|(slowed, leg)| slowed.speed < LEAST_SHARE * leg.speed) {
                break;
            }
            // If the slower legs cannot be fitted, the last motion stays and the verifier judges it.
            let Ok(next) = driven(&slowed) else { break };
            last = next;
        }
        let Driven { cut, velocities, fits, .. } = last;
        solved.cuts.push(cut);
        solved.velocities.push(velocities);
        solved.fits.push(fits);
        first += pass.len() as u32;
    }
    Ok(solved)
}

/// Factors of the speed on each leg, applied to its surroundings as well, with which the axes can follow the plan.
fn strain(planned: &Planned, pass: &[Leg], job: &Job) -> Option<Vec<f64>> {
    let mut shares = planned.strain(pass.len(), &Drives::of(job))?;
    slower::spread(&mut shares, pass);
    Some(shares)
}

/// A planned pass as a cut. `first` is the number of its first leg.
fn driven(planned: Planned, first: u32, job: &Job) -> Driven {
    let Planned { mut poses, velocities, legs, fits } = planned;
    for pose in &mut poses {
        pose.c.0 -= FRAC_PI_2;
    }
    let cut = Cut::sampled(poses, cuts::spells(&legs, first), job.profile.time.period());
    Driven { cut, velocities, fits, strain: None }
}

/// Plans a pass. Polynomials need more of the axes than their clock does, so the clock is slowed until they can follow.
fn gentle(pass: &[Leg], course: &Course, job: &Job) -> Result<Planned, Unfit> {
    let (pace, drives) = (&course.pace, Drives::of(job));
    let turn = SHARE * job.profile.verify.max_heading_deg.to_radians();
    let allowed = Allowed { distance: course.tolerance, turn };
    let asked = Asked { quintic: &job.profile.quintic, allowed, limits: &drives.limits };
    let stretches = stretches(pass);
    let plan = |share: f64| {
        let reach = Reach { acceleration: share * pace.reach.acceleration, jerk: share * pace.reach.jerk };
        pass::plan(&Clock::new(pass, &Pace { reach, ..*pace }, &drives), &stretches, &asked)
    };
    let mut planned = plan(GENTLER[0]);
    for &share in &GENTLER[1..] {
        if planned.as_ref().is_ok_and(|planned| planned.strain(pass.len(), &drives).is_none()) {
            break;
        }
        planned = plan(share).or(planned);
    }
    planned
}

/// Diagnostic for polynomials that deviate too far from the course.
fn unfit(Unfit { worst: [distance, turn] }: Unfit) -> Diagnostic {
    let (distance, turn) = (fixed(distance, 3), fixed(deg(turn), 3));
    let message = format!("polynomials stay {distance} mm and {turn} degrees from the way of the head");
    let hint = "`quintic.basis = \"chebyshev\"`, a greater `path.tolerance_mm` or `verify.max_heading_deg`, or `tool.planner = \"optimal\"`";
    Diagnostic::new(&code::SPRAY_UNFIT, message).hint(hint)
}
