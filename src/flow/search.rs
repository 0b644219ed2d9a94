//! Search for the speed of the conveyor: the requested one, or the greatest one at which a marker can be cut. Explains why if
//! there is none.

use super::asked::Speed;
use super::attempt::{Missing, Work, attempt};
use super::chains::Line;
use super::program::Program;
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::ir::Marker;
use crate::ir::toolpath::Step;
use crate::machine::Job;
use crate::pass::toolpath::{Scene, trace};
use crate::units::number::{counted, fixed, up};

/// Plans how a marker is cut while it moves. `None` if it cannot be cut; the diagnostics tell why.
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
        Speed::Of(speed) if speed > flow.max_speed_mm_s => {
            let [asked, most] = [speed, flow.max_speed_mm_s].map(|speed| fixed(speed, 1));
            let message = format!("the conveyor runs at {most} mm/s at the most, and {asked} are asked for");
            let hint = "`--speed max` finds the greatest speed; the conveyor's own is `flow.max_speed_mm_s`";
            out.push(Diagnostic::new(&code::FLOW_INFEASIBLE, message).hint(hint));
            return None;
        }
        Speed::Of(speed) => attempt(&work, speed, out).map_err(|missing| (missing, speed)),
        Speed::Most => fastest(&work, out),
    };
    match tried {
        Ok(program) if !out.has_errors() => Some(program),
        Ok(_) => None,
        Err((missing, speed)) => {
            refuse(&work, &missing, speed, out);
            None
        }
    }
}

/// The cuts of a marker. Reports the drills and events that heads cannot make.
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
        let message = format!("no head has a drill: {} left out", counted(drills.len(), "hole"));
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

/// Accuracies of a speed search, mm/s: for a requested maximum, and for a speed that is only mentioned.
const SPEED_ACCURACY: f64 = 0.5;
const MENTIONED_ACCURACY: f64 = 4.0;
/// Lowest speed of the conveyor to try, mm/s.
const SLOWEST: f64 = 1.0;

/// Highest speed to try, mm/s.
fn limit(work: &Work) -> f64 {
    let profile = &work.job.profile;
    profile.flow.max_speed_mm_s.min(profile.axes.limits()[0].speed)
}

/// The program at the greatest speed found. Otherwise the reason why the lowest speed fails.
fn fastest(work: &Work, out: &mut Diagnostics) -> Result<Program, (Missing, f64)> {
    let mut found = Diagnostics::default();
    let best = match tried(work, limit(work), &mut found) {
        Some(program) => Some((program, found)),
        None => below(work, limit(work), SPEED_ACCURACY),
    };
    match best {
        Some((program, found)) => {
            out.extend(found);
            Ok(program)
        }
        None => attempt(work, SLOWEST, out).map_err(|missing| (missing, SLOWEST)),
    }
}

/// The program at the greatest speed found below `speed`, to an accuracy, mm/s; `None` if even the lowest speed fails.
fn below(work: &Work, speed: f64, accuracy: f64) -> Option<(Program, Diagnostics)> {
    let [mut slow, mut fast] = [SLOWEST, speed];
    let mut best = None;
    while fast - slow > accuracy {
        let middle = f64::midpoint(slow, fast);
        let mut found = Diagnostics::default();
        match tried(work, middle, &mut found) {
            Some(program) => (slow, best) = (middle, Some((program, found))),
            None => fast = middle,
        }
    }
    best.or_else(|| {
        let mut found = Diagnostics::default();
        let program = (speed > SLOWEST).then(|| attempt(work, SLOWEST, &mut found).ok())??;
        Some((program, found))
    })
}

/// The program at a speed, if it can be planned. Speeds that the closed form rules out are not tried.
fn tried(work: &Work, speed: f64, out: &mut Diagnostics) -> Option<Program> {
    if work.is_hopeless(speed) { None } else { attempt(work, speed, out).ok() }
}

