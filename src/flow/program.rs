//! What the heads do: every chain on a head, every head in a row, and where each head is at every tick.

use super::heads::Start;
use super::link::{Gap, Link, State, Wait};
use super::moving::Moving;
use super::stroke::Stroke;
use super::yielding::ends_of;
use crate::machine::Job;

/// A conveyor and heads that cut a marker.
#[derive(Debug)]
pub struct Program {
    /// The chains, with their motion.
    pub strokes: Vec<Stroke>,
    /// The heads, row by row, in each from the lowest y to the highest.
    pub heads: Vec<Head>,
    /// Speed of the conveyor, mm/s.
    pub speed: f64,
    /// Where each row stands along the feed, mm from the origin of the marker.
    pub stations: Vec<f64>,
    /// Ticks that every head's program has.
    pub ticks: u64,
    /// What was found about the job.
    pub figures: super::Figures,
    pub(super) moving: Moving,
}

/// A head.
#[derive(Debug, Clone)]
pub struct Head {
    /// The row that it stands in, from 0.
    pub row: usize,
    /// What it cuts, in order; ticks count from where the place x = 0 of the cloth meets the station.
    pub tasks: Vec<Start>,
    /// Whole turns by which C is ahead of the motion of each stroke, rad.
    pub(super) turns: Vec<f64>,
    /// Where it waits before, between and behind its chains.
    pub(super) waits: Vec<Wait>,
}

/// A row of a head's program.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Setpoint {
    /// Which, from 0.
    pub tick: u64,
    /// Where the head is.
    pub state: State,
    /// Whether the knife is commanded down.
    pub knife: bool,
    /// The block that is cut; 0 = none.
    pub block: u32,
}

/// Periods at rest before the first and behind the last thing that a head does.
const REST: i64 = 3;

impl Program {
    /// Time between two setpoints, s.
    pub fn period(&self) -> f64 {
        self.moving.period
    }

    /// How far a head may travel along the feed, mm.
    pub(super) fn travel(&self) -> f64 {
        self.moving.either.profile.flow.travel_mm
    }

    /// Room that a head takes across the feed, mm.
    pub(super) fn room(&self) -> f64 {
        self.moving.either.profile.flow.head_width_mm
    }

    /// From the C axis to the tip of the blade, and its width, mm.
    pub(super) fn knife(&self) -> [f64; 2] {
        let knife = &self.moving.either.profile.knife;
        [knife.radius(), knife.width_mm]
    }

    /// Position of the conveyor at a tick, mm.
    pub fn conveyor(&self, tick: u64) -> f64 {
        self.speed * (tick as f64 * self.moving.period)
    }

    /// The tick at which the place x = 0 of the cloth meets the station of a row, rounded.
    pub(super) fn origin(&self, row: usize) -> i64 {
        (self.stations[row] / self.moving.step()).round() as i64
    }

    /// The ticks from the start of a chain of a head to its end, and where the head is then.
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

    /// Position of the conveyor beyond where the cloth's zero is under the station of a row, mm.
    fn away(&self, row: usize, tick: i64) -> f64 {
        let conveyor = self.speed * ((tick + self.origin(row)) as f64 * self.moving.period);
        conveyor - self.stations[row]
    }

    /// All that a head does, tick by tick from the start of the program to its end.
    pub fn setpoints<'a>(&'a self, head: &'a Head) -> impl Iterator<Item = Setpoint> + 'a {
        let parts = (0..=2 * head.tasks.len()).flat_map(move |part| -> Box<dyn Iterator<Item = (State, bool, u32)>> {
            if part % 2 == 0 { Box::new(self.gap(head, part / 2)) } else { Box::new(self.stroke(head, part / 2)) }
        });
        parts.zip(0..).map(|((state, knife, block), tick)| Setpoint { tick, state, knife, block })
    }

    /// What a head does before, between or behind its chains.
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
            // At the ends of the program it rests where its ramp begins or ends.
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

    /// What a head does along a chain.
    fn stroke<'a>(&'a self, head: &'a Head, task: usize) -> impl Iterator<Item = (State, bool, u32)> + 'a {
        let Start { task: stroke, tick } = head.tasks[task];
        let turn = head.turns[task];
        self.strokes[stroke].poses().zip(tick..).map(move |((pose, knife, block), tick)| {
            let xi = pose.centre.x + self.away(head.row, tick);
            (State { xi, y: pose.centre.y, c: pose.c.0 + turn }, knife, block)
        })
    }

    /// The first and the last tick at which any head does something: the first is below 0 where the first row stands too
    /// near to the cloth.
    pub(super) fn extent(&self) -> [i64; 2] {
        self.extent_of(&self.heads)
    }

    /// The same of heads that cut its strokes.
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

/// Where the rows of a machine stand over a marker whose greatest x is `front`, mm.
pub(super) fn stations(front: f64, job: &Job) -> Vec<f64> {
    let flow = &job.profile.flow;
    (0..flow.rows).map(|row| front + flow.first_row_mm + f64::from(row) * flow.row_pitch_mm).collect()
}
