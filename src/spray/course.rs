//! The course of the head: where it runs, which way it looks and how fast it may be, leg by leg.
//!
//! A vertex below the corner angle stands for a curve: half of the shorter chord on both sides of it is its bend, over which
//! the head turns evenly, and on which the curvature is the turn over the length of the bend.

use std::f64::consts::{PI, TAU};

use super::edge::Ring;
use super::offset::{Beside, Element};
use crate::geom::{Point, Vector, angle};

/// How far legs on an arc may be from it, mm: far below any tolerance.
const ARC_ACCURACY: f64 = 1e-3;
/// The first step of a straight stretch from either end, mm, and how much farther the next ones reach.
const FIRST_STEP: f64 = 10.0;
const STEP_GROWTH: f64 = 1.6;
/// Legs that are shorter are none, mm.
const LEG_EPSILON: f64 = 1e-7;
/// The least speed of a head in a bay that is nearly as tight as its distance, as a share of that of the jet.
const LEAST_SHARE: f64 = 0.05;

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
    /// To the edge, mm.
    pub(super) distance: f64,
    /// Of the jet along the edge, mm/s.
    pub(super) edge_speed: f64,
    /// Of the head around a corner, mm/s.
    pub(super) corner_speed: f64,
    /// What its axes can do.
    pub(super) reach: Reach,
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
    fn run_up(&self, speed: f64) -> f64 {
        RUN_UP_FACTOR * 0.5 * speed * (speed / self.acceleration + self.acceleration / self.jerk)
    }
}

/// The passes along all ways, the one that starts at the least x and y first.
pub(super) fn passes(ways: &[Vec<Element>], rings: &[Ring], corner: f64, pace: &Pace) -> Vec<Pass> {
    let mut closed: Vec<Pass> = ways.iter().map(|way| legs(way, rings, pace)).filter(|legs| !legs.is_empty()).collect();
    for way in &mut closed {
        let first = (0..way.len()).min_by(|&a, &b| from_origin(&way[a]).total_cmp(&from_origin(&way[b])));
        way.rotate_left(first.expect("a way has legs"));
    }
    closed.sort_by(|a, b| from_origin(&a[0]).total_cmp(&from_origin(&b[0])));
    closed.iter().flat_map(|way| parted(way, corner, pace)).collect()
}

/// What a start has least: the sum of its coordinates, mm.
fn from_origin(leg: &Leg) -> f64 {
    leg.ends[0].at.x + leg.ends[0].at.y
}

