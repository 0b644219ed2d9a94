//! The course of the head: where it runs, which way it looks and how fast it may be, leg by leg.

use std::f64::consts::TAU;

use crate::geom::{Point, angle};
use crate::machine::Job;

/// Legs that are shorter are none, mm.
pub(super) const LEG_EPSILON: f64 = 1e-7;
/// What the head does on a leg.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Role {
    /// The jet goes along an edge.
    Edge,
    /// The jet stands on a corner of the part, around which the head goes.
    Corner,
    /// The head gathers speed or comes to rest, without a jet.
    Air,
}

/// Where the head is, and which way it looks.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Node {
    /// The head, mm.
    pub(super) at: Point,
    /// Direction to the edge, rad, unwrapped along a pass.
    pub(super) aim: f64,
}

/// A short straight part of the course.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Leg {
    /// Its ends.
    pub(super) ends: [Node; 2],
    /// The speed of the head at which the jet has its own, or that of a corner, mm/s.
    pub(super) speed: f64,
    /// What the head does there.
    pub(super) role: Role,
    /// The block of the file that drew the edge.
    pub(super) block: u32,
}

impl Leg {
    /// Its length, mm.
    pub(super) fn length(&self) -> f64 {
        (self.ends[1].at - self.ends[0].at).norm()
    }

    /// The node at a share of it.
    pub(super) fn at(&self, share: f64) -> Node {
        let [from, to] = self.ends;
        Node { at: from.at + (to.at - from.at) * share, aim: from.aim + (to.aim - from.aim) * share }
    }

    /// The part of it between two shares.
    fn part(&self, from: f64, to: f64) -> Self {
        Self { ends: [self.at(from), self.at(to)], ..*self }
    }
}

/// What the head does from rest to rest.
pub(super) type Pass = Vec<Leg>;

/// Distance and speeds of the head.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Pace {
    /// The least turn of a corner, rad.
    pub(super) corner: f64,
    /// How far the head may look askew, rad.
    pub(super) askew: f64,
    /// To the edge, mm.
    pub(super) distance: f64,
    /// Of the jet along the edge, mm/s.
    pub(super) edge_speed: f64,
    /// Of the head around a corner, mm/s.
    pub(super) corner_speed: f64,
    /// What its axes can do.
    pub(super) reach: Reach,
}

impl Pace {
    /// That of a job.
    pub(super) fn of(job: &Job) -> Self {
        let tool = &job.profile.tool;
        let [x, y, _] = job.profile.axes.limits();
        Self {
            corner: job.profile.corner_angle(),
            askew: job.profile.verify.max_heading_deg.to_radians(),
            distance: tool.distance_mm,
            edge_speed: tool.edge_speed_mm_s,
            corner_speed: tool.corner_speed_mm_s,
            reach: Reach { acceleration: x.acceleration.min(y.acceleration), jerk: x.jerk.min(y.jerk) },
        }
    }
}

/// What the axes can do along any direction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Reach {
    /// mm/s2.
    pub(super) acceleration: f64,
    /// mm/s3.
    pub(super) jerk: f64,
}

/// How much longer a run-up is than its closed form asks: the way may bend, and axes share it.
const RUN_UP_FACTOR: f64 = 1.5;

impl Reach {
    /// The way on which a head comes from rest to a speed, mm: half of it for the time that acceleration and jerk take.
    pub(super) fn run_up(&self, speed: f64) -> f64 {
        RUN_UP_FACTOR * 0.5 * speed * (speed / self.acceleration + self.acceleration / self.jerk)
    }
}

/// All that a head does, and how near to it a planner stays.
#[derive(Debug)]
pub(super) struct Course {
    /// In order.
    pub(super) passes: Vec<Pass>,
    /// Its distance and speeds.
    pub(super) pace: Pace,
    /// How far from the course a planner may be, mm.
    pub(super) tolerance: f64,
}

