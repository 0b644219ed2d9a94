//! What the heads do: every chain on a head, every head in a row, and where each head is at every tick.

use super::heads::Start;
use super::link::{Link, State, When};
use super::moving::Moving;
use super::stroke::Stroke;
use crate::machine::Job;

/// A conveyor and heads that cut a marker.
#[derive(Debug)]
pub struct Program {
    /// The chains, with their motion.
    pub strokes: Vec<Stroke>,
    /// The heads, row by row.
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

    /// Position of the conveyor at a tick, mm.
    pub fn conveyor(&self, tick: u64) -> f64 {
        self.speed * (tick as f64 * self.moving.period)
    }

    /// The tick at which the place x = 0 of the cloth meets the station of a row, rounded.
    pub(super) fn origin(&self, row: usize) -> i64 {
        (self.stations[row] / self.moving.step()).round() as i64
    }

    /// Where a head is when a chain starts on it and when it ends, seen from a station that the cloth's zero meets at tick
    /// `origin`.
    pub(super) fn ends(&self, start: Start, row: usize) -> [State; 2] {
        let stroke = &self.strokes[start.task];
        [(stroke.ends[0], start.tick), (stroke.ends[1], start.tick + i64::from(stroke.ticks))].map(|(pose, tick)| {
            let away = self.away(row, tick);
            State { xi: pose.centre.x + away, y: pose.centre.y, c: pose.c.0 }
        })
    }

    /// Position of the conveyor beyond where the cloth's zero is under the station of a row, mm.
    fn away(&self, row: usize, tick: i64) -> f64 {
        let conveyor = self.speed * ((tick + self.origin(row)) as f64 * self.moving.period);
        conveyor - self.stations[row]
    }

    /// All that a head does, tick by tick from the start of the program to its end.
    pub fn setpoints<'a>(&'a self, head: &'a Head) -> impl Iterator<Item = Setpoint> + 'a {
        let origin = self.origin(head.row);
        let last = self.ticks as i64 - origin;
        self.parts(head).into_iter().flat_map(move |part| self.ticks_of(head.row, part, last)).zip(0..).map(
            |((state, knife, block), tick)| Setpoint { tick, state, knife, block },
        )
    }

    /// What a head does: links, and chains between them.
    fn parts(&self, head: &Head) -> Vec<Part> {
        let moving = &self.moving;
        let origin = self.origin(head.row);
        let mut parts = Vec::new();
        let mut before: Option<(State, i64)> = None;
        for &start in &head.tasks {
            let [first, last] = self.ends(start, head.row);
            let (from, moves, began) = match before {
                Some((state, tick)) => (state, true, tick),
                None => (State { xi: first.xi - moving.ramp.way, ..first }, false, -origin),
            };
            let ticks = (start.tick - began) as u32;
            parts.push(Part::Link(Link::new([from, first], [moves, true], ticks, When::AtOnce, moving)));
            parts.push(Part::Stroke(start));
            before = Some((last, start.tick + i64::from(self.strokes[start.task].ticks)));
        }
        if let Some((state, tick)) = before {
            let to = State { xi: state.xi + moving.ramp.way, ..state };
            let ticks = (self.ticks as i64 - origin - tick).max(0) as u32;
            parts.push(Part::Link(Link::new([state, to], [true, false], ticks, When::AtOnce, moving)));
        }
        parts
    }

    /// Its place across the feed at ticks that count from where the place x = 0 of the cloth meets the station, mm.
    pub(super) fn across<'a>(&'a self, head: &'a Head, [first, last]: [i64; 2]) -> impl Iterator<Item = f64> + 'a {
        let origin = self.origin(head.row);
        let mut parts = Vec::new();
        let mut before: Option<(State, i64)> = None;
        for &start in &head.tasks {
            let [from, to] = self.ends(start, head.row);
            match before {
                Some((state, tick)) => {
                    let ticks = (start.tick - tick) as u32;
                    parts.push(Part::Link(Link::new([state, from], [true; 2], ticks, When::AtOnce, &self.moving)));
                }
                None => parts.push(Part::Rest(from, start.tick - (first - origin))),
            }
            parts.push(Part::Stroke(start));
            before = Some((to, start.tick + i64::from(self.strokes[start.task].ticks)));
        }
        if let Some((state, tick)) = before {
            parts.push(Part::Rest(state, last - origin - tick));
        }
        let end = i64::MAX;
        parts.into_iter().flat_map(move |part| self.ticks_of(head.row, part, end)).map(|(state, _, _)| state.y)
    }

    fn ticks_of(&self, row: usize, part: Part, last: i64) -> Box<dyn Iterator<Item = (State, bool, u32)> + '_> {
        match part {
            Part::Link(link) => Box::new((0..link.ticks).map(move |tick| (link.at(tick), false, 0))),
            Part::Rest(state, ticks) => Box::new((0..ticks).map(move |_| (state, false, 0))),
            Part::Stroke(start) => {
                let poses = self.strokes[start.task].poses().zip(start.tick..last);
                Box::new(poses.map(move |((pose, knife, block), tick)| {
                    let xi = pose.centre.x + self.away(row, tick);
                    (State { xi, y: pose.centre.y, c: pose.c.0 }, knife, block)
                }))
            }
        }
    }

    /// The last tick at which any head still does something, and the first: the second is below 0 where the first row
    /// stands too near to the cloth.
    pub(super) fn extent(&self) -> [i64; 2] {
        let ramp = i64::from(self.moving.ramp.ticks) + REST;
        let ends = self.heads.iter().flat_map(|head| {
            let origin = self.origin(head.row);
            head.tasks.iter().map(move |start| {
                [start.tick + origin - ramp, start.tick + origin + i64::from(self.strokes[start.task].ticks) + ramp]
            })
        });
        ends.fold([i64::MAX, i64::MIN], |[first, last], [from, to]| [first.min(from), last.max(to)])
    }
}

/// Something that a head does.
#[derive(Debug, Clone, Copy)]
enum Part {
    Rest(State, i64),
    Link(Link),
    Stroke(Start),
}

/// Where the rows of a machine stand over a marker whose greatest x is `front`, mm.
pub(super) fn stations(front: f64, job: &Job) -> Vec<f64> {
    let flow = &job.profile.flow;
    (0..flow.rows).map(|row| front + flow.first_row_mm + f64::from(row) * flow.row_pitch_mm).collect()
}
