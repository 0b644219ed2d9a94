//! Legs along the path of the head: beside chords, through the bends of curves, around corners.

use std::f64::consts::PI;

use super::bend::Bend;
use super::course::{LEG_EPSILON, Leg, Node, Pace, Role};
use super::edge::Ring;
use super::offset::{Beside, Element};
use crate::geom::{Heading, Point, Vector, angle};

/// Permitted deviation of legs from an arc, mm; far below any tolerance.
const ARC_ACCURACY: f64 = 1e-3;
/// First step of a straight stretch from either end, mm, and the ratio of the distances that consecutive steps reach.
const FIRST_STEP: f64 = 10.0;
const STEP_GROWTH: f64 = 1.6;
/// Minimum speed of a head in a bay almost as tight as its distance, as a fraction of that of the jet.
const LEAST_SHARE: f64 = 0.05;

/// The legs along a closed path.
pub(super) fn legs(way: &[Element], rings: &[Ring], pace: &Pace) -> Vec<Leg> {
    let mut legs = Vec::new();
    for element in way {
        let (Beside::Chord { ring, .. } | Beside::Vertex { ring, .. }) = element.beside;
        let mut walk = Walk { ring: &rings[ring], pace, legs: &mut legs };
        match element.beside {
            Beside::Chord { chord, .. } => walk.beside_chord(chord, element.ends),
            Beside::Vertex { vertex, .. } => walk.around_vertex(vertex, element.ends),
        }
    }
    legs.retain(|leg| leg.length() > LEG_EPSILON);
    legs
}

/// State of a walk beside a ring that collects legs.
struct Walk<'a> {
    ring: &'a Ring,
    pace: &'a Pace,
    legs: &'a mut Vec<Leg>,
}

/// Properties common to all legs of an arc.
#[derive(Clone, Copy)]
struct Stretch {
    role: Role,
    speed: f64,
    block: u32,
}

impl Walk<'_> {
    /// Speed of the head in a bend, mm/s: that of the jet times 1 + distance x curvature.
    fn speed_in(&self, bend: &Bend) -> f64 {
        self.pace.edge_speed * (1.0 + self.pace.distance * bend.curvature).max(LEAST_SHARE)
    }

    /// Adds the legs beside a chord: a bend at its start, the straight part, a bend at its end.
    fn beside_chord(&mut self, chord: usize, ends: [Point; 2]) {
        let (ring, distance) = (self.ring, self.pace.distance);
        let [from, _] = ring.chord(chord);
        let (along, length) = (ring.along(chord), ring.length(chord));
        let outwards = Vector::new(along.y, -along.x) * distance;
        let [first, last] = ends.map(|point| (point - from).dot(&along));
        let ([_, begun], [ending, _]) = (ring.bends(chord), ring.bends(ring.behind(chord)));
        let bends = [begun.reach[1], length - ending.reach[0]];
        let node = |u: f64| {
            let aim = if u < bends[0] {
                begun.aim(begun.way(distance) - bends[0] + u, distance)
            } else if u > bends[1] {
                ending.aim(u - bends[1], distance)
            } else {
                ring.inwards(chord)
            };
            Node { at: from + along * u + outwards, aim }
        };
        let stations = [first, bends[0], bends[1], last].map(|u| u.clamp(first.min(last), last));
        let speeds = [self.speed_in(&begun), self.pace.edge_speed, self.speed_in(&ending)];
        let block = ring.spans[chord].block;
        for (ends, speed) in stations.windows(2).zip(speeds) {
            let leg = |[from, to]: [f64; 2]| Leg { ends: [node(from), node(to)], speed, role: Role::Edge, block };
            self.legs.extend(steps([ends[0], ends[1]]).into_iter().map(leg));
        }
    }

    /// Adds the legs around a vertex: amid a curve, or around a corner from the end of one curve to the start of the next.
    fn around_vertex(&mut self, vertex: usize, ends: [Point; 2]) {
        let (ring, distance) = (self.ring, self.pace.distance);
        let (centre, turn, before) = (ring.points[vertex], ring.turns[vertex], ring.before(vertex));
        // Angles count from the position of the head beside the end of the previous chord.
        let outwards = ring.inwards(before) + PI;
        let [from, to] = ends.map(|end| {
            let middle = outwards + 0.5 * turn;
            0.5 * turn + angle::wrap(Heading::of(end - centre).radians() - middle)
        });
        let at = |angle: f64, aim: f64| Node { at: centre + Heading::new(outwards + angle).unit() * distance, aim };
        let [ending, begun] = ring.bends(vertex);
        let in_bend = |bend: Bend, begins: f64| {
            move |angle: f64| at(angle, bend.aim(bend.reach[0] + distance * (angle - begins), distance))
        };
        let of_curve = |bend: &Bend, chord: usize| Stretch {
            role: Role::Edge,
            speed: self.speed_in(bend),
            block: ring.spans[chord].block,
        };
        let [curve_before, curve] = [of_curve(&ending, before), of_curve(&begun, vertex)];
        if !ring.is_corner(vertex) {
            self.arc([from, to], curve, &in_bend(begun, 0.0));
            return;
        }
        let corner = Stretch { role: Role::Corner, speed: self.pace.corner_speed, ..curve };
        let begins = turn - begun.turn;
        let [last, first] = [ending.turn, begins].map(|angle| angle.clamp(from.min(to), to));
        self.arc([from, last], curve_before, &in_bend(ending, 0.0));
        self.arc([last, first], corner, &|angle| at(angle, outwards + PI + angle));
        self.arc([first, to], curve, &in_bend(begun, begins));
    }

    /// Adds the legs of an arc between two angles.
    fn arc(&mut self, [from, to]: [f64; 2], stretch: Stretch, node: &dyn Fn(f64) -> Node) {
        let Stretch { role, speed, block } = stretch;
        let step = 2.0 * (1.0 - ARC_ACCURACY / self.pace.distance).clamp(-1.0, 1.0).acos();
        let count = ((to - from) / step).ceil().max(1.0);
        let place = |i: usize| node(from + (to - from) * i as f64 / count);
        self.legs.extend((0..count as usize).map(|i| Leg { ends: [place(i), place(i + 1)], speed, role, block }));
    }
}

/// Divides a straight stretch into steps that grow from both ends to the middle. Short steps at the ends confine a lowered
/// speed.
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
