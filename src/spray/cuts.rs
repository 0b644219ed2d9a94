//! Translation of passes for the cutter's planner. The head becomes a point whose C axis stands a quarter turn ahead of its
//! path, since the edge is on its left. That planner adds the travels between passes and checks every limit at the end.

use std::f64::consts::FRAC_PI_2;

use super::course::{Course, Leg};
use crate::geom::Rotation;
use crate::ir::list::Joint;
use crate::ir::motion::Spell;
use crate::ir::toolpath::{Air, Edge, End, OrientationMode, Pose, Run, Shape, Step, Toolpath};
use crate::machine::{Fit, Job, Knife};
use crate::source::Span;
use crate::units::deg;

/// The job with which the cutter's planner moves the head: no plunges, no lifts, and the quarter turn of C as a yaw.
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
    // The course is the exact path, not chords of a curve.
    job.profile.path.fit = Fit::Polygon;
    job
}

/// Pose of the axes at an end of a leg, without the yaw.
fn pose(leg: &Leg, end: usize) -> Pose {
    let node = leg.ends[end];
    Pose { centre: node.at, c: Rotation(node.aim - FRAC_PI_2) }
}

/// Fraction of the permitted direction error that the curves of the planner use.
const SHARE: f64 = 0.9;

/// Permitted deviation of the head from its course, mm. Where a line meets an arc of radius r, a curve within e mm of them may
/// differ in direction by up to sqrt(e / r).
fn tolerance(course: &Course) -> f64 {
    course.tolerance.min(course.pace.distance * (SHARE * course.pace.askew).powi(2))
}

/// The toolpath of all passes, one run per pass. Its blocks are the numbers of the legs, counted from 1 through all passes.
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

/// The run of a pass. `first` is the number of its first leg.
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

/// The spells of the legs at each tick of a pass. `first` is the number of its first leg. The last tick starts no spell.
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
