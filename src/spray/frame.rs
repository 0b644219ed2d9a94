//! Frame of a course: once around its bounding box with the jet off, to show where the head will move.

use super::course::Course;
use crate::geom::{Extent, Point};
use crate::ir::toolpath::{Air, Pose, Step, Toolpath};

/// The toolpath from `home` around the bounding box of the course and back. C does not turn.
pub(super) fn toolpath(course: &Course, home: Pose) -> Toolpath {
    let places: Vec<Point> = course.passes.iter().flatten().flat_map(|leg| leg.ends).map(|node| node.at).collect();
    let Extent { min, max } = Extent::of(&places);
    let corners = [min, Point::new(max.x, min.y), max, Point::new(min.x, max.y), min, home.centre];
    let poses: Vec<Pose> = corners.iter().map(|&centre| Pose { centre, ..home }).collect();
    let moves = [home].into_iter().chain(poses.iter().copied()).zip(&poses);
    let steps = moves.filter(|(from, to)| from != *to).map(|(from, &to)| Step::Travel(Air { from, to })).collect();
    Toolpath { tolerance: course.tolerance, entry: home, steps, ..Toolpath::default() }
}
