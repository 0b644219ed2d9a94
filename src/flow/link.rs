//! What a head does between two chains, and before the first and behind the last: from moving with the cloth to rest over
//! the table, to where it is wanted, and back to the speed of the cloth. The knife is up all along.

use super::moving::Moving;
use super::ramp::Ramp;
use crate::machine::kinematics::Move;

/// Where a head is: along the feed from its station and across, mm; C, rad.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct State {
    /// Along the feed, from the station.
    pub xi: f64,
    /// Across the feed.
    pub y: f64,
    /// Position of C.
    pub c: f64,
}

/// Where a head waits across the feed between two chains.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Wait {
    /// Where the next chain starts.
    #[default]
    There,
    /// Where the last one ended.
    Here,
    /// At another place, out of the way of others, mm.
    At(f64),
}

/// An axis that goes from one place to another in its own time, and rests before and behind.
#[derive(Debug, Clone, Copy)]
struct Shift {
    from: f64,
    to: f64,
    way: Move,
    /// The tick at which it begins, and how many it takes.
    first: u32,
    ticks: u32,
}

impl Shift {
    fn new([from, to]: [f64; 2], axis: usize, moving: &Moving) -> Self {
        let way = Move::new((to - from).abs(), moving.rapid[axis]);
        Self { from, to, way, first: 0, ticks: periods(way.duration(), moving.period) }
    }

    /// The same that begins at a tick.
    fn begun(self, first: u32) -> Self {
        Self { first, ..self }
    }

    /// The same that ends at a tick.
    fn ended(self, last: u32) -> Self {
        Self { first: last.saturating_sub(self.ticks), ..self }
    }

    fn at(&self, tick: u32) -> f64 {
        let done = self.way.at(f64::from(tick.saturating_sub(self.first)), f64::from(self.ticks.max(1)));
        self.from + done.copysign(self.to - self.from)
    }
}

/// What lies between two chains.
#[derive(Debug, Clone, Copy)]
pub(super) struct Gap {
    pub(super) ends: [State; 2],
    /// Whether the head moves with the cloth at its start, and at its end.
    pub(super) moves: [bool; 2],
    pub(super) wait: Wait,
}

/// What a head does between two chains.
#[derive(Debug, Clone, Copy)]
pub(super) struct Link {
    ramp: Ramp,
    ends: [State; 2],
    /// Whether it moves with the cloth at its start, and at its end.
    moves: [bool; 2],
    pub(super) ticks: u32,
    x: Shift,
    /// To where it waits, and on from there.
    y: [Shift; 2],
    c: Shift,
}

impl Link {
    /// The link over a gap that takes so many ticks.
    pub(super) fn new(gap: &Gap, ticks: u32, moving: &Moving) -> Self {
        let (ramp, Gap { ends, moves, wait }) = (moving.ramp, *gap);
        let [from, to] = ends;
        let x = Shift::new(rests(ends, moves, &ramp), 0, moving).begun(if moves[0] { ramp.ticks } else { 0 });
        let place = match wait {
            Wait::There => to.y,
            Wait::Here => from.y,
            Wait::At(y) => y,
        };
        let y = [Shift::new([from.y, place], 1, moving), Shift::new([place, to.y], 1, moving).ended(ticks)];
        Self { ramp, ends, moves, ticks, x, y, c: Shift::new([from.c, to.c], 2, moving) }
    }

    /// The least ticks that a link between two states takes.
    pub(super) fn least(ends: [State; 2], moves: [bool; 2], moving: &Moving) -> u32 {
        let [from, to] = ends;
        let taken = |ends: [f64; 2], axis: usize| Shift::new(ends, axis, moving).ticks;
        let ramps: u32 = moves.iter().map(|&is_moving| if is_moving { moving.ramp.ticks } else { 0 }).sum();
        let along = ramps + taken(rests(ends, moves, &moving.ramp), 0);
        let knife = &moving.either.profile.knife;
        let rising = if moves[0] { periods(knife.lift() - knife.clear(), moving.period) } else { 0 };
        along.max(taken([from.y, to.y], 1)).max(taken([from.c, to.c], 2)).max(rising)
    }

    /// The least ticks that any link between two chains takes.
    pub(super) fn fewest(moving: &Moving) -> u32 {
        2 * moving.ramp.ticks
    }

    /// Whether there is time to wait where it does.
    pub(super) fn has_time(&self) -> bool {
        self.y[0].ticks + self.y[1].ticks <= self.ticks
    }

    /// Where the head is across the feed at a tick of it, mm.
    pub(super) fn y(&self, tick: u32) -> f64 {
        if tick < self.y[1].first { self.y[0].at(tick) } else { self.y[1].at(tick) }
    }

    /// Where the head is at a tick of it.
    pub(super) fn at(&self, tick: u32) -> State {
        let ramp = &self.ramp;
        let [from, to] = &self.ends;
        let xi = if self.moves[0] && tick < ramp.ticks {
            from.xi + ramp.down(tick)
        } else if self.moves[1] && tick + ramp.ticks > self.ticks {
            to.xi - ramp.way + ramp.up(tick + ramp.ticks - self.ticks)
        } else {
            self.x.at(tick)
        };
        State { xi, y: self.y(tick), c: self.c.at(tick) }
    }
}

/// Where the head rests along the feed behind its first ramp and before its last one.
fn rests([from, to]: [State; 2], moves: [bool; 2], ramp: &Ramp) -> [f64; 2] {
    let way = |is_moving: bool| if is_moving { ramp.way } else { 0.0 };
    [from.xi + way(moves[0]), to.xi - way(moves[1])]
}

/// Part of a period by which a duration may exceed a whole number of them: rounding.
const PERIOD_EPSILON: f64 = 1e-9;

/// The least number of periods that last so long, s.
fn periods(duration: f64, period: f64) -> u32 {
    (duration / period - PERIOD_EPSILON).ceil().max(0.0) as u32
}
