//! The frame of a marker: once around its box with the knife up, to see on the cloth where it will lie.

use crate::geom::{Point, Vector};
use crate::ir::Marker;
use crate::ir::toolpath::{Air, Pose, Step, Toolpath};
use crate::machine::Job;

/// The C axis from `home` along the box around everything that is cut or drilled, and back; C does not turn. On a conveyor it is
/// the box around all windows, each as it lies on the table. An empty marker has no frame.
pub fn frame(marker: &Marker, home: Pose, job: &Job) -> Toolpath {
    let extent = marker.extent_on_table();
    let tolerance = job.profile.tolerance(marker.unit);
    let mut toolpath = Toolpath { piece: 0, part: 0, tolerance, entry: home, steps: Vec::new() };
    if extent.is_empty() {
        return toolpath;
    }
    let moved_on = Vector::new(f64::from(marker.moved_on), 0.0);
    let (min, max) = (extent.min + moved_on, extent.max + moved_on);
    let corners = [min, Point::new(max.x, min.y), max, Point::new(min.x, max.y), min, home.centre];
    let mut from = home;
    for corner in corners {
        let to = Pose { centre: corner, c: home.c };
        if to != from {
            toolpath.steps.push(Step::Travel(Air { from, to }));
            from = to;
        }
    }
    toolpath
}
