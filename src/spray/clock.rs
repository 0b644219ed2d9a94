//! Timing of the head along its course: it follows the speeds that the edge asks for, with constant acceleration between them.

use super::course::{Leg, Node, Pace};
use crate::machine::{Job, Limits};

/// Maximum time step of the tabulated path, s.
const STEP_S: f64 = 1e-3;
/// Maximum distance between two places with a known speed, mm.
const STEP: f64 = 1.0;
/// Fraction of the axis limits that the clock uses. Polynomials between its places need more.
const SHARE: f64 = 0.5;

/// Limits of the axes and the period of the controller.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Drives {
    /// Limits of X, Y and C.
    pub(super) limits: [Limits; 3],
    /// Time between two setpoints, s.
    pub(super) period: f64,
}

impl Drives {
    /// The limits and the period of a job.
    pub(super) fn of(job: &Job) -> Self {
        Self { limits: job.profile.axes.limits(), period: job.profile.time.period() }
    }
}

/// The head at a time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Timed {
    /// Time from the start of the pass, s.
    pub(super) time: f64,
    /// Position and direction of the head.
    pub(super) node: Node,
    /// Index of the leg.
    pub(super) leg: usize,
}

/// Timing of a pass.
#[derive(Debug)]
pub(super) struct Clock<'a> {
    pass: &'a [Leg],
    /// Path lengths at equal time steps, mm.
    ways: Vec<f64>,
    /// Time step, s.
    step: f64,
    /// Path lengths up to the start of each leg and to the end of the last one, mm.
    stations: Vec<f64>,
    /// Time between two setpoints, s.
    period: f64,
}

impl<'a> Clock<'a> {
    /// The clock of a pass from rest to rest. It lasts a whole number of periods.
    ///
    /// The speed changes at a constant rate, so that it stays below every cap. The path is then averaged over the rise time of
    /// the acceleration, which removes the steps of the acceleration.
    pub(super) fn new(pass: &'a [Leg], pace: &Pace, drives: &Drives) -> Self {
        let Drives { limits, period } = *drives;
        let mut stations = vec![0.0];
        for leg in pass {
            stations.push(stations[stations.len() - 1] + leg.length());
        }
        let caps: Vec<f64> = pass.iter().map(|leg| cap(leg, &limits)).collect();
        let steady = steady(&stations, &caps, pace.reach.acceleration);
        let shares = (period / STEP_S).ceil().max(1.0);
        let step = period / shares;
        let whole = |time: f64| (time / period).ceil().max(1.0);
        let (lasts, rise) = (steady[steady.len() - 1][1], pace.reach.acceleration / pace.reach.jerk);
        let stretch = whole(lasts) * period / lasts;
        let (steps, mean) = ((whole(lasts) * shares) as usize, (whole(rise) * shares) as usize);
        let way = |i: usize| way_at(&steady, i as f64 * step / stretch);
        // The head rests before the start and after the end.
        let (mut sum, mut ways) = (0.0, vec![0.0]);
        for i in 1..=steps + mean {
            sum += way(i.min(steps)) - way(i.saturating_sub(mean));
            ways.push(sum / mean as f64);
        }
        Self { pass, ways, step, stations, period }
    }

    /// Duration of the pass, s.
    pub(super) fn duration(&self) -> f64 {
        (self.ways.len() - 1) as f64 * self.step
    }

    /// Duration of the pass in periods.
    pub(super) fn periods(&self) -> usize {
        (self.duration() / self.period).round() as usize
    }

    /// Time at a tick, s.
    pub(super) fn at_tick(&self, tick: usize) -> f64 {
        tick as f64 * self.period
    }

    /// Time at which the head reaches the start of a leg, s; for the number of legs, the end of the last one.
    pub(super) fn at_leg(&self, leg: usize) -> f64 {
        if leg == self.pass.len() {
            return self.duration();
        }
        let next = self.ways.partition_point(|&way| way < self.stations[leg]).min(self.ways.len() - 1);
        if next == 0 {
            return 0.0;
        }
        let [from, to] = [self.ways[next - 1], self.ways[next]];
        ((next - 1) as f64 + (self.stations[leg] - from) / (to - from)) * self.step
    }

    /// Position of the head at a time, s.
    pub(super) fn at(&self, time: f64) -> Timed {
        let last = self.ways.len() - 1;
        let before = ((time / self.step) as usize).min(last - 1);
        let share = (time / self.step - before as f64).clamp(0.0, 1.0);
        let way = self.ways[before] + (self.ways[before + 1] - self.ways[before]) * share;
        let leg = self.stations.partition_point(|&station| station <= way).clamp(1, self.pass.len()) - 1;
        let (start, length) = (self.stations[leg], self.pass[leg].length());
        Timed { time, node: self.pass[leg].at(((way - start) / length).clamp(0.0, 1.0)), leg }
    }
}

/// Path length, time and speed at close places, for the fastest motion under the caps with constant acceleration between
/// stations.
fn steady(stations: &[f64], caps: &[f64], acceleration: f64) -> Vec<[f64; 3]> {
    let mut places: Vec<[f64; 3]> = vec![[0.0; 3]];
    for (ends, &cap) in stations.windows(2).zip(caps) {
        let length = ends[1] - ends[0];
        let last = places.len() - 1;
        places[last][2] = places[last][2].min(cap);
        // Between two ends at rest there must be a place at which the head moves.
        let least = if caps.len() == 1 { 2.0 } else { 1.0 };
        let steps = (length / STEP).ceil().max(least) as usize;
        places.extend((1..=steps).map(|step| [ends[0] + length * step as f64 / steps as f64, 0.0, cap]));
    }
    let last = places.len() - 1;
    places[last][2] = 0.0;
    let gain = 2.0 * SHARE * acceleration;
    let reached = |places: &[[f64; 3]], from: usize, to: usize| {
        let way = (places[to][0] - places[from][0]).abs();
        places[to][2].min((places[from][2].powi(2) + gain * way).sqrt())
    };
    for i in 1..=last {
        places[i][2] = reached(&places, i - 1, i);
    }
    for i in (0..last).rev() {
        places[i][2] = reached(&places, i + 1, i);
    }
    for i in 1..=last {
        let way = places[i][0] - places[i - 1][0];
        places[i][1] = places[i - 1][1] + 2.0 * way / (places[i][2] + places[i - 1][2]);
    }
    places
}

/// Path length at a time, with constant acceleration between places.
fn way_at(places: &[[f64; 3]], time: f64) -> f64 {
    let next = places.partition_point(|place| place[1] <= time).clamp(1, places.len() - 1);
    let ([from, begins, before], [to, ends, after]) = (places[next - 1], places[next]);
    let share = ((time - begins) / (ends - begins)).clamp(0.0, 1.0);
    let mean = before + (after - before) * 0.5 * share;
    (from + mean * share * (ends - begins)).clamp(from, to)
}

/// Maximum speed of the head on a leg, mm/s: limited by the edge, the turn of the head and the axes.
fn cap(leg: &Leg, limits: &[Limits; 3]) -> f64 {
    let [x, y, c] = limits;
    let rate = ((leg.ends[1].aim - leg.ends[0].aim) / leg.length()).abs();
    let turning = c.speed * SHARE / rate;
    let bending = (x.acceleration.min(y.acceleration) * SHARE / rate).sqrt();
    leg.speed.min(turning).min(bending).min(x.speed.min(y.speed))
}
