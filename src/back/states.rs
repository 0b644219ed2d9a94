//! Target `states`: the blade at the ends of each segment, a row a state.
//!
//! The scheme of Wang, Zhang & Zhao, *Research on Cutter Knife Tangent Following and Compensating Algorithm*, 2013,
//! doi 10.7690/bgzdh.2013.02.026: tip, tail and centre of the blade, its angle, and the increments of the three axes since the
//! state before. A cut has a row for its plunge and one for the end of each of its segments, with the overlaps at its ends; a
//! plunge cut and a hole have one row. Moves through the air have none: their increments are those of the next row. The first
//! increments count from `home`.
//!
//! These are the states before smoothing, as the drawing and the overlaps give them. Angles are in [0, 360); increments of C are
//! those of the axis, which may turn more than once.

use std::io;

use super::target::{Context, Emit, Outcome, Output, Parts, Target};
use crate::diagnostic::{Diagnostic, code};
use crate::geom::{Heading, Point, Vector, polyline};
use crate::ir::Toolpath;
use crate::ir::toolpath::{OrientationMode, Pose, Run, Shape, Step};
use crate::machine::Knife;
use crate::units::{deg, number};

pub(super) const TARGET: Target = Target {
    name: "states",
    about: "tip, tail and centre of the blade at each end of a segment, a row a state",
    extension: "states",
    emit: Emit::Toolpath(Parts { refusals, head, body, tail }),
    proof: None,
};

/// Decimals of positions and angles, in mm and degrees.
const DECIMALS: u32 = 6;
/// Least angle that prints as a whole turn, degrees.
const WHOLE_TURN: f64 = 360.0 - 5e-7;

/// A row of the table.
struct State {
    kind: &'static str,
    block: u32,
    /// Ends of the segment.
    segment: [Point; 2],
    pose: Pose,
}

/// A conveyor moves the cloth between states.
fn refusals(context: &Context) -> Vec<Diagnostic> {
    if !context.has_bites() {
        return Vec::new();
    }
    let message = "`states` gives places on cloth that lies still, and a conveyor advances it (`bite.length_mm`)";
    vec![Diagnostic::new(&code::TARGET_REFUSED, message).hint("`-t json` has the advance at each step")]
}

fn head(_: &Context, out: &mut dyn Output) -> io::Result<()> {
    writeln!(
        out,
        "state,block,from_x_mm,from_y_mm,to_x_mm,to_y_mm,tip_x_mm,tip_y_mm,tail_x_mm,tail_y_mm,x_mm,y_mm,c_deg,dx_mm,dy_mm,\
         dc_deg"
    )
}

fn body(toolpath: &Toolpath, context: &Context, out: &mut dyn Output) -> io::Result<()> {
    let knife = &context.job.profile.knife;
    let mut before = toolpath.entry;
    let mut rows = Vec::new();
    for step in &toolpath.steps {
        let states = match step {
            Step::Run(run) => of_run(run, knife),
            Step::PlungeCut(cut) => {
                let segment = [cut.points[0], cut.points[cut.points.len() - 1]];
                vec![State { kind: "plunge-cut", block: cut.spans[0].block, segment, pose: cut.pose }]
            }
            Step::Drill(drill) => {
                let pose = Pose { centre: drill.at - Vector::from(context.job.profile.drill.offset_mm), c: before.c };
                vec![State { kind: "drill", block: drill.span.block, segment: [drill.at; 2], pose }]
            }
            Step::Turn(_) | Step::Travel(_) | Step::Event(_) => Vec::new(),
        };
        for state in states {
            state.push(before, knife, &mut rows);
            before = state.pose;
        }
    }
    out.write_all(&rows)
}

#[allow(clippy::unnecessary_wraps, reason = "the signature is that of every target")]
fn tail(_: &Context, _: Outcome, _: &mut dyn Output) -> io::Result<()> {
    Ok(())
}

/// States of a run: at its plunge, and at the end of each segment.
fn of_run(run: &Run, knife: &Knife) -> Vec<State> {
    let segments = run.points.windows(2).zip(&run.spans).map(|(ends, span)| ([ends[0], ends[1]], span.block));
    let (first, block) = ([run.points[0], run.points[1]], run.spans[0].block);
    let mut states = vec![State { kind: "plunge", block, segment: first, pose: run.start }];
    let mut c = run.start.c;
    for (i, (segment, block)) in segments.enumerate() {
        let (kind, pose) = if i + 2 == run.points.len() {
            ("lift", run.end)
        } else {
            let heading = heading(run, i, knife);
            c = c.nearest(Heading::new(heading.radians() + run.edge.turn()));
            ("end", Pose { centre: segment[1] - heading.unit() * run.edge.lead(knife.ends()), c })
        };
        states.push(State { kind, block, segment, pose });
    }
    states
}

/// Heading of the blade with its leading end at the end of a segment: along the segment, or along the chord of the path that is
/// as long as the blade. Until the path is as long, the blade is as it plunged.
fn heading(run: &Run, segment: usize, knife: &Knife) -> Heading {
    let [from, to] = [run.points[segment], run.points[segment + 1]];
    if run.orientation == OrientationMode::Tangent {
        return Heading::of(to - from);
    }
    let extended = if run.shape == Shape::Open { run.extended_by([run.heel, 0.0]) } else { run.points.clone() };
    let count = extended.len() - run.points.len() + segment + 2;
    let back: Vec<Point> = extended[..count].iter().rev().copied().collect();
    match polyline::first_at_distance(&back, knife.width_mm) {
        Some((tail, _)) => Heading::of(to - tail),
        None => Heading::new(run.start.c.0 - run.edge.turn()),
    }
}

impl State {
    /// Appends the row of the state, with the increments since another pose.
    fn push(&self, before: Pose, knife: &Knife, rows: &mut Vec<u8>) {
        let Self { kind, block, segment: [from, to], pose } = self;
        let [tip, tail] = [knife.radius(), -knife.back()].map(|reach| pose.ahead(reach));
        let angle = deg(pose.c.0).rem_euclid(360.0);
        let moved = pose.centre - before.centre;
        rows.extend_from_slice(kind.as_bytes());
        rows.push(b',');
        number::push_integer(rows, u64::from(*block));
        for at in [from, to, &tip, &tail, &pose.centre] {
            push(at.x, rows);
            push(at.y, rows);
        }
        for value in [if angle < WHOLE_TURN { angle } else { 0.0 }, moved.x, moved.y, deg(pose.c.0 - before.c.0)] {
            push(value, rows);
        }
        rows.push(b'\n');
    }
}

fn push(value: f64, rows: &mut Vec<u8>) {
    rows.push(b',');
    number::push_fixed(rows, value, DECIMALS);
}
