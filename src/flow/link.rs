//! Motion of a head between two chains, before the first and after the last one: it slows down from the speed of the cloth to
//! rest, travels over the table, and speeds up again. The knife is up throughout.

use super::moving::Moving;
use super::ramp::Ramp;
use crate::machine::kinematics::Move;

/// Position of a head: x and y, mm, and C, rad.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct State {
    /// Position along the feed from the station, mm.
    pub xi: f64,
    /// Position across the feed, mm.
    pub y: f64,
    /// Position of C, rad.
    pub c: f64,
}

/// Position across the feed in which a head waits between two chains.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Wait {
    /// At the start of the next chain.
    #[default]
    There,
    /// At the end of the previous chain.
    Here,
    /// At another place, out of the way of other heads, mm.
    At(f64),
}

/// Move of an axis from one position to another, at rest before and after it.
#[derive(Debug, Clone, Copy)]
struct Shift {
    from: f64,
    to: f64,
    way: Move,
    /// First tick of the move, and its duration in ticks.
    first: u32,
    ticks: u32,
}

impl Shift {
    fn new([from, to]: [f64; 2], axis: usize, moving: &Moving) -> Self {
        let way = Move::new((to - from).abs(), moving.rapid[axis]);
        Self { from, to, way, first: 0, ticks: periods(way.duration(), moving.period) }
    }

    /// The move with its start at a tick.
    fn begun(self, first: u32) -> Self {
        Self { first, ..self }
    }

    /// The move with its end at a tick.
    fn ended(self, last: u32) -> Self {
        Self { first: last.saturating_sub(self.ticks), ..self }
    }

    fn at(&self, tick: u32) -> f64 {
        let done = self.way.at(f64::from(tick.saturating_sub(self.first)), f64::from(self.ticks.max(1)));
        self.from + done.copysign(self.to - self.from)
    }
}

/// Boundary conditions of a link.
#[derive(Debug, Clone, Copy)]
pub(super) struct Gap {
    pub(super) ends: [State; 2],
    /// True at the start and at the end, respectively, if the head moves with the cloth there.
    pub(super) moves: [bool; 2],
    pub(super) wait: Wait,
}

/// Motion of a head between two chains.
#[derive(Debug, Clone, Copy)]
pub(super) struct Link {
    ramp: Ramp,
    ends: [State; 2],
    /// True at the start and at the end, respectively, if the head moves with the cloth there.
    moves: [bool; 2],
    pub(super) ticks: u32,
    x: Shift,
    /// Moves to the waiting position and on from it.
    y: [Shift; 2],
    c: Shift,
}

impl Link {
    /// The link over a gap of the given duration in ticks.
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

    /// Minimum duration of a link between two states, in ticks.
    pub(super) fn least(ends: [State; 2], moves: [bool; 2], moving: &Moving) -> u32 {
        let [from, to] = ends;
        let taken = |ends: [f64; 2], axis: usize| Shift::new(ends, axis, moving).ticks;
        let ramps: u32 = moves.iter().map(|&is_moving| if is_moving { moving.ramp.ticks } else { 0 }).sum();
        let along = ramps + taken(rests(ends, moves, &moving.ramp), 0);
        let knife = &moving.either.profile.knife;
        let rising = if moves[0] { periods(knife.lift() - knife.clear(), moving.period) } else { 0 };
        along.max(taken([from.y, to.y], 1)).max(taken([from.c, to.c], 2)).max(rising)
    }

    /// Lower bound on the duration of any link between two chains, in ticks.
    pub(super) fn fewest(moving: &Moving) -> u32 {
        2 * moving.ramp.ticks
    }

    /// True if both moves across the feed fit into the duration.
    pub(super) fn has_time(&self) -> bool {
        self.y[0].ticks + self.y[1].ticks <= self.ticks
    }

    /// Position across the feed at a tick of the link, mm.
    pub(super) fn y(&self, tick: u32) -> f64 {
        if tick < self.y[1].first { self.y[0].at(tick) } else { self.y[1].at(tick) }
    }

    /// State of the head at a tick of the link.
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

/// Positions along the feed at which the head rests after its first and before its last ramp, mm.
fn rests([from, to]: [State; 2], moves: [bool; 2], ramp: &Ramp) -> [f64; 2] {
    let way = |is_moving: bool| if is_moving { ramp.way } else { 0.0 };
    [from.xi + way(moves[0]), to.xi - way(moves[1])]
}

/// Excess over a whole number of periods, as a fraction of a period, that counts as rounding.
const PERIOD_EPSILON: f64 = 1e-9;

/// Minimum number of periods that cover a duration, s.
fn periods(duration: f64, period: f64) -> u32 {
    (duration / period - PERIOD_EPSILON).ceil().max(0.0) as u32
}
