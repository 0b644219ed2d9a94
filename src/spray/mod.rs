//! The head that follows an edge at a distance, turned towards it: a spray gun, a torch, a nozzle.
//!
//! A small pipeline of the shape of the cutter's, the listing in its order:
//!
//! ```text
//! Marker -> edge -> offset -> course -> quintic | the cutter's planner -> Program -> write -> bytes -> verify
//! ```
//!
//! *Rings* are the edges of parts, the material on their left; their offset is the way of the head. A *course* is that way in
//! legs, each with the speed at which the jet goes along the edge as it should; a *pass* is what is driven from rest to
//! rest. The planner `quintic` fits polynomials to the course in time; the default one is the cutter's, with the speed of the
//! head as its feed. `verify` knows the rings as drawn and the bytes, and nothing of who makes them.

mod clock;
mod course;
mod cuts;
mod edge;
mod figures;
mod offset;
mod optimal;
mod program;
mod quintic;
mod reach;
mod rows;
mod tangle;
pub mod verify;
mod write;

pub use figures::{Edge, Piece};
pub use program::Program;
pub use rows::Row;
pub use write::{TARGETS, Target};

use std::f64::consts::{FRAC_PI_2, TAU};

use self::clock::Clock;
use self::course::{Leg, Pace, Pass, Reach, stretches};
use self::quintic::{Allowed, Fit, Planned, Unfit};
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::ir::Marker;
use crate::machine::{Job, Planner};
use crate::plan::{self, Cut, Peaks};
use crate::units::deg;
use crate::units::number::fixed;

/// Share of the tolerances that the planner of a head uses; the rest is for rows in decimals and curves in legs.
const SHARE: f64 = 0.9;
/// Shares of what the axes can do that the clock of polynomials asks of them, one after the other.
const GENTLER: [f64; 4] = [1.0, 0.6, 0.35, 0.2];

/// What of the head's motion is planned before passes are joined.
#[derive(Default)]
struct Solved {
    cuts: Vec<Cut>,
    velocities: Vec<Vec<[f64; 2]>>,
    fits: Vec<Vec<Vec<Fit>>>,
}

/// Plans how a head follows the edges of a marker. `None` when it cannot; why is a diagnostic.
pub fn plan(marker: &Marker, job: &Job, out: &mut Diagnostics) -> Option<(Program, Peaks)> {
    let corner = job.profile.corner.angle();
    let rings = edge::rings(marker, corner, out);
    tangle::report(&rings, out);
    if out.has_errors() {
        return None;
    }
    let pace = pace(job);
    let ways = offset::loops(&rings, pace.distance);
    reach::report(&ways, &rings, pace.distance, out);
    let mut passes = course::passes(&ways, &rings, corner, &pace);
    if passes.is_empty() {
        let message = format!("no edge can be followed at {} mm", fixed(pace.distance, 1));
        out.push(Diagnostic::new(&code::SPRAY_NOTHING, message).hint("take a smaller `tool.distance_mm`"));
        return None;
    }
    turn(&mut passes, job, out)?;
    let tolerance = SHARE * job.profile.tolerance(marker.unit);
    let head = cuts::job_of_head(job);
    let mut toolpath = cuts::toolpath(&passes, tolerance);
    let period = job.profile.time.period();
    let solved = match job.profile.tool.planner {
        Planner::Optimal => match optimal::solve(&mut toolpath, &passes, &head) {
            Ok(cuts) => Solved { cuts, ..Solved::default() },
            Err(refused) => {
                for diagnostic in refused {
                    out.push(diagnostic);
                }
                return None;
            }
        },
        Planner::Quintic => fitted(&passes, &pace, tolerance, job, out)?,
    };
    let mut planner = plan::Planner::new(&head);
    let motions = [planner.join(&toolpath, solved.cuts), planner.finish()];
    if let Err(diagnostic) = planner.certify() {
        let hint = format!("{}; give the axes more, or take smaller speeds of the tool", busiest(&planner.peaks()));
        out.push(diagnostic.hint(hint));
        return None;
    }
    let legs: Vec<&Leg> = passes.iter().flatten().collect();
    let rows = rows::rows(&motions, &legs, &solved.velocities, job.mode.cuts(), period);
    let figures = figures::edges(&passes, &rows, &solved.fits, period);
    let edges = rings.into_iter().map(|ring| ring.points).collect();
    Some((Program { edges, passes, rows, period, figures, distance: pace.distance }, planner.peaks()))
}