/// A closed way from rest to rest: parted where it has a corner itself, and led up to and away from where it starts.
fn parted(way: &[Leg], corner: f64, pace: &Pace) -> Vec<Pass> {
    let n = way.len();
    let stops: Vec<usize> = (0..n).filter(|&i| is_stop(&way[(i + n - 1) % n], &way[i], corner)).collect();
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

/// Whether the head must stop between two legs: its way has a corner.
fn is_stop(before: &Leg, behind: &Leg, corner: f64) -> bool {
    let [a, b] = [before, behind].map(|leg| leg.ends[1].at - leg.ends[0].at);
    angle::turn(a, b).abs() >= corner
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

/// The legs along a closed way.
fn legs(way: &[Element], rings: &[Ring], pace: &Pace) -> Vec<Leg> {
    let mut legs = Vec::new();
    for element in way {
        match element.beside {
            Beside::Chord { ring, chord } => beside_chord(&rings[ring], chord, element.ends, pace, &mut legs),
            Beside::Vertex { ring, vertex } => around_vertex(&rings[ring], vertex, element.ends, pace, &mut legs),
        }
    }
    legs.retain(|leg| leg.length() > LEG_EPSILON);
    legs
}

/// The speed of the head in the bend of a vertex, mm/s: that of the jet times 1 + distance x curvature.
fn speed_in_bend(ring: &Ring, vertex: usize, pace: &Pace) -> f64 {
    pace.edge_speed * (1.0 + pace.distance * ring.curvature(vertex)).max(LEAST_SHARE)
}

/// The direction at a way into the bend of a vertex, mm along the head's way from its middle.
fn aim_in_bend(ring: &Ring, vertex: usize, from_middle: f64, pace: &Pace) -> f64 {
    let (turn, [before, behind]) = (ring.turns[vertex], ring.bend(vertex));
    let arc = pace.distance * turn;
    let way = before + arc + behind;
    let share = if way > LEG_EPSILON { ((before + 0.5 * arc + from_middle) / way).clamp(0.0, 1.0) } else { 0.5 };
    ring.inwards(ring.before(vertex)) + turn * share
}

/// Along a chord: a bend at its start, what is straight, a bend at its end.
fn beside_chord(ring: &Ring, chord: usize, ends: [Point; 2], pace: &Pace, legs: &mut Vec<Leg>) {
    let [from, _] = ring.chord(chord);
    let (along, length) = (ring.along(chord), ring.length(chord));
    let end = (chord + 1) % ring.points.len();
    let outwards = Vector::new(along.y, -along.x) * pace.distance;
    let [first, last] = ends.map(|point| (point - from).dot(&along));
    let bends = [ring.bend(chord)[1], ring.bend(end)[0]];
    // Half of the way of the head around each vertex: where it turns outwards it is an arc, else the corner of two lines.
    let arcs = [chord, end].map(|vertex| 0.5 * pace.distance * ring.turns[vertex]);
    let node = |u: f64| {
        let aim = if u < bends[0] {
            aim_in_bend(ring, chord, arcs[0] + u, pace)
        } else if u > length - bends[1] {
            aim_in_bend(ring, end, -arcs[1] - (length - u), pace)
        } else {
            ring.inwards(chord)
        };
        Node { at: from + along * u + outwards, aim }
    };
    let stations = [first, bends[0], length - bends[1], last].map(|u| u.clamp(first.min(last), last));
    let straight = pace.edge_speed;
    let speeds = [
        if bends[0] > 0.0 { speed_in_bend(ring, chord, pace) } else { straight },
        straight,
        if bends[1] > 0.0 { speed_in_bend(ring, end, pace) } else { straight },
    ];
    for (ends, speed) in stations.windows(2).zip(speeds) {
        for [from, to] in steps([ends[0], ends[1]]) {
            let ends = [node(from), node(to)];
            legs.push(Leg { ends, speed, role: Role::Edge, block: ring.spans[chord].block });
        }
    }
}

/// A straight stretch in steps that grow from both ends to its middle: what a planner lowers near its ends is short.
fn steps([from, to]: [f64; 2]) -> Vec<[f64; 2]> {
    let half = 0.5 * (to - from);
    let growing = std::iter::successors(Some(FIRST_STEP), |reach| Some(reach * STEP_GROWTH));
    let reaches: Vec<f64> = growing.take_while(|&reach| reach < half).collect();
    let mut stations = vec![from];
    stations.extend(reaches.iter().map(|reach| from + reach));
    stations.extend(reaches.iter().rev().map(|reach| to - reach));
    stations.push(to);
    stations.windows(2).map(|ends| [ends[0], ends[1]]).collect()
}

/// Around a vertex.
fn around_vertex(ring: &Ring, vertex: usize, ends: [Point; 2], pace: &Pace, legs: &mut Vec<Leg>) {
    let centre = ring.points[vertex];
    let from = ends[0] - centre;
    let sweep = angle::turn(from, ends[1] - centre);
    let start = from.y.atan2(from.x);
    let step = 2.0 * (1.0 - ARC_ACCURACY / pace.distance).clamp(-1.0, 1.0).acos();
    let count = (sweep.abs() / step).ceil().max(1.0) as usize;
    let is_corner = ring.is_corner(vertex);
    // Seen from the vertex, the first chord's head stands here.
    let outwards = ring.inwards(ring.before(vertex)) + PI;
    let node = |i: usize| {
        let at = start + sweep * i as f64 / count as f64;
        let (sin, cos) = at.sin_cos();
        let aim = if is_corner {
            at + PI
        } else {
            let into = angle::wrap(at - outwards) - 0.5 * ring.turns[vertex];
            aim_in_bend(ring, vertex, pace.distance * into, pace)
        };
        Node { at: centre + Vector::new(cos, sin) * pace.distance, aim }
    };
    let (role, speed) =
        if is_corner { (Role::Corner, pace.corner_speed) } else { (Role::Edge, speed_in_bend(ring, vertex, pace)) };
    for i in 0..count {
        legs.push(Leg { ends: [node(i), node(i + 1)], speed, role, block: ring.spans[vertex].block });
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
