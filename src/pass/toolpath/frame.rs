//! Frame of a marker: one round along its bounding box with the knife up, which shows on the cloth where the marker will lie.

use crate::geom::{Point, Vector};
use crate::ir::Marker;
use crate::ir::toolpath::{Air, Pose, Step, Toolpath};
use crate::machine::Job;

/// Toolpath of the C axis from `home` along the box around all cuts and drills, and back; C does not turn. On a conveyor the
/// box encloses all windows, each as it lies on the table. An empty marker gives an empty toolpath.
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
