//! Program of all heads: the assignment of chains to heads and of heads to rows, and the position of each head at every tick.

use super::heads::Start;
use super::link::{Gap, Link, State, Wait};
use super::moving::Moving;
use super::stroke::Stroke;
use super::yielding::ends_of;
use crate::machine::Job;

/// Program of a conveyor and its heads for a marker.
#[derive(Debug)]
pub struct Program {
    /// The chains with their motion.
    pub strokes: Vec<Stroke>,
    /// The heads, row by row, within a row by increasing y.
    pub heads: Vec<Head>,
    /// Speed of the conveyor, mm/s.
    pub speed: f64,
    /// Position of each row along the feed, mm from the origin of the marker.
    pub stations: Vec<f64>,
    /// Number of setpoints of each head.
    pub ticks: u64,
    /// Figures of the job.
    pub figures: super::Figures,
    pub(super) moving: Moving,
}

/// A head and its chains.
#[derive(Debug, Clone)]
pub struct Head {
    /// Index of the row, from 0.
    pub row: usize,
    /// Tasks in order. Ticks count from the moment at which x = 0 of the cloth meets the station.
    pub tasks: Vec<Start>,
    /// Whole turns of C added to the motion of each stroke, rad.
    pub(super) turns: Vec<f64>,
    /// Waiting positions before, between and after the chains.
    pub(super) waits: Vec<Wait>,
}

/// A setpoint of a head.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Setpoint {
    /// Index of the setpoint, from 0.
    pub tick: u64,
    /// Position of the head.
    pub state: State,
    /// True if the knife is commanded down.
    pub knife: bool,
    /// Block that is cut; 0 if none.
    pub block: u32,
}

/// Periods at rest before the first and after the last motion of a head.
const REST: i64 = 3;

impl Program {
    /// Time between two setpoints, s.
    pub fn period(&self) -> f64 {
        self.moving.period
    }

    /// Available travel of a head along the feed, mm.
    pub(super) fn travel(&self) -> f64 {
        self.moving.either.profile.flow.travel_mm
    }

    /// Space that a head takes across the feed, mm.
    pub(super) fn room(&self) -> f64 {
        self.moving.either.profile.flow.head_width_mm
    }

    /// Distance from the C axis to the tip of the blade, and width of the blade, mm.
    pub(super) fn knife(&self) -> [f64; 2] {
        let knife = &self.moving.either.profile.knife;
        [knife.radius(), knife.width_mm]
    }

    /// Position of the conveyor at a tick, mm.
    pub fn conveyor(&self, tick: u64) -> f64 {
        self.speed * (tick as f64 * self.moving.period)
    }

    /// Tick at which x = 0 of the cloth meets the station of a row, rounded.
    pub(super) fn origin(&self, row: usize) -> i64 {
        (self.stations[row] / self.moving.step()).round() as i64
    }

    /// First and end tick of a chain of a head, and the states of the head at both.
    pub(super) fn chain(&self, head: &Head, task: usize) -> ([i64; 2], [State; 2]) {
        let Start { task: stroke, tick } = head.tasks[task];
        let stroke = &self.strokes[stroke];
        let ticks = [tick, tick + i64::from(stroke.ticks)];
        let state = |i: usize| {
            let pose = stroke.ends[i];
            let c = pose.c.0 + head.turns[task];
            State { xi: pose.centre.x + self.away(head.row, ticks[i]), y: pose.centre.y, c }
        };
        (ticks, [state(0), state(1)])
    }

    /// Distance that x = 0 of the cloth has moved beyond the station of a row, mm.
    fn away(&self, row: usize, tick: i64) -> f64 {
        let conveyor = self.speed * ((tick + self.origin(row)) as f64 * self.moving.period);
        conveyor - self.stations[row]
    }

    /// All setpoints of a head, from the start of the program to its end.
    pub fn setpoints<'a>(&'a self, head: &'a Head) -> impl Iterator<Item = Setpoint> + 'a {
        let parts = (0..=2 * head.tasks.len()).flat_map(move |part| -> Box<dyn Iterator<Item = (State, bool, u32)>> {
            if part % 2 == 0 { Box::new(self.gap(head, part / 2)) } else { Box::new(self.stroke(head, part / 2)) }
        });
        parts.zip(0..).map(|((state, knife, block), tick)| Setpoint { tick, state, knife, block })
    }

    /// Setpoints of a head before, between or after its chains.
    fn gap(&self, head: &Head, gap: usize) -> impl Iterator<Item = (State, bool, u32)> + use<> {
        let origin = self.origin(head.row);
        let before = gap.checked_sub(1).map(|task| self.chain(head, task));
        let behind = (gap < head.tasks.len()).then(|| self.chain(head, gap));
        let from = before.map_or(-origin, |(ticks, _)| ticks[1]);
        let to = behind.map_or(self.ticks.cast_signed() - origin, |(ticks, _)| ticks[0]);
        let ticks = (to - from).max(0) as u32;
        let ends = [before.map(|(_, states)| states[1]), behind.map(|(_, states)| states[0])];
        let wait = head.waits[gap];
        let ramp = self.moving.ramp.way;
        let link = ends_of(ends, wait).map(|[mut first, mut last]| {
            // At the ends of the program the head rests where its ramp begins or ends.
            if ends[0].is_none() {
                first.xi -= ramp;
            }
            if ends[1].is_none() {
                last.xi += ramp;
            }
            let gap = Gap { ends: [first, last], moves: ends.map(|end| end.is_some()), wait };
            Link::new(&gap, ticks, &self.moving)
        });
        (0..ticks).filter_map(move |tick| link.map(|link| (link.at(tick), false, 0)))
    }

    /// Setpoints of a head along a chain.
    fn stroke<'a>(&'a self, head: &'a Head, task: usize) -> impl Iterator<Item = (State, bool, u32)> + 'a {
        let Start { task: stroke, tick } = head.tasks[task];
        let turn = head.turns[task];
        self.strokes[stroke].poses().zip(tick..).map(move |((pose, knife, block), tick)| {
            let xi = pose.centre.x + self.away(head.row, tick);
            (State { xi, y: pose.centre.y, c: pose.c.0 + turn }, knife, block)
        })
    }

    /// First and last tick at which any head does something. The first is negative if the first row stands too near to the
    /// cloth.
    pub(super) fn extent(&self) -> [i64; 2] {
        self.extent_of(&self.heads)
    }

    /// First and last tick at which any of the given heads does something.
    pub(super) fn extent_of(&self, heads: &[Head]) -> [i64; 2] {
        let ramp = i64::from(self.moving.ramp.ticks) + REST;
        let ends = heads.iter().flat_map(|head| {
            let origin = self.origin(head.row);
            head.tasks.iter().map(move |start| {
                [start.tick + origin - ramp, start.tick + origin + i64::from(self.strokes[start.task].ticks) + ramp]
            })
        });
        ends.fold([i64::MAX, i64::MIN], |[first, last], [from, to]| [first.min(from), last.max(to)])
    }
}

/// Positions of the rows of a machine along the feed, mm, for a marker with the maximum x `front`.
pub(super) fn stations(front: f64, job: &Job) -> Vec<f64> {
    let flow = &job.profile.flow;
    (0..flow.rows).map(|row| front + flow.first_row_mm + f64::from(row) * flow.row_pitch_mm).collect()
}
