//! Poses of the axes during a phase: at rest, as samples, or as a closed form that is sampled when it is written.
//!
//! A closed form takes a few numbers whatever its length, and its peak derivatives are known without samples.

use crate::geom::{Point, Rotation, Vector};
use crate::ir::toolpath::Pose;
use crate::machine::kinematics::Move;

/// The poses at the ticks of a phase.
#[derive(Debug, Clone, PartialEq)]
pub enum Poses {
    /// The axes are at rest.
    Still(Pose),
    /// One pose per tick.
    Samples(Vec<Pose>),
    /// A straight cut.
    StraightCut(StraightCut),
    /// A move with the knife up.
    Glide(Glide),
}

/// Peak speed, acceleration and jerk of x, y (mm) and c (rad), per s, s2, s3.
pub type Derivatives = [[f64; 3]; 3];

impl Poses {
    /// The pose at tick `i` of a phase of `ticks` periods.
    pub fn at(&self, i: u32, ticks: u32) -> Pose {
        let (time, duration) = (f64::from(i), f64::from(ticks));
        match self {
            Self::Still(pose) => *pose,
            Self::Samples(poses) => poses[i as usize],
            Self::StraightCut(stroke) => stroke.at(time, duration),
            Self::Glide(glide) => glide.at(time, duration),
        }
    }

    /// Peak derivatives over a phase of `duration` (s), from its closed form; `None` for samples.
    pub fn derivatives(&self, duration: f64) -> Option<Derivatives> {
        match self {
            Self::Still(_) => Some(Derivatives::default()),
            Self::Samples(_) => None,
            Self::StraightCut(stroke) => Some(stroke.derivatives(duration)),
            Self::Glide(glide) => Some(glide.derivatives(duration)),
        }
    }

    /// Translates all poses by a vector, mm.
    pub fn shift(&mut self, by: Vector) {
        let shifted = |pose: &mut Pose| pose.centre += by;
        match self {
            Self::Still(pose) => shifted(pose),
            Self::Samples(poses) => poses.iter_mut().for_each(shifted),
            Self::StraightCut(stroke) => stroke.from += by,
            Self::Glide(glide) => [&mut glide.from, &mut glide.to].into_iter().for_each(shifted),
        }
    }

    /// Adds an angle to C in all poses, rad.
    pub fn turn(&mut self, by: f64) {
        let turned = |pose: &mut Pose| pose.c = Rotation(pose.c.0 + by);
        match self {
            Self::Still(pose) => turned(pose),
            Self::Samples(poses) => poses.iter_mut().for_each(turned),
            Self::StraightCut(stroke) => stroke.c = Rotation(stroke.c.0 + by),
            Self::Glide(glide) => [&mut glide.from, &mut glide.to].into_iter().for_each(turned),
        }
    }
}

/// A straight cut from rest to rest with constant heading.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StraightCut {
    /// Start of the line.
    pub from: Point,
    /// Direction of the line, a unit vector.
    pub along: Vector,
    /// Start of the tip on the line, mm; the heel is then at the start of the line.
    pub start: f64,
    /// Distance of the C axis behind the tip, mm.
    pub lead: f64,
    /// Position of C.
    pub c: Rotation,
    /// Motion of the tip from its start over time, mm and s.
    pub way: Move,
}

impl StraightCut {
    /// Position of the tip on the line, mm, at `time` of the cut stretched to `duration`, both in one unit.
    pub fn reach(&self, time: f64, duration: f64) -> f64 {
        self.start + self.way.at(time, duration)
    }

    /// The pose at `time` of the cut stretched to `duration`, both in one unit.
    pub fn at(&self, time: f64, duration: f64) -> Pose {
        Pose { centre: self.from + self.along * (self.reach(time, duration) - self.lead), c: self.c }
    }

    fn derivatives(&self, duration: f64) -> Derivatives {
        let way = self.way.derivatives(duration);
        let axis = |share: f64| way.map(|value| value * share.abs());
        [axis(self.along.x), axis(self.along.y), [0.0; 3]]
    }
}

