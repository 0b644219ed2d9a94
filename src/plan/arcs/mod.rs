//! Paths of few arcs and lines for controllers that plan for themselves: a polyline becomes biarcs inside its tolerance band.
//!
//! The input is the toolpath of one contour and the kinds of motion that the controller understands. The output is pieces along
//! which C turns uniformly and the blade keeps its orientation. The pieces are few, because planners crawl over many short ones
//! when a rotary axis moves. While the tip follows an arc of radius R with the C axis a distance r behind it, the axis follows
//! an arc of radius sqrt(R^2 + r^2) around the same centre. The module does not plan speeds; its speeds are caps.

mod band;
mod fade;
mod fit;
mod path;
mod pieces;
mod stroke;
mod tip;

use self::stroke::Stroke;
use crate::geom::polyline;
use crate::ir::arcs::{Arcs, Interpolation, Path, Reason, Unfit};
use crate::ir::toolpath::{OrientationMode, Step, Toolpath};
use crate::machine::Job;

/// The path of each run and plunge cut of a toolpath, in order. The error lists the runs without a path.
pub fn solve(toolpath: &Toolpath, interpolation: &Interpolation, job: &Job) -> Result<Arcs, Vec<Unfit>> {
    let (mut paths, mut unfit) = (Vec::new(), Vec::new());
    // Fixed angle between the axis and the blade, rad.
    let yaw = job.profile.knife.yaw();
    let mut strokes = stroke::of(toolpath, job).into_iter();
    for step in &toolpath.steps {
        match step {
            Step::Run(run) => {
                let stroke = strokes.next().expect("each run has a stroke");
                match path_of(&stroke, toolpath.tolerance, interpolation, job) {
                    Ok(path) => paths.push(path.turned(run.edge.turn() + yaw)),
                    Err(reason) => unfit.push(Unfit { span: run.spans[0], reason }),
                }
            }
            Step::PlungeCut(plunge_cut) => paths.push(Path::plunge(plunge_cut.pose).turned(yaw)),
            Step::Turn(_) | Step::Travel(_) | Step::Drill(_) | Step::Event(_) => {}
        }
    }
    if unfit.is_empty() { Ok(Arcs { paths }) } else { Err(unfit) }
}

fn path_of(stroke: &Stroke, tolerance: f64, interpolation: &Interpolation, job: &Job) -> Result<Path, Reason> {
    let run = stroke.run;
    // On a straight run both orientation modes are equal.
    let orientation =
        if polyline::is_straight(&run.extended(), tolerance) { OrientationMode::Tangent } else { run.orientation };
    match orientation {
        OrientationMode::Tangent => path::path(stroke, tolerance, interpolation, job).map_err(Reason::Band),
        OrientationMode::Chord => Err(Reason::Chord),
    }
}
