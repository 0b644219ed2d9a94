//! Target `json`: the program step by step, for a script or a time study.
//!
//! `runs` has one object a line for each action of the machine, in order: `kind` is "cut" (plunge, motion, lift), "stab"
//! (plunge and lift without motion), "travel", "turn", "drill", "event", or "wait" when the blade still rises at the very end.
//! Every run has every key; a key that does not apply is 0, and block 0 is no block. Lengths and poses have the decimals of
//! `csv`.
//!
//! `front_side` and `heel_side` tell where the overlaps go: into the "waste", into the "part" itself, into a "gap" that is
//! narrower than the overlap should be long, or along the "contour" where the knife is lifted amid it. `turned` is true if a
//! cut goes in the reverse direction of the file. `front_overcut_mm` and `heel_overcut_mm` are the depths to which the excess
//! length of a plunge cut reaches into parts. `neighbour_overcut_mm` is the greatest part of either that is in another part
//! than its own.
//!
//! On a conveyor `advance_mm` is the advance of the cloth so far: poses are those over the table.
//!
//! There are two clocks. `duration_s` is the time of the axes from rest to rest, not rounded; `dwell_s` is their rest for
//! plunge and lift, or a drill; all of both add up to the program's `time_s`. A controller has whole periods only, so each
//! motion and each rest is stretched to a whole number of periods, at least one: `ticks` is the number for a run, and all of
//! them add up to the program's `ticks` and, times the period, to `setpoints_s`, the time of the last setpoint.
//!
//! Runs are written as they come; `program`, the totals with profile and knife, stands behind them.

use std::io;

use super::target::{Context, Emit, Outcome, Output, Parts, Target, nothing};
use crate::ir::Motion;
use crate::ir::motion::{Kind, Phase, Task};
use crate::ir::toolpath::{Edge, OrientationMode, Pose, Side};
use crate::units::deg;
use crate::units::number::{exact, fixed};

pub(super) const TARGET: Target = Target {
    name: "json",
    about: "the program step by step: cuts, stabs, travels, turns with their times",
    extension: "json",
    emit: Emit::Motion(Parts { refusals: nothing, head, body, tail }),
    proof: None,
};

/// Decimals of positions and lengths, in mm and degrees.
const DECIMALS: u32 = 6;

/// Action of the machine between two rests.
struct Run {
    kind: &'static str,
    task: Task,
    length: f64,
    duration: f64,
    dwell: f64,
    ticks: u64,
    start: Pose,
    end: Pose,
    /// Advance of the cloth so far, mm; `None` where it lies still.
    advance: Option<u32>,
}

fn head(_: &Context, out: &mut dyn Output) -> io::Result<()> {
    out.write_all(b"{\"runs\": [")
}

fn body(motion: &Motion, context: &Context, out: &mut dyn Output) -> io::Result<()> {
    let mut text = String::new();
    let mut tasks = motion.tasks.iter().copied();
    let mut index = motion.first_step;
    let mut rest = &motion.phases[..];
    while let Some(first) = rest.first() {
        if first.kind == Kind::Rest {
            text.push_str(&program(motion, index, context));
            break;
        }
        let is_wait = |phase: &&Phase| phase.kind == Kind::Wait;
        let goes_on =
            |phase: &&Phase| !phase.kind.begins_step() && phase.kind != Kind::Rest && phase.kind != Kind::Wait;
        let lead = rest.iter().take_while(is_wait).count();
        let begins = usize::from(rest.get(lead).is_some_and(|phase| phase.kind != Kind::Rest));
        let more = rest[lead + begins..].iter().take_while(goes_on).count();
        let (phases, next) = rest.split_at(lead + begins + more);
        text.push_str(if index == 0 { "\n" } else { ",\n" });
        let advance = context.has_bites().then(|| phases[phases.len() - 1].station);
        text.push_str(&object(&Run { advance, ..run(phases, next.first(), &mut tasks) }, index, motion.piece));
        index += 1;
        rest = next;
    }
    out.write_all(text.as_bytes())
}

fn tail(_: &Context, _: Outcome, out: &mut dyn Output) -> io::Result<()> {
    out.write_all(b"}\n")
}

