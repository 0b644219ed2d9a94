//! Moves with the knife up: x and y along a straight line, C independently.

use crate::ir::motion::Glide;
use crate::ir::toolpath::Pose;
use crate::machine::Limits;
use crate::machine::kinematics::Move;

/// The fastest move between two poses within the limits of x, y and c.
pub(super) fn glide(from: Pose, to: Pose, limits: &[Limits; 3]) -> Glide {
    let way = to.centre - from.centre;
    let length = way.norm();
    let line = if length > 0.0 {
        let u = way / length;
        limits[0].along(u.x).min(limits[1].along(u.y))
    } else {
        limits[0].min(limits[1])
    };
    Glide { from, to, line: Move::new(length, line), turn: Move::new((to.c.0 - from.c.0).abs(), limits[2]) }
}