/// A move with the knife up, from rest to rest: x and y along a straight line and C independently, each in closed form,
/// stretched to one common duration.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Glide {
    /// Start.
    pub from: Pose,
    /// End.
    pub to: Pose,
    /// Motion of the C axis over the table, mm and s.
    pub line: Move,
    /// Turning of C, rad and s.
    pub turn: Move,
}

impl Glide {
    /// Time from rest to rest, s.
    pub fn duration(&self) -> f64 {
        self.line.duration().max(self.turn.duration())
    }

    /// Length of the path of the C axis over the table, mm.
    pub fn length(&self) -> f64 {
        (self.to.centre - self.from.centre).norm()
    }

    /// The pose at `time` of the move stretched to `duration`, both in one unit.
    pub fn at(&self, time: f64, duration: f64) -> Pose {
        if time >= duration {
            return self.to;
        }
        let way = self.to.centre - self.from.centre;
        let length = way.norm();
        let share = if length > 0.0 { self.line.at(time, duration) / length } else { 0.0 };
        let turned = self.turn.at(time, duration).copysign(self.to.c.0 - self.from.c.0);
        Pose { centre: self.from.centre + way * share, c: Rotation(self.from.c.0 + turned) }
    }

    fn derivatives(&self, duration: f64) -> Derivatives {
        let way = self.to.centre - self.from.centre;
        let length = way.norm();
        let line = self.line.derivatives(duration);
        let axis = |part: f64| if length > 0.0 { line.map(|value| value * part.abs() / length) } else { [0.0; 3] };
        [axis(way.x), axis(way.y), self.turn.derivatives(duration)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::machine::Limits;

    #[test]
    fn no_difference_of_a_closed_form_exceeds_its_derivatives_and_on_a_fine_grid_it_reaches_them() {
        let limits = Limits { speed: 300.0, acceleration: 2000.0, jerk: 5.0e4 };
        let (from, to) = (Pose::new(5.0, -3.0, 0.2), Pose::new(85.0, 57.0, -1.1));
        let turn = Limits { speed: 2.0, acceleration: 40.0, jerk: 2.0e3 };
        let glide = Glide { from, to, line: Move::new(100.0, limits), turn: Move::new(1.3, turn) };
        let (along, start, c) = (Vector::new(0.6, -0.8), 6.6, Rotation(0.4));
        let stroke = StraightCut { from: from.centre, along, start, lead: 4.4, c, way: Move::new(40.0, limits) };
        for (poses, duration) in [(Poses::Glide(glide), 1.0), (Poses::StraightCut(stroke), 0.75)] {
            let ticks = 4000;
            let h = duration / f64::from(ticks);
            let row = |i: u32| {
                let pose = poses.at(i, ticks);
                [pose.centre.x, pose.centre.y, pose.c.0]
            };
            let bounds = poses.derivatives(duration).expect("it is a closed form");
            for (axis, bounds) in bounds.into_iter().enumerate() {
                let mut worst = [0.0_f64; 3];
                for i in 0..ticks - 3 {
                    let [a, b, c, d] = [0, 1, 2, 3].map(|k| row(i + k)[axis]);
                    let found = [b - a, c - 2.0 * b + a, d - 3.0 * c + 3.0 * b - a];
                    for (worst, (difference, power)) in
                        worst.iter_mut().zip(found.into_iter().zip([h, h * h, h * h * h]))
                    {
                        *worst = worst.max(difference.abs() / power);
                    }
                }
                for (k, (worst, bound)) in worst.into_iter().zip(bounds).enumerate() {
                    assert!(worst <= bound * 1.001 + 1e-9, "axis {axis}, order {k}: {worst} above {bound}");
                    assert!(worst >= bound * 0.98 - 1e-9, "axis {axis}, order {k}: {worst} far below {bound}");
                }
            }
        }
    }
}