/// One run from its phases; the `next` phase begins where the axes of a motion come to rest.
fn run(phases: &[Phase], next: Option<&Phase>, tasks: &mut impl Iterator<Item = Task>) -> Run {
    let mut run = Run {
        kind: "wait",
        task: Task::default(),
        length: 0.0,
        duration: 0.0,
        dwell: 0.0,
        ticks: 0,
        start: phases[0].pose(0),
        end: next.unwrap_or(&phases[phases.len() - 1]).pose(0),
        advance: None,
    };
    for phase in phases {
        run.ticks += u64::from(phase.ticks);
        run.length += phase.length;
        match phase.kind {
            Kind::Travel | Kind::Turn | Kind::Cut => run.duration += phase.duration,
            Kind::Plunge | Kind::Lift | Kind::Drill(_) | Kind::Event(_) | Kind::Wait | Kind::Rest => {
                run.dwell += phase.duration;
            }
        }
        match phase.kind {
            Kind::Travel => run.kind = "travel",
            Kind::Turn => run.kind = "turn",
            Kind::Event(_) => run.kind = "event",
            Kind::Cut => run.kind = "cut",
            Kind::Plunge => (run.kind, run.task) = ("stab", tasks.next().unwrap_or_default()),
            Kind::Drill(_) => (run.kind, run.task) = ("drill", tasks.next().unwrap_or_default()),
            // The axes rest until the knife is up.
            Kind::Lift => run.end = phase.pose(0),
            Kind::Wait | Kind::Rest => {}
        }
    }
    run
}

/// A run as an object on a line.
fn object(run: &Run, index: u64, piece: u32) -> String {
    let mm = |value| fixed(value, DECIMALS);
    let pose = |pose: Pose| {
        let [x, y, c] = [pose.centre.x, pose.centre.y, deg(pose.c.0)].map(mm);
        format!("{{\"x_mm\": {x}, \"y_mm\": {y}, \"c_deg\": {c}}}")
    };
    let Task { blocks: [first, last], front, heel, sides: [start, end], turned, edge, overcut, orientation } = run.task;
    format!(
        "{{\"index\": {index}, \"kind\": \"{}\", \"piece\": {piece}, \"block_first\": {first}, \"block_last\": {last}, \
         \"length_mm\": {}, \"duration_s\": {}, \"dwell_s\": {}, \"ticks\": {}, \"start\": {}, \"end\": {}, \
         \"front_overlap_mm\": {}, \"heel_overlap_mm\": {}, \"front_side\": \"{}\", \"heel_side\": \"{}\", \
         \"turned\": {turned}, \"edge\": \"{}\", \"front_overcut_mm\": {}, \"heel_overcut_mm\": {}, \
         \"neighbour_overcut_mm\": {}, \"follow\": {}{}}}",
        run.kind,
        mm(run.length),
        exact(run.duration),
        exact(run.dwell),
        run.ticks,
        pose(run.start),
        pose(run.end),
        mm(front),
        mm(heel),
        side(end),
        side(start),
        edge_name(edge),
        mm(overcut[1].deepest()),
        mm(overcut[0].deepest()),
        mm(overcut[0].other.max(overcut[1].other)),
        follow(orientation),
        run.advance.map_or_else(String::new, |mm| format!(", \"advance_mm\": {mm}")),
    )
}

/// Name of the edge that leads.
fn edge_name(edge: Edge) -> &'static str {
    match edge {
        Edge::Front => "front",
        Edge::Back => "back",
    }
}

fn follow(orientation: Option<OrientationMode>) -> &'static str {
    match orientation {
        None => "null",
        Some(OrientationMode::Tangent) => "\"tangent\"",
        Some(OrientationMode::Chord) => "\"chord\"",
    }
}

/// Word for the side that an overlap goes to.
fn side(side: Side) -> &'static str {
    match side {
        Side::Waste => "waste",
        Side::Part => "part",
        Side::Gap => "gap",
        Side::Contour => "contour",
    }
}

/// The end of the runs and the object that sums them up.
fn program(last: &Motion, runs: u64, context: &Context) -> String {
    let period = context.job.profile.time.period();
    let moving = last.phases.iter().filter(|phase| phase.kind != Kind::Rest);
    let ticks = last.first_tick + moving.clone().map(|phase| u64::from(phase.ticks)).sum::<u64>();
    let knife = &context.job.profile.knife;
    let time = moving.fold(last.first_time, |sum, phase| sum + phase.duration);
    format!(
        "\n],\n\"program\": {{\"profile\": {}, \"knife_width_mm\": {}, \"knife_radius_mm\": {}, \"runs\": {runs}, \"pieces\": {}, \"time_s\": {}, \"period_s\": {}, \"ticks\": {ticks}, \
         \"setpoints_s\": {}}}",
        serde_json::Value::from(context.job.origin.name()),
        exact(knife.width_mm),
        fixed(knife.radius(), DECIMALS),
        context.marker.piece_count(),
        exact(time),
        exact(period),
        fixed(ticks as f64 * period, DECIMALS),
    )
}