/// Reports why a marker cannot be cut, with the remedies and their cost.
fn refuse(work: &Work, missing: &Missing, speed: f64, out: &mut Diagnostics) {
    let flow = &work.job.profile.flow;
    let shown = fixed(speed, 1);
    let (message, place) = match missing {
        Missing::Plan(refused) => {
            for refused in refused {
                out.push(refused.clone());
            }
            return;
        }
        Missing::Way(more) => {
            let message = format!("the first row stands {} mm too near to the cloth", up(*more, 0));
            let hint = format!("`flow.first_row_mm` = {}", up(flow.first_row_mm + more, 0));
            out.push(Diagnostic::new(&code::FLOW_INFEASIBLE, message).hint(hint));
            return;
        }
        Missing::Axis => (format!("no head can keep up with a conveyor of {shown} mm/s along the feed"), None),
        Missing::Travel { needed, at } => {
            let has = fixed(flow.travel_mm, 1);
            let needed = up(*needed, 1);
            (
                format!("at {shown} mm/s a chain takes {needed} mm of travel along the feed, and heads have {has} mm"),
                Some(*at),
            )
        }
        Missing::Machine { heads, rows } => {
            let message = format!(
                "at {shown} mm/s it takes {}, and the machine has {} in {}",
                told([*heads, *rows]),
                flow.heads,
                flow.rows
            );
            (message, None)
        }
    };
    let mut found = Diagnostic::new(&code::FLOW_INFEASIBLE, message);
    if let Some(at) = place {
        found = found.on_cloth(at);
    }
    for hint in hints(work, missing, speed) {
        found = found.hint(hint);
    }
    out.push(found);
}

/// Travels to try, as multiples of the travel of the machine.
const TRAVELS: [f64; 3] = [1.5, 2.0, 3.0];

/// Remedies: a longer travel, more heads, a slower conveyor.
fn hints(work: &Work, missing: &Missing, speed: f64) -> Vec<String> {
    let mut hints = Vec::new();
    match missing {
        Missing::Travel { needed, .. } => {
            let travel = needed.ceil();
            let key = travel_key(work, travel);
            hints.push(with_travel(work, travel, speed).map_or_else(
                || format!("a longer travel: {key}"),
                |needed| format!("a longer travel: {key} does, with {}", told(needed)),
            ));
        }
        &Missing::Machine { heads, rows } => {
            let flow = &work.job.profile.flow;
            let keys = [("flow.heads", heads, flow.heads), ("flow.rows", rows, flow.rows)];
            let more = keys.iter().filter(|(_, needed, has)| *needed > *has as usize);
            let more: Vec<String> = more.map(|(key, needed, _)| format!("`{key}` = {needed}")).collect();
            hints.push(format!("a larger machine: {}", more.join(" and ")));
            let longer = TRAVELS.iter().map(|part| (part * flow.travel_mm).ceil());
            let fits = |&[heads, rows]: &[usize; 2]| heads <= flow.heads as usize && rows <= flow.rows as usize;
            let found = longer
                .filter_map(|travel| Some((travel, with_travel(work, travel, speed)?)))
                .find(|(_, machine)| fits(machine));
            hints.extend(found.map(|(travel, machine)| {
                format!("a longer travel: with {} it takes {}", travel_key(work, travel), told(machine))
            }));
        }
        Missing::Axis | Missing::Way(_) | Missing::Plan(_) => {}
    }
    hints.push(match below(work, speed.min(limit(work)), MENTIONED_ACCURACY) {
        Some((program, _)) => {
            format!("a slower conveyor: {} mm/s, for one, can be cut on this machine", fixed(program.speed, 1))
        }
        None => "no slower conveyor would do".to_owned(),
    });
    hints
}

/// The profile keys of a travel, mm. The pitch of the rows must not be shorter than the travel.
fn travel_key(work: &Work, travel: f64) -> String {
    let flow = &work.job.profile.flow;
    let pitch = if flow.rows > 1 && flow.row_pitch_mm < travel {
        format!(" and `flow.row_pitch_mm` = {travel}")
    } else {
        String::new()
    };
    format!("`flow.travel_mm` = {travel}{pitch}")
}

/// Numbers of heads and rows in words.
fn told([heads, rows]: [usize; 2]) -> String {
    format!("{} in {}", counted(heads, "head"), counted(rows, "row"))
}

/// Numbers of heads and rows needed with another travel along the feed; `None` if it is still too short.
fn with_travel(work: &Work, travel: f64, speed: f64) -> Option<[usize; 2]> {
    let mut job = work.job.clone();
    let flow = &mut job.profile.flow;
    (flow.travel_mm, flow.row_pitch_mm) = (travel, flow.row_pitch_mm.max(travel));
    match attempt(&Work { job: &job, ..*work }, speed, &mut Diagnostics::default()) {
        Ok(program) => Some([program.figures.heads, program.figures.rows]),
        Err(Missing::Machine { heads, rows }) => Some([heads, rows]),
        Err(Missing::Axis | Missing::Travel { .. } | Missing::Way(_) | Missing::Plan(_)) => None,
    }
}
