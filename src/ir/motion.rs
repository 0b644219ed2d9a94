//! Motion of the axes over time: the timed form.
//!
//! A motion holds the phases of one toolpath. A phase lasts a whole number of periods and defines the outputs from its first
//! tick until the next phase begins; the pose at tick `i` is the pose at time `i * period`.

mod poses;

use std::fmt;

pub use poses::{Derivatives, Glide, Poses, StraightCut};

use super::toolpath::{Edge, Event, OrientationMode, Overcut, Pose, Side};

/// The phases of one toolpath, in order.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Motion {
    /// Number of its piece.
    pub piece: u32,
    /// Index of that piece in the marker, from 0; piece numbers may repeat.
    pub part: u32,
    /// Tick of the start of its first phase, counted from the start of the program.
    pub first_tick: u64,
    /// Number of steps of the program before its first one.
    pub first_step: u64,
    /// Duration of the program before its first phase, before rounding up to whole periods, s.
    pub first_time: f64,
    /// The phases.
    pub phases: Vec<Phase>,
    /// Task of each plunge and each drill in the phases, in order.
    pub tasks: Vec<Task>,
    /// Number of ticks of its cuts bound by each limit.
    pub shares: Shares,
}

/// Task of a plunge or a drill.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Task {
    /// The first and the last source block that it cuts or drills.
    pub blocks: [u32; 2],
    /// Length of the tip's path past the end, mm; 0 for a drill.
    pub front: f64,
    /// Distance of the heel before the start, mm; 0 for a drill.
    pub heel: f64,
    /// Direction of the overlaps at start and end.
    pub sides: [Side; 2],
    /// True if it is cut in reverse to the file.
    pub turned: bool,
    /// Leading edge of the blade.
    pub edge: Edge,
    /// Depth of a plunge cut in parts before its start and past its end.
    pub overcut: [Overcut; 2],
    /// Orientation of the blade along a cut; `None` for a plunge without motion and for a drill.
    pub orientation: Option<OrientationMode>,
}

/// A period of time with constant outputs.
#[derive(Debug, Clone, PartialEq)]
pub struct Phase {
    /// Kind of activity.
    pub kind: Kind,
    /// Number of periods; at least 1.
    pub ticks: u32,
    /// Poses of the axes at its ticks.
    pub poses: Poses,
    /// Source blocks being cut, in order; empty when the knife is up.
    pub spells: Vec<Spell>,
    /// Duration before rounding up to whole periods, s.
    pub duration: f64,
    /// Length of the path, mm: of the tip in a cut, of the C axis in the air.
    pub length: f64,
    /// Advance of the cloth so far, mm: X on the cloth minus X on the table.
    pub station: u32,
}

/// The ticks of a phase in which one source block is being cut, from `first` until the next spell.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Spell {
    /// First tick, counted from the start of the phase; 0 in the first spell.
    pub first: u32,
    /// Source block.
    pub block: u32,
}

/// Kind of activity in a phase.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// Knife up, axes at rest: the end of a program.
    Rest,
    /// Knife up, axes at rest until the blade is fully up; also the dwells of a program that keeps the knife up.
    Wait,
    /// Knife up, between any two poses.
    Travel,
    /// Knife up, at a corner of a contour.
    Turn,
    /// Knife commanded down, axes at rest.
    Plunge,
    /// Knife down, axes along the path.
    Cut,
    /// Knife commanded up, axes at rest.
    Lift,
    /// Drill 1 to 4 commanded, axes at rest.
    Drill(u8),
    /// An event, axes at rest.
    Event(Event),
}

impl Kind {
    /// Index of the category of program time to which a phase counts: cutting, travelling, turning, plunging, lifting,
    /// drilling, waiting.
    pub fn part(self) -> usize {
        match self {
            Self::Cut => 0,
            Self::Travel => 1,
            Self::Turn => 2,
            Self::Plunge => 3,
            Self::Lift => 4,
            Self::Drill(_) => 5,
            Self::Wait | Self::Event(_) | Self::Rest => 6,
        }
    }

    /// True if the knife is commanded down.
    pub fn knife_down(self) -> bool {
        match self {
            Self::Plunge | Self::Cut => true,
            Self::Rest | Self::Wait | Self::Travel | Self::Turn | Self::Lift | Self::Drill(_) | Self::Event(_) => false,
        }
    }

    /// True if a phase of the kind begins a step of the program. A cut belongs to the step of its plunge, up to its lift, and
    /// the rest at the end is no step.
    pub fn begins_step(self) -> bool {
        match self {
            Self::Travel | Self::Turn | Self::Plunge | Self::Drill(_) | Self::Event(_) => true,
            Self::Cut | Self::Lift | Self::Rest | Self::Wait => false,
        }
    }

