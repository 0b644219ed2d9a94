//! The head that follows an edge at a distance, turned towards it: a spray gun, a torch, a nozzle.
//!
//! A small pipeline of the shape of the cutter's, the listing in its order:
//!
//! ```text
//! Marker -> edge -> curve -> offset -> legs -> course -> quintic | the cutter's planner -> Program -> write -> bytes -> verify
//! ```
//!
//! *Rings* are the edges of parts, with the material on their left; their offset is the path of the head. A *course* is that
//! path in legs, each with the speed at which the jet moves along the edge as required; a *pass* is a motion from rest to rest.
//! The planner `quintic` fits polynomials to the course in time; the default one is the cutter's, with the speed of the head as
//! its feed. `verify` knows the rings as drawn and the bytes, and nothing of the planner.

mod bend;
mod clock;
mod course;
mod curve;
mod cuts;
mod edge;
mod figures;
mod frame;
mod legs;
mod offset;
mod optimal;
mod program;
mod quintic;
mod reach;
mod rows;
mod slow;
mod slower;
mod table;
mod tangle;
mod write;

pub use figures::{Edge, Piece};
pub use program::Program;
pub use rows::Row;
pub use write::{Reader, TARGETS, Target};

use std::f64::consts::TAU;

use self::course::{Course, Pace, Pass};
use self::edge::Ring;
use self::figures::Followed;
use self::quintic::Solved;
use self::rows::Moved;
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::ir::Marker;
use crate::machine::{Job, Mode, Planner};
use crate::plan::{self, Peaks};
use crate::units::deg;
use crate::units::number::fixed;

/// Share of the tolerance that the planner of a head uses; the rest is for rows in decimals and curves in legs.
const SHARE: f64 = 0.9;

/// Reports edges of a marker that a head cannot follow, with the reason; plans nothing.
pub fn check(marker: &Marker, job: &Job, out: &mut Diagnostics) {
    course(marker, job, out);
}

/// Plans the motion of a head along the edges of a marker. `None` when it is impossible; a diagnostic tells why.
pub fn plan(marker: &Marker, job: &Job, out: &mut Diagnostics) -> Option<(Program, Peaks)> {
    let (rings, course) = course(marker, job, out)?;
    match moved(rings, course, job) {
        Ok(planned) => {
            let Program { passes, rows, period, .. } = &planned.0;
            slow::report(Followed { passes, rows, period: *period }, job, out);
            Some(planned)
        }
        Err(refused) => {
            for diagnostic in refused {
                out.push(diagnostic);
            }
            None
        }
    }
}

/// A program with that of the planner `optimal` beside it, for a picture of both; alone where that is its own planner, or
/// finds no way.
pub fn beside_optimal(program: Program, marker: &Marker, job: &Job) -> Program {
    let mut other = job.clone();
    other.profile.tool.planner = Planner::Optimal;
    if job.profile.tool.planner == Planner::Optimal || job.mode == Mode::Frame {
        return program;
    }
    let planned = plan(marker, &other, &mut Diagnostics::default());
    Program { beside: planned.map(|(other, _)| Box::new(other)), ..program }
}

/// The edges of a marker and the course along them.
fn course(marker: &Marker, job: &Job, out: &mut Diagnostics) -> Option<(Vec<Ring>, Course)> {
    let pace = Pace::of(job);
    let rings = edge::rings(marker, pace.corner, out);
    tangle::report(&rings, out);
    if out.has_errors() {
        return None;
    }
    let rings = curve::drawn(rings, &job.profile.path, out);
    let ways = offset::loops(&rings, pace.distance);
    reach::report(&ways, &rings, pace.distance, out);
    let ways = ways.iter().map(|way| legs::legs(way, &rings, &pace)).filter(|legs| !legs.is_empty()).collect();
    let mut passes = course::passes(ways, &pace);
    if passes.is_empty() {
        let message = format!("no edge can be followed at {} mm", fixed(pace.distance, 1));
        out.push(Diagnostic::new(&code::SPRAY_NOTHING, message).hint("take a smaller `tool.distance_mm`"));
        return None;
    }
    turn(&mut passes, job, out)?;
    table::report(&passes, job, out)?;
    Some((rings, Course { passes, pace, tolerance: SHARE * job.profile.tolerance(marker.unit) }))
}

/// The program along a course, by the planner of the job.
fn moved(rings: Vec<Ring>, course: Course, job: &Job) -> Result<(Program, Peaks), Vec<Diagnostic>> {
    let head = cuts::job_of_head(job);
    let (toolpath, solved) = match (job.mode, job.profile.tool.planner) {
        (Mode::Frame, _) => (frame::toolpath(&course, plan::home(&head)), Solved::default()),
        (Mode::Cut | Mode::Dry, Planner::Optimal) => {
            let mut toolpath = cuts::toolpath(&course);
            let hinted =
                |refused: Diagnostic| refused.hint("try `tool.planner = \"quintic\"`, or another `path.tolerance_mm`");
            let cuts = optimal::solve(&mut toolpath, &course.passes, &head)
                .map_err(|refused| refused.into_iter().map(hinted).collect::<Vec<_>>())?;
            (toolpath, Solved { cuts, ..Solved::default() })
        }
        (Mode::Cut | Mode::Dry, Planner::Quintic) => {
            (cuts::toolpath(&course), quintic::solve(&course, job).map_err(|refused| vec![refused])?)
        }
    };
    let mut planner = plan::Planner::new(&head);
    let motions = [planner.join(&toolpath, solved.cuts), planner.finish()];
    planner.certify().map_err(|diagnostic| {
        let instead = match job.profile.tool.planner {
            Planner::Optimal => "give the axes more, or take smaller speeds of the tool",
            Planner::Quintic => "take `tool.planner = \"optimal\"`, smaller speeds of the tool, or give the axes more",
        };
        vec![diagnostic.hint(format!("{}; {instead}", busiest(&planner.peaks())))]
    })?;
    let Course { passes, pace, .. } = course;
    let rows = rows::rows(&Moved { motions: &motions, passes: &passes, velocities: &solved.velocities }, job);
    let period = job.profile.time.period();
    let figures = figures::edges(Followed { passes: &passes, rows: &rows, period }, &solved.fits);
    let edges = rings.into_iter().map(|ring| ring.points).collect();
    let program = Program { edges, passes, rows, period, figures, distance: pace.distance, beside: None };
    Ok((program, planner.peaks()))
}

/// Axis and order whose peak is nearest to its limit, or farthest beyond.
fn busiest(peaks: &Peaks) -> String {
    let all = ["X", "Y", "C"].iter().zip(peaks).flat_map(|(axis, orders)| {
        ["speed", "acceleration", "jerk"].iter().zip(orders).map(move |(order, peak)| (axis, order, peak))
    });
    let worst = all.max_by(|a, b| (a.2.worst / a.2.limit).total_cmp(&(b.2.worst / b.2.limit)));
    worst.map_or_else(String::new, |(axis, order, peak)| {
        format!("the {order} of {axis} is {} % of its limit", fixed(100.0 * peak.worst / peak.limit, 0))
    })
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
