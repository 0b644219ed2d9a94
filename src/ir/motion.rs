//! When the axes are where: the timed form.
//!
//! A motion holds the phases of one toolpath. A phase lasts a whole number of periods and says what the outputs are
//! from its first tick until the next phase begins; the pose at tick `i` is that at time `i * period`.

mod poses;

pub use poses::{Derivatives, Glide, Poses, StraightCut};

use super::toolpath::{Edge, Event, OrientationMode, Overcut, Pose, Side};

/// The phases of one toolpath, in order.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Motion {
    /// The number of the piece that it belongs to.
    pub piece: u32,
    /// The place of that piece in the marker, from 0: numbers may come again.
    pub part: u32,
    /// Tick at which its first phase begins, counted from the start of the program.
    pub first_tick: u64,
    /// Steps of the program before its first.
    pub first_step: u64,
    /// Time that the program took before its first phase, not stretched to whole periods, s.
    pub first_time: f64,
    /// The phases.
    pub phases: Vec<Phase>,
    /// What each plunge and each drill in them is for, in order.
    pub tasks: Vec<Task>,
}

/// What a plunge or a drill is for.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Task {
    /// The first and the last source block that it cuts or drills.
    pub blocks: [u32; 2],
    /// How far the tip goes past the end, mm; 0 for a drill.
    pub front: f64,
    /// How far the heel starts before the start, mm; 0 for a drill.
    pub heel: f64,
    /// Where the overlaps of start and end go.
    pub sides: [Side; 2],
    /// Whether it is cut the other way round than the file has it.
    pub turned: bool,
    /// The edge of the blade that goes first.
    pub edge: Edge,
    /// How far the blade of a plunge cut cuts into parts before the start and past the end.
    pub overcut: [Overcut; 2],
    /// How the blade lies on the way of a cut; `None` when it only plunges, and for a drill.
    pub orientation: Option<OrientationMode>,
}

/// A stretch of time in which the outputs do not change.
#[derive(Debug, Clone, PartialEq)]
pub struct Phase {
    /// What happens.
    pub kind: Kind,
    /// Number of periods; at least 1.
    pub ticks: u32,
    /// Where the axes are at its ticks.
    pub poses: Poses,
    /// The source blocks being cut, in order; none when the knife is up.
    pub spells: Vec<Spell>,
    /// Time before it was stretched to whole periods, s.
    pub duration: f64,
    /// Way of the tip in a cut, of the C axis in the air, mm.
    pub length: f64,
    /// Way of the cloth so far, mm: X on the cloth less X on the table.
    pub station: u32,
}

/// The ticks of a phase in which one source block is being cut: from its first one until the next spell begins.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Spell {
    /// The first tick, counted from the start of the phase; 0 in the first spell.
    pub first: u32,
    /// The block.
    pub block: u32,
}

/// What happens in a phase.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// Knife up, axes at rest: the end of a program.
    Rest,
    /// Knife up, axes at rest until the blade is all the way up; the dwells of a program that keeps the knife up.
    Wait,
    /// Knife up, from anywhere to anywhere.
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
    /// Number of the part of a program's time that a phase of the kind counts to: cutting, travelling, turning, plunging,
    /// lifting, drilling, waiting.
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

    /// Whether the knife is commanded down.
    pub fn knife_down(self) -> bool {
        match self {
            Self::Plunge | Self::Cut => true,
            Self::Rest | Self::Wait | Self::Travel | Self::Turn | Self::Lift | Self::Drill(_) | Self::Event(_) => false,
        }
    }

    /// Whether a step of the program begins with it: a cut goes on from its plunge to its lift, and the rest at the end
    /// is no step.
    pub fn begins_step(self) -> bool {
        match self {
            Self::Travel | Self::Turn | Self::Plunge | Self::Drill(_) | Self::Event(_) => true,
            Self::Cut | Self::Lift | Self::Rest | Self::Wait => false,
        }
    }

    /// What happens instead when knife and drills stay up: the axes do the same.
    #[must_use]
    pub fn raised(self) -> Self {
        match self {
            Self::Plunge | Self::Lift | Self::Drill(_) => Self::Wait,
            Self::Cut => Self::Travel,
            Self::Rest | Self::Wait | Self::Travel | Self::Turn | Self::Event(_) => self,
        }
    }

    /// The drill that is commanded, 1 to 4; 0 = none.
    pub fn drill(self) -> u8 {
        if let Self::Drill(tool) = self { tool } else { 0 }
    }

    /// The event as the setpoint formats number it: 0 none, 1 stop, 2 advance.
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

impl Motion {
    /// Number of periods of all phases.
    pub fn ticks(&self) -> u64 {
        self.phases.iter().map(|phase| u64::from(phase.ticks)).sum()
    }
}

/// What keeps a cut from being faster.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Bound {
    /// It has to start from rest and to come to rest.
    Ends,
    /// The greatest speed of the tip.
    Feed,
    /// The greatest speed, acceleration or jerk (order 0 to 2) of x, y or c (axis 0 to 2).
    Axis {
        /// Which axis.
        axis: u8,
        /// Which of its limits.
        order: u8,
    },
}

/// Every bound; the axes' own stand behind the first two, axis by axis.
pub const BOUNDS: [Bound; 11] = {
    const fn of(axis: u8, order: u8) -> Bound {
        Bound::Axis { axis, order }
    }
    let [x, y, c] = [0, 1, 2];
    [Bound::Ends, Bound::Feed, of(x, 0), of(x, 1), of(x, 2), of(y, 0), of(y, 1), of(y, 2), of(c, 0), of(c, 1), of(c, 2)]
};

/// How many ticks each bound decides.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Shares([u64; BOUNDS.len()]);

impl Shares {
    /// Counts more ticks of a bound.
    pub fn add(&mut self, bound: Bound, ticks: u64) {
        self.0[place(bound)] += ticks;
    }

    /// Counts what another cut counted.
    pub fn merge(&mut self, other: &Self) {
        for (sum, more) in self.0.iter_mut().zip(other.0) {
            *sum += more;
        }
    }

    /// The ticks of a bound.
    pub fn of(&self, bound: Bound) -> u64 {
        self.0[place(bound)]
    }
}

/// Where a bound stands in [`BOUNDS`].
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
