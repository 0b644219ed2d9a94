//! Course of the head: its position, direction and speed, leg by leg.

use std::f64::consts::TAU;

use crate::geom::{Point, angle};
use crate::machine::Job;

/// Length below which a leg is dropped, mm.
pub(super) const LEG_EPSILON: f64 = 1e-7;
/// Task of the head on a leg.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Role {
    /// The jet moves along an edge.
    Edge,
    /// The jet stays at a corner of the part, around which the head moves.
    Corner,
    /// The head speeds up or slows down with the jet off.
    Air,
}

/// Position and direction of the head.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Node {
    /// Position of the head, mm.
    pub(super) at: Point,
    /// Direction to the edge, rad, unwrapped along a pass.
    pub(super) aim: f64,
}

/// A short straight part of the course.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Leg {
    /// Start and end.
    pub(super) ends: [Node; 2],
    /// Target speed of the head, mm/s: at an edge, the one at which the jet has its own speed; at a corner, that of corners.
    pub(super) speed: f64,
    /// Task of the head.
    pub(super) role: Role,
    /// Block of the file that drew the edge.
    pub(super) block: u32,
}

impl Leg {
    /// Length, mm.
    pub(super) fn length(&self) -> f64 {
        (self.ends[1].at - self.ends[0].at).norm()
    }

    /// The node at a fraction of the leg.
    pub(super) fn at(&self, share: f64) -> Node {
        let [from, to] = self.ends;
        Node { at: from.at + (to.at - from.at) * share, aim: from.aim + (to.aim - from.aim) * share }
    }

    /// The part of the leg between two fractions.
    fn part(&self, from: f64, to: f64) -> Self {
        Self { ends: [self.at(from), self.at(to)], ..*self }
    }
}

/// Legs from rest to rest.
pub(super) type Pass = Vec<Leg>;

/// Distance and speeds of the head.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Pace {
    /// Minimum turn of a corner, rad.
    pub(super) corner: f64,
    /// Permitted error of the direction of the head, rad.
    pub(super) askew: f64,
    /// Distance from the head to the edge, mm.
    pub(super) distance: f64,
    /// Speed of the jet along the edge, mm/s.
    pub(super) edge_speed: f64,
    /// Speed of the head around a corner, mm/s.
    pub(super) corner_speed: f64,
    /// Limits of the axes along any direction.
    pub(super) reach: Reach,
}

impl Pace {
    /// The distance and the speeds of a job.
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

/// Limits of the axes along any direction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Reach {
    /// Maximum acceleration, mm/s2.
    pub(super) acceleration: f64,
    /// Maximum jerk, mm/s3.
    pub(super) jerk: f64,
}

/// Ratio of a run-up to its closed form. The path may bend, and the axes share it.
const RUN_UP_FACTOR: f64 = 1.5;

impl Reach {
    /// Length of path over which a head reaches a speed from rest, mm: half the speed times the time that acceleration and jerk
    /// take.
    pub(super) fn run_up(&self, speed: f64) -> f64 {
        RUN_UP_FACTOR * 0.5 * speed * (speed / self.acceleration + self.acceleration / self.jerk)
    }
}

/// All passes of a head, and the tolerance of their planner.
#[derive(Debug)]
pub(super) struct Course {
    /// Passes in order.
    pub(super) passes: Vec<Pass>,
    /// Distance and speeds.
    pub(super) pace: Pace,
    /// Permitted deviation of a planner from the course, mm.
    pub(super) tolerance: f64,
}

/// The passes along the legs of closed paths. The path with the start nearest to the origin, by x + y, comes first.
pub(super) fn passes(mut ways: Vec<Vec<Leg>>, pace: &Pace) -> Vec<Pass> {
    for way in &mut ways {
        let first = (0..way.len()).min_by(|&a, &b| from_origin(&way[a]).total_cmp(&from_origin(&way[b])));
        way.rotate_left(first.expect("a way has legs"));
    }
    ways.sort_by(|a, b| from_origin(&a[0]).total_cmp(&from_origin(&b[0])));
    ways.iter().flat_map(|way| parted(way, pace)).collect()
}

/// Sum of the coordinates of the start, mm. The path with the least sum comes first.
fn from_origin(leg: &Leg) -> f64 {
    leg.ends[0].at.x + leg.ends[0].at.y
}

/// The passes of a closed path, each from rest to rest. The path is parted at its own corners; its start gets a lead-in and a
/// lead-out.
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
        // On a path without stops both may run all the way round. Otherwise each ends at the nearest stop.
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

/// A leg in reverse.
fn turned(leg: Leg) -> Leg {
    Leg { ends: [leg.ends[1], leg.ends[0]], ..leg }
}

/// The first `length` mm of legs, with the jet off.
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

/// True if the head must stop between two legs: its path has a corner, or its direction jumps.
fn is_stop(before: &Leg, behind: &Leg, pace: &Pace) -> bool {
    let [a, b] = [before, behind].map(|leg| leg.ends[1].at - leg.ends[0].at);
    let jump = angle::wrap(behind.ends[0].aim - before.ends[1].aim);
    angle::turn(a, b).abs() >= pace.corner || jump.abs() >= pace.askew
}

/// Makes the directions of a pass continuous from leg to leg.
fn unwrap(pass: &mut Pass) {
    let mut last = pass[0].ends[0].aim;
    for leg in pass {
        for node in &mut leg.ends {
            node.aim -= TAU * ((node.aim - last) / TAU).round();
            last = node.aim;
        }
    }
}

/// Consecutive legs with the same task.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Stretch {
    /// Range of the legs.
    pub(super) legs: std::ops::Range<usize>,
    /// Task of the head.
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
