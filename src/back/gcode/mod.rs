//! Target `gcode`: arcs and lines for controllers of the kind of `LinuxCNC` that have a C axis.
//!
//! From the toolpath, not from the planned motion: such a controller plans for itself. Runs become few arcs and lines
//! inside the tube ([`fit`]), because planners crawl over many short ones where a rotary axis moves. C is linear along
//! each piece, so that the blade lies along the tangent everywhere; with the C axis behind the tip by r the centre goes
//! on an arc of radius sqrt(R^2 + r^2) around the same centre ([`way`]). How knife, drill and operator are told stands
//! under `gcode.` in the profile. How long the controller takes is estimated ([`pace`]).

mod fade;
mod fit;
mod pace;
mod program;
mod tube;
mod way;

use std::io;

use self::program::Program;
pub(in crate::back) use self::way::Way;
use super::{Context, Emit, Estimate, Fit, Fitting, Output, Proof, Target, Ways};
use crate::diagnostic::{Diagnostic, code};
use crate::geom::polyline;
use crate::ir::Toolpath;
use crate::ir::toolpath::{Drill, Event, Law, Run, Step};
use crate::machine::{Job, gcode};
use crate::units::number::fixed;

pub(super) const TARGET: Target = Target {
    name: "gcode",
    about: "G-code of arcs and lines with C, for LinuxCNC and its like",
    extension: "ngc",
    emit: Emit::Fit(Fit { ways, begin }),
    proof: Proof::Positions,
};

/// Decimals of places in messages.
const PLACE_DECIMALS: u32 = 3;
/// The drill of a profile whose steps have no place for a number.
const ONLY_DRILL: u8 = 1;

/// The way of each run and stab of a toolpath, in order.
fn ways(toolpath: &Toolpath, job: &Job) -> Result<Ways, Vec<Diagnostic>> {
    let (mut ways, mut refused) = (Vec::new(), Vec::new());
    // The axis stands askew to the blade by that.
    let yaw = job.profile.knife.yaw();
    for step in &toolpath.steps {
        match step {
            Step::Run(run) => match way_of(run, toolpath.tolerance, job) {
                Ok(way) => ways.push(way.turned(run.edge.turn() + yaw)),
                Err(diagnostic) => refused.push(diagnostic),
            },
            Step::Stab(stab) => ways.push(Way::rest(stab.pose).turned(yaw)),
            Step::Drill(drill) => refused.extend(unsaid_drill(drill, job)),
            Step::Event(event) => refused.extend(unsaid_event(*event, job)),
            Step::Turn(_) | Step::Travel(_) => {}
        }
    }
    if refused.is_empty() { Ok(Ways(ways)) } else { Err(refused) }
}

/// Why a hole cannot be told with the steps of the profile.
fn unsaid_drill(drill: &Drill, job: &Job) -> Option<Diagnostic> {
    let keys = &job.profile.gcode;
    let refused = |message: String, hint: &str| {
        Some(Diagnostic::new(&code::TARGET_REFUSED, message).at(drill.span).hint(hint)).filter(|_| job.mode.cuts())
    };
    for (key, steps) in [("gcode.drill_down", &keys.drill_down), ("gcode.drill_up", &keys.drill_up)] {
        if steps.is_empty() {
            return refused(
                format!("`{key}` has no step, but the file drills"),
                "give its steps, such as [\"M64 P#\"]",
            );
        }
    }
    let tool = drill.tool;
    if tool != ONLY_DRILL && !keys.drill_down.iter().any(gcode::Step::names_drill) {
        let message = format!("`gcode.drill_down` tells no drills apart, but the file asks for drill {tool}");
        return refused(message, "put # where the number of the drill belongs, as in M64 P#");
    }
    None
}

/// Why something cannot be asked for with the steps of the profile.
fn unsaid_event(event: Event, job: &Job) -> Option<Diagnostic> {
    let keys = &job.profile.gcode;
    let (key, steps, asks, hint) = match event {
        Event::Stop => ("gcode.stop", &keys.stop, "stops for the operator", "give its steps, such as [\"M0\"]"),
        Event::Advance => ("gcode.advance", &keys.advance, "advances the cloth", "give its steps, such as [\"M1\"]"),
    };
    let message = || format!("`{key}` has no step, but the file {asks}");
    steps.is_empty().then(|| Diagnostic::new(&code::TARGET_REFUSED, message()).hint(hint))
}

fn way_of(run: &Run, tolerance: f64, job: &Job) -> Result<Way, Diagnostic> {
    let refused = |message: &str| Diagnostic::new(&code::TARGET_REFUSED, message).at(run.spans[0]);
    // On a straight run the laws are one.
    let law = if polyline::is_straight(&run.extended(), tolerance) { Law::Tangent } else { run.law };
    match law {
        Law::Tangent => way::way(run, tolerance, job).map_err(|at| {
            let (x, y) = (fixed(at.x, PLACE_DECIMALS), fixed(at.y, PLACE_DECIMALS));
            refused("no arc or line stays within the tolerance")
                .hint(format!("the place is X {x} Y {y} mm"))
                .hint("a larger path.tolerance_mm or a smaller corner.angle_deg helps; the target csv needs no arcs")
        }),
        Law::Chord => {
            Err(refused("the target gcode lays the blade along the tangent of curves only, not as a chord of them")
                .hint("set `knife.follow = \"tangent\"`, or take a target with setpoints, such as csv"))
        }
    }
}

fn begin<'a>(context: &Context<'a>) -> Box<dyn Fitting + 'a> {
    Box::new(Program::new(context))
}

impl Fitting for Program<'_> {
    fn head(&mut self, out: &mut dyn Output) -> io::Result<()> {
        self.start();
        self.drain(out)
    }

    fn body(&mut self, toolpath: &Toolpath, Ways(ways): &Ways, out: &mut dyn Output) -> io::Result<()> {
        write_toolpath(self, toolpath, ways);
        self.drain(out)
    }

    fn tail(&mut self, out: &mut dyn Output) -> io::Result<Estimate> {
        let time = self.finish();
        self.drain(out)?;
        Ok(Estimate { time, moves: self.moves })
    }
}

fn write_toolpath(program: &mut Program, toolpath: &Toolpath, ways: &[Way]) {
    let mut ways = ways.iter();
    let mut next_way = || ways.next().expect("every run and stab has its way");
    for (i, step) in toolpath.steps.iter().enumerate() {
        match step {
            // What follows decides where a move in the air ends.
            Step::Turn(air) | Step::Travel(air) => {
                if matches!(toolpath.steps.get(i + 1), None | Some(Step::Turn(_) | Step::Travel(_))) {
                    program.rapid(air.to);
                }
            }
            Step::Run(run) => {
                program.name(toolpath.piece, &run.spans);
                program.cut(next_way());
            }
            Step::Stab(stab) => {
                program.name(toolpath.piece, &stab.spans);
                program.cut(next_way());
            }
            Step::Drill(drill) => {
                program.name(toolpath.piece, &[drill.span]);
                program.drill(drill);
            }
            Step::Event(event) => program.event(*event),
        }
    }
}
