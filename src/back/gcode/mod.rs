//! Target `gcode`: arcs and lines for controllers of the kind of `LinuxCNC` that have a C axis.
//!
//! Made from paths of arcs and lines, not from the planned motion: such a controller plans for itself. C is linear along each
//! piece, so the blade lies along the tangent everywhere. The keys `gcode.*` of the profile tell how knife, drill and operator
//! are addressed; anything they do not cover is refused ([`refusal`]). The time of the controller is estimated ([`pace`]).

mod pace;
mod program;
mod refusal;

use std::io;

use self::program::Program;
use super::target::{ArcTarget, ArcWriter, Choice, Context, Emit, Estimate, Output, Proof, Target};
use crate::ir::arcs::{Interpolation, Path};
use crate::ir::toolpath::Step;
use crate::ir::{Arcs, Toolpath};
use crate::machine::gcode::Gcode;
use crate::machine::{Job, MachineProfile};
use crate::units::number::short;

pub(super) const TARGET: Target = Target {
    name: "gcode",
    about: "G-code of arcs and lines with C, for LinuxCNC and its like",
    extension: "ngc",
    emit: Emit::Arcs(ArcTarget { choices, interpolation, refusals: refusal::refusals, unfit: refusal::unfit, begin }),
    proof: Some(Proof::Positions),
};

/// Moves among which the profile leaves the choice.
fn choices(job: &Job) -> Vec<Choice> {
    let choice = |keys: Gcode| {
        let mode = keys.feed_mode.code();
        let name = if keys.arcs {
            format!("arcs in {mode}")
        } else {
            let [off, askew] = [keys.chord_mm, keys.heading_tolerance_deg].map(short);
            format!("lines in {mode} within {off} mm and {askew} degrees")
        };
        let profile = MachineProfile { gcode: keys, ..job.profile.clone() };
        Choice { name, job: Job { profile, ..job.clone() } }
    };
    job.profile.gcode.choices().into_iter().map(choice).collect()
}

/// Paths that its controller accepts.
fn interpolation(job: &Job) -> Interpolation {
    let keys = &job.profile.gcode;
    Interpolation {
        circular: keys.arcs,
        step: keys.step(),
        chord_tolerance: keys.chord_mm,
        heading_tolerance: job.profile.blade_tolerance(),
    }
}

fn begin<'a>(context: &Context<'a>) -> Box<dyn ArcWriter + 'a> {
    Box::new(Program::new(context))
}

impl ArcWriter for Program<'_> {
    fn head(&mut self, out: &mut dyn Output) -> io::Result<()> {
        self.start();
        self.drain(out)
    }

    fn body(&mut self, toolpath: &Toolpath, arcs: &Arcs, out: &mut dyn Output) -> io::Result<()> {
        write_toolpath(self, toolpath, &arcs.paths);
        self.drain(out)
    }

    fn tail(&mut self, out: &mut dyn Output) -> io::Result<Estimate> {
        let spent = self.finish();
        self.drain(out)?;
        Ok(Estimate { spent, moves: self.moves, planner: self.planned_by(), coarse: self.coarse, chosen: None })
    }
}

fn write_toolpath(program: &mut Program, toolpath: &Toolpath, paths: &[Path]) {
    let mut paths = paths.iter();
    let mut next_path = || paths.next().expect("every run and plunge cut has its path");
    for (i, step) in toolpath.steps.iter().enumerate() {
        match step {
            // The next step decides where a rapid ends.
            Step::Turn(rapid) | Step::Travel(rapid) => {
                if matches!(toolpath.steps.get(i + 1), None | Some(Step::Turn(_) | Step::Travel(_))) {
                    program.rapid(rapid.to);
                }
            }
            Step::Run(run) => {
                program.name(toolpath.piece, &run.spans);
                program.cut(next_path());
            }
            Step::PlungeCut(plunge_cut) => {
                program.name(toolpath.piece, &plunge_cut.spans);
                program.cut(next_path());
            }
            Step::Drill(drill) => {
                program.name(toolpath.piece, &[drill.span]);
                program.drill(drill);
            }
            Step::Event(event) => program.event(*event),
        }
    }
}