    /// The kind with knife and drills kept up; the axes move as before.
    #[must_use]
    pub fn raised(self) -> Self {
        match self {
            Self::Plunge | Self::Lift | Self::Drill(_) => Self::Wait,
            Self::Cut => Self::Travel,
            Self::Rest | Self::Wait | Self::Travel | Self::Turn | Self::Event(_) => self,
        }
    }

    /// The commanded drill, 1 to 4; 0 = none.
    pub fn drill(self) -> u8 {
        if let Self::Drill(tool) = self { tool } else { 0 }
    }

    /// Code of the event in the setpoint formats: 0 none, 1 stop, 2 advance.
    pub fn event(self) -> u8 {
        match self {
            Self::Event(Event::Stop) => 1,
            Self::Event(Event::Advance | Event::AdvanceBy(_)) => 2,
            Self::Rest
            | Self::Wait
            | Self::Travel
            | Self::Turn
            | Self::Plunge
            | Self::Cut
            | Self::Lift
            | Self::Drill(_) => 0,
        }
    }
}

impl Phase {
    /// The pose at the phase's tick `i`.
    pub fn pose(&self, i: u32) -> Pose {
        self.poses.at(i, self.ticks)
    }

    /// The pose and the block being cut, 0 = none, tick by tick.
    pub fn setpoints(&self) -> impl Iterator<Item = (Pose, u32)> + '_ {
        let ends = self.spells.iter().skip(1).map(|next| next.first).chain([self.ticks]);
        let spells = self.spells.iter().zip(ends).map(|(spell, end)| (spell.first..end, spell.block));
        let none = self.spells.is_empty().then_some((0..self.ticks, 0));
        spells.chain(none).flat_map(move |(ticks, block)| ticks.map(move |i| (self.pose(i), block)))
    }
}

impl fmt::Display for Bound {
    /// Name in words, as in `jerk of c`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Ends => f.write_str("starts and stops"),
            Self::Feed => f.write_str("feed"),
            Self::Axis { axis, order } => {
                let (axis, order) = (usize::from(axis), usize::from(order));
                write!(f, "{} of {}", ["speed", "acceleration", "jerk"][order], ["x", "y", "c"][axis])
            }
        }
    }
}

impl Motion {
    /// Number of periods of all phases.
    pub fn ticks(&self) -> u64 {
        self.phases.iter().map(|phase| u64::from(phase.ticks)).sum()
    }
}

/// Limit that binds the speed of a cut.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Bound {
    /// The start from rest and the stop at the end.
    Ends,
    /// The speed cap of the tip.
    Feed,
    /// The maximum speed, acceleration or jerk (order 0 to 2) of x, y or c (axis 0 to 2).
    Axis {
        /// Axis: 0 = x, 1 = y, 2 = c.
        axis: u8,
        /// Limit: 0 = speed, 1 = acceleration, 2 = jerk.
        order: u8,
    },
}

/// All bounds: the first two, then those of each axis.
pub const BOUNDS: [Bound; 11] = {
    const fn of(axis: u8, order: u8) -> Bound {
        Bound::Axis { axis, order }
    }
    let [x, y, c] = [0, 1, 2];
    [Bound::Ends, Bound::Feed, of(x, 0), of(x, 1), of(x, 2), of(y, 0), of(y, 1), of(y, 2), of(c, 0), of(c, 1), of(c, 2)]
};

/// Number of ticks bound by each limit.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Shares([u64; BOUNDS.len()]);

impl Shares {
    /// Adds ticks of a bound.
    pub fn add(&mut self, bound: Bound, ticks: u64) {
        self.0[place(bound)] += ticks;
    }

    /// Adds the counts of another cut.
    pub fn merge(&mut self, other: &Self) {
        for (sum, more) in self.0.iter_mut().zip(other.0) {
            *sum += more;
        }
    }

    /// Number of ticks of a bound.
    pub fn of(&self, bound: Bound) -> u64 {
        self.0[place(bound)]
    }
}

/// Index of a bound in [`BOUNDS`].
fn place(bound: Bound) -> usize {
    match bound {
        Bound::Ends => 0,
        Bound::Feed => 1,
        Bound::Axis { axis, order } => 2 + 3 * usize::from(axis) + usize::from(order),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_bound_has_its_own_place() {
        assert!(BOUNDS.iter().enumerate().all(|(i, &bound)| place(bound) == i));
    }
}
