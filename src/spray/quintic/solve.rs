//! Every pass by polynomials, at a speed that the axes can follow.

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

/// Share of what the verifier allows a direction to be off that polynomials use.
const SHARE: f64 = 0.9;
/// Shares of what the axes can do that the clock of polynomials asks of them, one after the other.
const GENTLER: [f64; 4] = [1.0, 0.6, 0.35, 0.2];

/// Rounds of slowing down where the jet is too fast, or the axes are; what is left then certify and the verifier judge.
const ROUNDS: usize = 12;

/// The least share of its speed that a leg is brought to.
const LEAST_SHARE: f64 = 0.1;

/// What of the head's motion is planned before passes are joined.
#[derive(Debug, Default)]
pub(in crate::spray) struct Solved {
    /// Each pass.
    pub(in crate::spray) cuts: Vec<Cut>,
    /// Speeds of X and Y of each pass at its ticks, mm/s; none with another planner.
    pub(in crate::spray) velocities: Vec<Vec<[f64; 2]>>,
    /// What was fitted to each stretch of each pass; none with another planner.
    pub(in crate::spray) fits: Vec<Vec<Vec<Fit>>>,
}

/// A pass as it is cut.
struct Driven {
    cut: Cut,
    velocities: Vec<[f64; 2]>,
    fits: Vec<Vec<Fit>>,
    /// The share of its speed on each leg that the axes can follow; `None` where they can everywhere.
    strain: Option<Vec<f64>>,
}

/// All passes of a course; why there are no polynomials for one is a diagnostic.
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
            // Where so much is asked the axes cannot follow polynomials: certify says so.
            if slowed.iter().zip(pass).any(|(slowed, leg)| slowed.speed < LEAST_SHARE * leg.speed) {
                break;
            }
            // What the clock of slower legs cannot be fitted to is left as it was: then the verifier judges.
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

/// By what share the head must be slower on each leg, and on those near it, so that the axes can follow what was planned.
fn strain(planned: &Planned, pass: &[Leg], job: &Job) -> Option<Vec<f64>> {
    let mut shares = planned.strain(pass.len(), &Drives::of(job))?;
    slower::spread(&mut shares, pass);
    Some(shares)
}

/// What was planned for a pass whose first leg has that number, as a cut.
fn driven(planned: Planned, first: u32, job: &Job) -> Driven {
    let Planned { mut poses, velocities, legs, fits } = planned;
    for pose in &mut poses {
        pose.c.0 -= FRAC_PI_2;
    }
    let cut = Cut::sampled(poses, cuts::spells(&legs, first), job.profile.time.period());
    Driven { cut, velocities, fits, strain: None }
}

/// A pass: polynomials ask more of the axes than its clock does, so where they ask too much it goes more gently.
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

/// What is said where polynomials stay too far from the course.
fn unfit(Unfit { worst: [distance, turn] }: Unfit) -> Diagnostic {
    let (distance, turn) = (fixed(distance, 3), fixed(deg(turn), 3));
    let message = format!("polynomials stay {distance} mm and {turn} degrees from the way of the head");
    let hint = "`quintic.basis = \"chebyshev\"`, a greater `path.tolerance_mm` or `verify.max_heading_deg`, or `tool.planner = \"optimal\"`";
    Diagnostic::new(&code::SPRAY_UNFIT, message).hint(hint)
}
