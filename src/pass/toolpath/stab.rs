//! Pass `stab`: runs on which the blade has nowhere to go between plunge and lift become one plunge without motion.
//!
//! Needs runs with their overlaps. Leaves no run that the blade covers where it plunges: L + F + H <= w on a straight one, no
//! point of the path at the distance w from its start on a curved one. The blade is a chord of the cut, which the overlaps
//! lead on. What it is longer by, the surplus, goes into the waste: behind the start as far as there is room, then past the
//! end. What finds no room cuts into the part, never into another one that can be spared, with a warning.

use super::ToolpathPass;
use super::scene::{Around, Scene};
use super::tight::and_more;
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::geom::polyline;
use crate::geom::region::{Ray, Room};
use crate::ir::toolpath::{End, Harm, Pose, Run, Shape, Side, Stab, Step, Toolpath};
use crate::units::number::fixed;

pub(super) const PASS: ToolpathPass = ToolpathPass {
    name: "stab",
    about: "makes stabs of short runs, what the blade is longer by in the waste",
    run,
    chained: false,
};

/// A shorter surplus harms nobody, mm: rounding.
const HARM_EPSILON: f64 = 1e-6;

fn run(toolpath: &mut Toolpath, scene: &Scene, diagnostics: &mut Diagnostics) {
    let around = scene.around(toolpath);
    for step in &mut toolpath.steps {
        match step {
            Step::Run(run) if run.shape == Shape::Open => {
                if let Some(stab) = stab(run, &around) {
                    *step = Step::Stab(stab);
                }
            }
            Step::Run(_) | Step::Stab(_) | Step::Turn(_) | Step::Travel(_) | Step::Drill(_) | Step::Event(_) => {}
        }
    }
    let stabs = toolpath.steps.iter().filter_map(|step| match step {
        Step::Stab(stab) => Some(stab),
        Step::Run(_) | Step::Turn(_) | Step::Travel(_) | Step::Drill(_) | Step::Event(_) => None,
    });
    let harmful: Vec<&Stab> = stabs.filter(|stab| total(stab) > around.tolerance()).collect();
    // What cuts into another part is worse than any cut into its own.
    let worse = |a: &Stab, b: &Stab| other(b).total_cmp(&other(a)).then(total(b).total_cmp(&total(a))).is_lt();
    let worst = harmful.iter().copied().reduce(|a, b| if worse(b, a) { b } else { a });
    if let Some(worst) = worst {
        diagnostics.push(harm(worst, harmful.len(), &around));
    }
}

/// The stab that a run with its overlaps is; `None` when the blade has a way to go.
pub(super) fn stab(run: &Run, around: &Around) -> Option<Stab> {
    let width = around.knife().width_mm;
    let extended = run.extended();
    let reached = polyline::first_at_distance(&extended, width);
    // Exactly as long as the blade is a stab, too.
    if reached.is_some_and(|(point, _)| point != extended[extended.len() - 1]) || width == 0.0 {
        return None;
    }
    // A chord of the cut itself: its overlaps lie along the blade.
    let along = polyline::direction(run.points[0], run.points[run.points.len() - 1])?;
    let (first, last) = (run.points[0] - along * run.heel, run.points[run.points.len() - 1] + along * run.front);
    let surplus = (width - (last - first).norm()).max(0.0);
    let reach = surplus + around.knife().clearance_mm;
    let behind = around.room(&Ray { from: first, along: -along, reach });
    let ahead = around.room(&Ray { from: last, along, reach });
    let [start, end] = run.ends;
    let split = if start.bare && !end.bare {
        let [front, heel] = split(surplus, [ahead, behind], around);
        [heel, front]
    } else {
        split(surplus, [behind, ahead], around)
    };
    let [heel, front] = split.map(|share| share.length);
    let harm = split.map(|share| share.harm);
    let tip = last + along * front;
    Some(Stab {
        points: run.points.clone(),
        spans: run.spans.clone(),
        along,
        front: run.front + front,
        heel: run.heel + heel,
        ends: [0, 1].map(|end| {
            let harms = split[end].harm.total() > 0.0;
            End { side: if harms { Side::Part } else { run.ends[end].side }, ..run.ends[end] }
        }),
        turned: run.turned,
        edge: run.edge,
        harm,
        pose: Pose { centre: tip - along * around.knife().radius(), ..Pose::default() },
    })
}