/// What of the axes is nearest to its limit, or farthest beyond.
fn busiest(peaks: &Peaks) -> String {
    let all = ["X", "Y", "C"].iter().zip(peaks).flat_map(|(axis, orders)| {
        ["speed", "acceleration", "jerk"].iter().zip(orders).map(move |(order, peak)| (axis, order, peak))
    });
    let worst = all.max_by(|a, b| (a.2.worst / a.2.limit).total_cmp(&(b.2.worst / b.2.limit)));
    worst.map_or_else(String::new, |(axis, order, peak)| {
        format!("the {order} of {axis} is {} % of its limit", fixed(100.0 * peak.worst / peak.limit, 0))
    })
}

/// Distance and speeds of the head of a job.
fn pace(job: &Job) -> Pace {
    let tool = &job.profile.tool;
    let [x, y, _] = job.profile.axes.limits();
    Pace {
        distance: tool.distance_mm,
        edge_speed: tool.edge_speed_mm_s,
        corner_speed: tool.corner_speed_mm_s,
        reach: Reach { acceleration: x.acceleration.min(y.acceleration), jerk: x.jerk.min(y.jerk) },
    }
}

/// Turns passes by whole turns so that C has the least way between them and stays in its range.
fn turn(passes: &mut [Pass], job: &Job, out: &mut Diagnostics) -> Option<()> {
    let mut last = job.profile.home[2].to_radians();
    for pass in passes {
        let aims = pass.iter().flat_map(|leg| leg.ends).map(|node| node.aim);
        let (least, most) = aims.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), aim| (a.min(aim), b.max(aim)));
        let mut turns = ((last - pass[0].ends[0].aim) / TAU).round();
        if let Some([from, to]) = job.profile.c.range() {
            let (fewest, greatest) = (((from - least) / TAU).ceil(), ((to - most) / TAU).floor());
            if fewest > greatest {
                let turn = fixed(deg(most - least), 0);
                let message =
                    format!("around an edge the head turns by {turn} degrees, for which `c.range_deg` has no room");
                let hint = "give C more range, or let it turn without end: `c.range_deg = \"unbounded\"`";
                out.push(Diagnostic::new(&code::SPRAY_RANGE, message).hint(hint));
                return None;
            }
            turns = turns.clamp(fewest, greatest);
        }
        for leg in pass.iter_mut() {
            leg.ends.iter_mut().for_each(|node| node.aim += turns * TAU);
        }
        last = pass[pass.len() - 1].ends[1].aim;
    }
    Some(())
}

/// Every pass by polynomials.
fn fitted(passes: &[Pass], pace: &Pace, tolerance: f64, job: &Job, out: &mut Diagnostics) -> Option<Solved> {
    let profile = &job.profile;
    let (limits, period) = (profile.axes.limits(), profile.time.period());
    let allowed = Allowed { distance: tolerance, turn: SHARE * profile.verify.max_heading_deg.to_radians() };
    let mut solved = Solved::default();
    let mut first = 1;
    for pass in passes {
        let stretches = stretches(pass);
        let plan = |share: f64| {
            let reach = Reach { acceleration: share * pace.reach.acceleration, jerk: share * pace.reach.jerk };
            let clock = Clock::new(pass, &Pace { reach, ..*pace }, &limits, period);
            quintic::plan(&clock, &stretches, &profile.quintic, allowed, (&limits, period))
        };
        // Polynomials ask more of the axes than the clock does: where they ask too much it goes more gently.
        let mut planned = plan(GENTLER[0]);
        for &share in &GENTLER[1..] {
            if planned.as_ref().is_ok_and(|planned| planned.keeps(&limits, period)) {
                break;
            }
            planned = plan(share).or(planned);
        }
        let Planned { mut poses, velocities, legs, fits } = match planned {
            Ok(planned) => planned,
            Err(Unfit { worst: [distance, turn] }) => {
                let message = format!(
                    "polynomials stay {} mm and {} degrees from the way of the head",
                    fixed(distance, 3),
                    fixed(deg(turn), 3)
                );
                let hint = "`quintic.basis = \"chebyshev\"`, a greater `path.tolerance_mm` or `verify.max_heading_deg`, or `tool.planner = \"optimal\"`";
                out.push(Diagnostic::new(&code::SPRAY_UNFIT, message).hint(hint));
                return None;
            }
        };
        for pose in &mut poses {
            pose.c.0 -= FRAC_PI_2;
        }
        solved.cuts.push(Cut::sampled(poses, cuts::spells(&legs, first), period));
        solved.velocities.push(velocities);
        solved.fits.push(fits);
        first += pass.len() as u32;
    }
    Some(solved)
}
