//! The speed of the conveyor: as asked, or the greatest one at which a marker can be cut; and what is said where it cannot.

use super::asked::Speed;
use super::attempt::{Missing, Work, attempt};
use super::chains::Line;
use super::program::Program;
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::ir::Marker;
use crate::ir::toolpath::Step;
use crate::machine::Job;
use crate::pass::toolpath::{Scene, trace};
use crate::units::number::{fixed, up};

/// Plans how a marker is cut while it moves; `None` where it cannot, and the diagnostics say why.
pub fn plan(marker: &Marker, speed: Speed, job: &Job, out: &mut Diagnostics) -> Option<Program> {
    let lines = lines(marker, job, out);
    if lines.is_empty() {
        out.push(Diagnostic::new(&code::FLOW_NOTHING, "the marker holds nothing that a head could cut"));
        return None;
    }
    let scene = Scene::new(marker, job);
    let front = marker.extent().max.x;
    let work = Work { lines: &lines, scene: &scene, front, job };
    let flow = &job.profile.flow;
    let tried = match speed {
        Speed::Profile => attempt(&work, flow.speed_mm_s, out).map_err(|missing| (missing, flow.speed_mm_s)),
        Speed::Of(speed) => attempt(&work, speed, out).map_err(|missing| (missing, speed)),
        Speed::Most => fastest(&work, out),
    };
    match tried {
        Ok(program) if !out.has_errors() => Some(program),
        Ok(_) => None,
        Err((missing, speed)) => {
            refuse(&work, missing, speed, out);
            None
        }
    }
}

/// The cuts of a marker; says what no head can do.
fn lines(marker: &Marker, job: &Job, out: &mut Diagnostics) -> Vec<Line> {
    let (mut lines, mut drills, mut events) = (Vec::new(), Vec::new(), 0);
    for toolpath in trace(marker, job) {
        match &toolpath.steps[..] {
            [Step::Drill(drill)] => drills.push(*drill),
            [Step::Event(_)] => events += 1,
            _ => {
                let cut = lines.len() as u32;
                lines.extend(Line::new(cut, toolpath));
            }
        }
    }
    if let Some(first) = drills.first() {
        let message = format!("{} holes are not made: no head has a drill", drills.len());
        let hint = "drill them before or behind the conveyor, as in `cutc compile` with the same file";
        out.push(Diagnostic::new(&code::FLOW_LEFT_OUT, message).on_cloth(first.at).hint(hint));
    }
    if events > 0 {
        let message = format!("{events} stops and advances of the file are not made: the conveyor does not stop");
        let hint = "take them out of the file, or do it without them";
        out.push(Diagnostic::new(&code::FLOW_LEFT_OUT, message).hint(hint));
    }
    lines
}

/// Speeds that are nearer to each other are not told apart, mm/s.
const SPEED_ACCURACY: f64 = 0.5;
/// The slowest conveyor that is looked at, mm/s.
const SLOWEST: f64 = 1.0;

/// The program at the greatest speed that is found, or what is missing at the slowest.
fn fastest(work: &Work, out: &mut Diagnostics) -> Result<Program, (Missing, f64)> {
    let flow = &work.job.profile.flow;
    let limit = flow.max_speed_mm_s.min(work.job.profile.axes.limits()[0].speed);
    let [mut slow, mut fast] = [SLOWEST.min(limit), limit];
    let mut quiet = Diagnostics::default();
    let mut best = match attempt(work, fast, &mut quiet) {
        Ok(program) => {
            out.extend(quiet);
            return Ok(program);
        }
        Err(Missing::Plan(found)) => return Err((Missing::Plan(found), fast)),
        Err(_) => None,
    };
    while fast - slow > SPEED_ACCURACY {
        let middle = f64::midpoint(slow, fast);
        let mut found = Diagnostics::default();
        match attempt(work, middle, &mut found) {
            Ok(program) => (slow, best) = (middle, Some((program, found))),
            Err(_) => fast = middle,
        }
    }
    match best {
        Some((program, found)) => {
            out.extend(found);
            Ok(program)
        }
        None => attempt(work, slow, out).map_err(|missing| (missing, slow)),
    }
}

/// Says what is missing, and what each remedy takes.
fn refuse(_work: &Work, missing: Missing, speed: f64, out: &mut Diagnostics) {
    let at = fixed(speed, 1);
    let message = match &missing {
        Missing::Axis => format!("no head can keep up with a conveyor of {at} mm/s"),
        Missing::Travel { needed, .. } => {
            format!("at {at} mm/s a chain takes {} mm of travel along the feed", up(*needed, 1))
        }
        Missing::Heads(needed) => format!("at {at} mm/s it takes {needed} heads"),
        Missing::Rows(needed) => format!("at {at} mm/s it takes {needed} rows of heads"),
        Missing::Way(more) => format!("the first row stands {} mm too near to the cloth", up(*more, 0)),
        Missing::Plan(_) => format!("at {at} mm/s a chain cannot be planned"),
    };
    let mut found = Diagnostic::new(&code::FLOW_INFEASIBLE, message);
    if let Missing::Travel { at, .. } = &missing {
        found = found.on_cloth(*at);
    }
    if let Missing::Plan(refused) = missing {
        refused.into_iter().for_each(|refused| out.push(refused));
        return;
    }
    out.push(found);
}
