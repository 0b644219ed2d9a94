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
    fn at(&self, tick: u32) -> f64 {
        let done = self.way.at(f64::from(tick.saturating_sub(self.first)), f64::from(self.ticks.max(1)));
        self.from + done.copysign(self.to - self.from)
    }
}

/// What a head does between two chains.
#[derive(Debug, Clone, Copy)]
pub(super) struct Link {
    ramp: Ramp,
    from: State,
    to: State,
    /// Whether it moves with the cloth at its start, and at its end.
    moving: [bool; 2],
    pub(super) ticks: u32,
    axes: [Shift; 3],
}

/// When an axis of a link moves.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum When {
    /// As soon as it can.
    AtOnce,
    /// So that it arrives when it must.
    InTime,
}

impl Link {
    /// The link between two states that takes so many ticks.
    pub(super) fn new([from, to]: [State; 2], moves: [bool; 2], ticks: u32, when: When, moving: &Moving) -> Self {
        let ramp = moving.ramp;
        let [start, end] = rests([from, to], moves, &ramp);
        let [before, behind] = moves.map(|is_moving| if is_moving { ramp.ticks } else { 0 });
        let shift = |axis: usize, from: f64, to: f64, [before, behind]: [u32; 2]| {
            let way = Move::new((to - from).abs(), moving.rapid[axis]);
            let taken = periods(way.duration(), moving.period);
            let first = match when {
                When::AtOnce => before,
                When::InTime => ticks.saturating_sub(behind + taken),
            };
            Shift { from, to, way, first, ticks: taken }
        };
        let axes = [
            shift(0, start, end, [before, behind]),
            shift(1, from.y, to.y, [0; 2]),
            shift(2, from.c, to.c, [0; 2]),
        ];
        Self { ramp, from, to, moving: moves, ticks, axes }
    }

    /// The least ticks that a link between two states takes.
    pub(super) fn least([from, to]: [State; 2], moves: [bool; 2], moving: &Moving) -> u32 {
        let [start, end] = rests([from, to], moves, &moving.ramp);
        let taken = |axis: usize, way: f64| periods(Move::new(way.abs(), moving.rapid[axis]).duration(), moving.period);
        let ramps: u32 = moves.iter().map(|&is_moving| if is_moving { moving.ramp.ticks } else { 0 }).sum();
        let along = ramps + taken(0, end - start);
        let knife = &moving.either.profile.knife;
        let rising = if moves[0] { periods(knife.lift() - knife.clear(), moving.period) } else { 0 };
        along.max(taken(1, to.y - from.y)).max(taken(2, to.c - from.c)).max(rising)
    }

    /// Where the head is at a tick of it.
    pub(super) fn at(&self, tick: u32) -> State {
        let [x, y, c] = &self.axes;
        let ramp = &self.ramp;
        let xi = if self.moving[0] && tick < ramp.ticks {
            self.from.xi + ramp.down(tick)
        } else if self.moving[1] && tick + ramp.ticks > self.ticks {
            self.to.xi - ramp.way + ramp.up(tick + ramp.ticks - self.ticks)
        } else {
            x.at(tick)
        };
        State { xi, y: y.at(tick), c: c.at(tick) }
    }
}

/// Where the head rests along the feed behind its first ramp and before its last one.
fn rests([from, to]: [State; 2], moves: [bool; 2], ramp: &Ramp) -> [f64; 2] {
    let way = |is_moving: bool| if is_moving { ramp.way } else { 0.0 };
    [from.xi + way(moves[0]), to.xi - way(moves[1])]
}

/// The least number of periods that last so long, s.
pub(super) fn periods(duration: f64, period: f64) -> u32 {
    /// Part of a period by which a duration may exceed a whole number of them: rounding.
    const PERIOD_EPSILON: f64 = 1e-9;
    (duration / period - PERIOD_EPSILON).ceil().max(0.0) as u32
}