/// What of a surplus goes beyond one end, mm, and how much of that lies in a part.
#[derive(Debug, Clone, Copy)]
struct Share {
    length: f64,
    harm: Harm,
}

/// Shares a surplus out to two ends, of which the first is preferred: to the waste; then into the part itself, alike at both
/// ends so that the greater is least; and only what is left into another part.
fn split(surplus: f64, rooms: [Room; 2], around: &Around) -> [Share; 2] {
    let clearance = around.knife().clearance_mm;
    let clear = |gap: f64| (gap - clearance).max(0.0);
    let mut lengths = [0.0; 2];
    let mut left = surplus;
    for (length, room) in lengths.iter_mut().zip(rooms) {
        *length = left.min(clear(room.least()));
        left -= *length;
    }
    if left <= HARM_EPSILON {
        lengths[0] += left;
    } else {
        // Where nothing but the part itself lies ahead it may be cut, up to the next part.
        let is_own = |room: Room| room.own < room.other;
        let spare = [0, 1].map(|i| if is_own(rooms[i]) { clear(rooms[i].other) - lengths[i] } else { 0.0 });
        let spare = spare.map(|spare| spare.max(0.0));
        let first = (left / 2.0).min(spare[0]).max(left - spare[1]).min(spare[0]);
        let second = (left - first).min(spare[1]);
        // The rest enters another part whichever end it leaves by.
        let rest = left - first - second;
        lengths = [lengths[0] + first + rest / 2.0, lengths[1] + second + rest / 2.0];
    }
    [0, 1].map(|i| Share::new(lengths[i], rooms[i]))
}

impl Share {
    fn new(length: f64, room: Room) -> Self {
        let into = |from: f64, to: f64| if to - from > HARM_EPSILON { to - from } else { 0.0 };
        Self { length, harm: Harm { own: into(room.own, length.min(room.other)), other: into(room.other, length) } }
    }
}

/// How far a stab cuts into parts beyond its ends, both together, mm.
pub(super) fn total(stab: &Stab) -> f64 {
    stab.harm.into_iter().map(Harm::total).sum()
}

/// How far into others than its own, mm.
fn other(stab: &Stab) -> f64 {
    stab.harm.into_iter().map(|harm| harm.other).sum()
}

/// Where it does, in words.
fn beyond(stab: &Stab) -> String {
    // As it is drawn.
    let ends = if stab.turned { ["past its end", "before its start"] } else { ["before its start", "past its end"] };
    let ways = stab.harm.into_iter().zip(ends);
    let ways = ways.filter(|(harm, _)| harm.total() > 0.0);
    let ways: Vec<String> = ways.map(|(harm, end)| format!("{} mm {end}", fixed(harm.total(), 2))).collect();
    let ways = ways.join(" and ");
    if other(stab) > 0.0 {
        format!("{ways}, {} mm of that into another part", fixed(other(stab), 2))
    } else {
        format!("{ways}, into its own part")
    }
}

/// The worst harm of a toolpath, and in how many places there is some.
fn harm(stab: &Stab, count: usize, around: &Around) -> Diagnostic {
    let length = fixed(polyline::length(&stab.points), 2);
    let width = fixed(around.knife().width_mm, 2);
    let more = and_more(count);
    Diagnostic::new(
        &code::PATH_OVERCUT,
        format!("the blade of {width} mm is longer than this cut of {length} mm: it cuts {}{more}", beyond(stab)),
    )
    .at(stab.spans[stab.spans.len() - 1])
    .by(stab.harm.into_iter().map(Harm::total).fold(0.0, f64::max))
    .hint("a narrower blade cuts less far")
}
