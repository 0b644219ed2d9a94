//! Passes as the cutter's planner takes them: the head is a point whose C axis stands a quarter turn ahead of its way, since
//! the edge is on its left. Travels between passes, and the last check of every limit, are that planner's.

use std::f64::consts::FRAC_PI_2;

use super::course::{Course, Leg};
use crate::geom::Rotation;
use crate::ir::list::Joint;
use crate::ir::motion::Spell;
use crate::ir::toolpath::{Air, Edge, End, OrientationMode, Pose, Run, Shape, Step, Toolpath};
use crate::machine::{Fit, Job, Knife};
use crate::source::Span;
use crate::units::deg;

/// The job by which the cutter's planner moves the head: no plunges, no lifts, the quarter turn of C as a yaw.
pub(super) fn job_of_head(job: &Job) -> Job {
    let mut job = job.clone();
    let knife = &mut job.profile.knife;
    *knife = Knife {
        feed_mm_s: None,
        plunge_ms: 0.0,
        lift_ms: 0.0,
        clear_ms: None,
        max_down_mm: None,
        yaw_deg: deg(FRAC_PI_2),
        ..knife.clone()
    };
    // The course is the line itself, not chords of one.
    job.profile.path.fit = Fit::Polygon;
    job
}

/// The pose of the axes at a node of the course, without the yaw.
fn pose(leg: &Leg, end: usize) -> Pose {
    let node = leg.ends[end];
    Pose { centre: node.at, c: Rotation(node.aim - FRAC_PI_2) }
}

/// Share of what a head may look askew that the curves of its planner use.
const SHARE: f64 = 0.9;

/// How near to its course the head stays, mm: where a line meets an arc of a radius a curve that leaves them by so much is
/// turned by up to the root of its share of the radius.
fn tolerance(course: &Course) -> f64 {
    course.tolerance.min(course.pace.distance * (SHARE * course.pace.askew).powi(2))
}

/// All passes, a run each. Its blocks are numbers of legs, the first being 1, counted through all passes.
pub(super) fn toolpath(course: &Course) -> Toolpath {
    let mut toolpath = Toolpath { tolerance: tolerance(course), ..Toolpath::default() };
    let mut first = 1;
    let mut at = Pose::default();
    for pass in &course.passes {
        let start = pose(&pass[0], 0);
        toolpath.steps.push(Step::Travel(Air { from: at, to: start }));
        toolpath.steps.push(Step::Run(run(pass, first)));
        at = pose(&pass[pass.len() - 1], 1);
        first += pass.len() as u32;
    }
    toolpath
}

/// A pass as a run, whose first leg has that number.
fn run(pass: &[Leg], first: u32) -> Run {
    let mut points = vec![pass[0].ends[0].at];
    points.extend(pass.iter().map(|leg| leg.ends[1].at));
    let spans = (first..).take(pass.len()).map(|block| Span { block, ..Span::default() }).collect();
    Run {
        joints: vec![Joint::default(); points.len()],
        points,
        spans,
        shape: Shape::Open,
        orientation: OrientationMode::Tangent,
        front: 0.0,
        heel: 0.0,
        feeds: pass.iter().map(|leg| leg.speed).collect(),
        junctions: Vec::new(),
        ends: [End::default(); 2],
        turned: false,
        edge: Edge::Front,
        start: pose(&pass[0], 0),
        end: pose(&pass[pass.len() - 1], 1),
    }
}

/// The spells of legs at each tick of a pass whose first leg has that number; the last tick begins nothing.
pub(super) fn spells(legs: &[usize], first: u32) -> Vec<Spell> {
    let mut spells: Vec<Spell> = Vec::new();
    for (tick, &leg) in (0..).zip(&legs[..legs.len() - 1]) {
        let block = first + leg as u32;
        if spells.last().is_none_or(|spell| spell.block != block) {
            spells.push(Spell { first: tick, block });
        }
    }
    spells
}
