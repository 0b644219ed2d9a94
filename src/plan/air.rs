//! Moves with the knife up: x and y along the straight line, C beside them, each in closed form, stretched to one
//! common duration.

use crate::geom::Rotation;
use crate::ir::toolpath::Pose;
use crate::machine::Limits;
use crate::machine::kinematics::Move;

/// A move through the air, from rest to rest.
#[derive(Debug)]
pub(super) struct Air {
    from: Pose,
    to: Pose,
    line: Move,
    turn: Move,
}

impl Air {
    /// The fastest move between two poses within the limits of x, y and c.
    pub(super) fn new(from: Pose, to: Pose, limits: &[Limits; 3]) -> Self {
        let way = to.centre - from.centre;
        let length = way.norm();
        let line = if length > 0.0 {
            let u = way / length;
            limits[0].along(u.x).min(limits[1].along(u.y))
        } else {
            limits[0].min(limits[1])
        };
        Self { from, to, line: Move::new(length, line), turn: Move::new((to.c.0 - from.c.0).abs(), limits[2]) }
    }

    /// Time from rest to rest, s.
    pub(super) fn duration(&self) -> f64 {
        self.line.duration().max(self.turn.duration())
    }

    /// Way of the C axis over the table, mm.
    pub(super) fn length(&self) -> f64 {
        (self.to.centre - self.from.centre).norm()
    }

    /// The pose at `time` of the move stretched to `duration`.
    pub(super) fn at(&self, time: f64, duration: f64) -> Pose {
        if time >= duration {
            return self.to;
        }
        let way = self.to.centre - self.from.centre;
        let length = way.norm();
        let share = if length > 0.0 { self.line.at(time, duration) / length } else { 0.0 };
        let turned = self.turn.at(time, duration).copysign(self.to.c.0 - self.from.c.0);
        Pose { centre: self.from.centre + way * share, c: Rotation(self.from.c.0 + turned) }
    }
}