/// The passes along the legs of closed ways, the one that starts at the least x and y first.
pub(super) fn passes(mut ways: Vec<Vec<Leg>>, pace: &Pace) -> Vec<Pass> {
    for way in &mut ways {
        let first = (0..way.len()).min_by(|&a, &b| from_origin(&way[a]).total_cmp(&from_origin(&way[b])));
        way.rotate_left(first.expect("a way has legs"));
    }
    ways.sort_by(|a, b| from_origin(&a[0]).total_cmp(&from_origin(&b[0])));
    ways.iter().flat_map(|way| parted(way, pace)).collect()
}

/// What a start has least: the sum of its coordinates, mm.
fn from_origin(leg: &Leg) -> f64 {
    leg.ends[0].at.x + leg.ends[0].at.y
}

/// A closed way from rest to rest: parted where it has a corner itself, and led up to and away from where it starts.
fn parted(way: &[Leg], pace: &Pace) -> Vec<Pass> {
    let n = way.len();
    let stops: Vec<usize> = (0..n).filter(|&i| is_stop(&way[(i + n - 1) % n], &way[i], pace)).collect();
    let mut passes: Vec<Pass> = Vec::new();
    let mut from = 0;
    for to in stops.iter().copied().filter(|&stop| stop > 0).chain([n]) {
        passes.push(way[from..to].to_vec());
        from = to;
    }
    if stops.first() != Some(&0) {
        let last = passes.len() - 1;
        let [up, out] = [way[0].speed, way[n - 1].speed].map(|speed| pace.reach.run_up(speed));
        // On a way without stops both may lead around it; else each ends at the nearest stop.
        let behind = stops.first().map_or(n, |&stop| stop);
        let before = stops.last().map_or(n, |&stop| n - stop);
        let lead_in = air(way[n - before..].iter().rev().copied().map(turned), up);
        let lead_in = lead_in.into_iter().rev().map(turned);
        passes[last].extend(air(way[..behind].iter().copied(), out));
        passes[0].splice(0..0, lead_in);
    }
    for pass in &mut passes {
        unwrap(pass);
    }
    passes
}

/// A leg the other way round.
fn turned(leg: Leg) -> Leg {
    Leg { ends: [leg.ends[1], leg.ends[0]], ..leg }
}

/// The first legs that are so long together, without a jet.
fn air(legs: impl Iterator<Item = Leg>, length: f64) -> Vec<Leg> {
    let mut left = length;
    let mut taken = Vec::new();
    for leg in legs {
        if left <= LEG_EPSILON {
            break;
        }
        let share = (left / leg.length()).min(1.0);
        taken.push(Leg { role: Role::Air, ..leg.part(0.0, share) });
        left -= leg.length();
    }
    taken
}

/// Whether the head must stop between two legs: its way has a corner, or it looks elsewhere all at once.
fn is_stop(before: &Leg, behind: &Leg, pace: &Pace) -> bool {
    let [a, b] = [before, behind].map(|leg| leg.ends[1].at - leg.ends[0].at);
    let jump = angle::wrap(behind.ends[0].aim - before.ends[1].aim);
    angle::turn(a, b).abs() >= pace.corner || jump.abs() >= pace.askew
}

/// Makes the directions of a pass go on from leg to leg.
fn unwrap(pass: &mut Pass) {
    let mut last = pass[0].ends[0].aim;
    for leg in pass {
        for node in &mut leg.ends {
            node.aim -= TAU * ((node.aim - last) / TAU).round();
            last = node.aim;
        }
    }
}

/// Legs in a row on which the head does the same.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Stretch {
    /// The first, and the one behind the last.
    pub(super) legs: std::ops::Range<usize>,
    /// What it does.
    pub(super) role: Role,
}

/// The stretches of a pass.
pub(super) fn stretches(pass: &[Leg]) -> Vec<Stretch> {
    let mut stretches: Vec<Stretch> = Vec::new();
    for (i, leg) in pass.iter().enumerate() {
        match stretches.last_mut() {
            Some(last) if last.role == leg.role => last.legs.end = i + 1,
            Some(_) | None => stretches.push(Stretch { legs: i..i + 1, role: leg.role }),
        }
    }
    stretches
}
