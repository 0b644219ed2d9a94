//! A polyline as few arcs and lines that meet without a kink, inside its tube.
//!
//! Between two places with known directions lies a biarc: two arcs of one tangent where they meet (K. M. Bolton,
//! *Biarc curves*, Computer-Aided Design 7, 1975; here with tangents of equal length at both ends). The places are
//! the middles of chords, where the direction of the curve is that of the chord, and the shoulders of bends that a
//! rounding takes inside the tube. From each place the farthest one is taken whose biarc stays in the tube.

use super::tube::Tube;
use crate::geom::{Point, Vector, angle, cross};

/// Part of the tolerance that the fit may use: the rest is for decimals and for what lies between samples.
const SHARE: f64 = 0.92;
/// Part of the tolerance that a bend alone is rounded by.
const ROUNDING_SHARE: f64 = 0.75;
/// Smaller turns need no shoulder of their own, rad.
const TURN_EPSILON: f64 = 1e-9;
/// Greatest turn of an arc, rad: controllers confuse the ways of longer ones.
const SWEEP_MAX: f64 = 2.8;
/// Least scalar product of the directions at both ends of a biarc.
const OPPOSED: f64 = -0.7;
/// An arc that leaves its chord by less is a line, mm.
const LINE_EPSILON: f64 = 1e-5;
/// Two arcs whose directions at the end differ by less than this from that of one arc through both ends are one, rad.
const SAME_EPSILON: f64 = 2e-4;
/// Samples a chord.
const SAMPLES: usize = 4;
/// Lengths below this are none, mm.
const LENGTH_EPSILON: f64 = 1e-9;

/// An arc, or a line when its curvature is 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Arc {
    /// Where it starts.
    pub(super) from: Point,
    /// Unit vector along it there.
    pub(super) along: Vector,
    /// Its length, mm.
    pub(super) length: f64,
    /// Left positive, per mm.
    pub(super) curvature: f64,
    /// The last chord that it lies beside.
    pub(super) chord: usize,
}

impl Arc {
    /// The arc from a point and direction through another point; `None` when it would turn too far.
    fn through(from: Point, along: Vector, to: Point) -> Option<Self> {
        let way = to - from;
        let chord = way.norm();
        if chord < LENGTH_EPSILON {
            return None;
        }
        let half = angle::turn(along, way);
        if 2.0 * half.abs() > SWEEP_MAX {
            return None;
        }
        if chord * half.abs() / 4.0 < LINE_EPSILON {
            return Some(Self { from, along: way / chord, length: chord, curvature: 0.0, chord: 0 });
        }
        let length = chord * half / half.sin();
        Some(Self { from, along, length, curvature: 2.0 * half / length, chord: 0 })
    }

    /// How far it turns, rad.
    pub(super) fn turn(&self) -> f64 {
        self.curvature * self.length
    }

    /// Unit vector along it at a length.
    pub(super) fn along_at(&self, s: f64) -> Vector {
        let (sin, cos) = (self.curvature * s).sin_cos();
        Vector::new(self.along.x * cos - self.along.y * sin, self.along.x * sin + self.along.y * cos)
    }

    /// The point at a length.
    pub(super) fn at(&self, s: f64) -> Point {
        let half = 0.5 * self.curvature * s;
        let chord = if half == 0.0 { s } else { s * half.sin() / half };
        let (sin, cos) = half.sin_cos();
        self.from
            + Vector::new(self.along.x * cos - self.along.y * sin, self.along.x * sin + self.along.y * cos) * chord
    }

    /// Distance from a point to it, mm.
    fn distance(&self, point: Point) -> f64 {
        let away = point - self.from;
        let ahead = away.dot(&self.along);
        let end = self.at(self.length);
        let ends = away.norm().min((point - end).norm());
        let side = cross(self.along, away);
        if self.curvature == 0.0 {
            return if (0.0..=self.length).contains(&ahead) { side.abs() } else { ends };
        }
        let radius = 1.0 / self.curvature;
        let around = (ahead * self.curvature.signum()).atan2((radius - side) * self.curvature.signum());
        let turned = around * self.curvature.signum();
        let is_beside = turned >= 0.0 && turned <= self.turn().abs()
            || (self.turn() * turned >= 0.0 && turned.abs() <= self.turn().abs());
        // (ahead, radius - side) is the place as seen from the centre.
        if is_beside { (ahead.hypot(radius - side) - radius.abs()).abs() } else { ends }
    }
}

/// A place that an arc may start or end at.
#[derive(Debug, Clone, Copy)]
struct Node {
    at: Point,
    along: Vector,
    station: f64,
    /// The chord that it lies on.
    chord: usize,
}

/// The ends of a way: a direction where it starts and one where it ends, unit vectors.
#[derive(Debug, Clone, Copy)]
pub(super) struct Ends {
    pub(super) start: Vector,
    pub(super) end: Vector,
}

/// The arcs along a tube; otherwise the point at which none stays inside.
pub(super) fn fit(tube: &Tube, ends: Ends) -> Result<Vec<Arc>, Point> {
    let nodes = nodes(tube, ends);
    let mut arcs = Vec::new();
    let mut i = 0;
    while i + 1 < nodes.len() {
        let try_to = |j: usize| biarc(tube, &nodes[i], &nodes[j]);
        let mut best: Option<(usize, Found)> = None;
        let (mut step, mut bad) = (1, nodes.len());
        // Twice as far each time, then halving between what fits and what does not.
        while i + step < bad {
            match try_to(i + step) {
                Some(found) => best = Some((i + step, found)),
                None if best.is_none() && step < FIRST_TRIES => {
                    step += 1;
                    continue;
                }
                None => {
                    bad = i + step;
                    break;
                }
            }
            step *= 2;
        }
        let Some((mut good, mut found)) = best else { return Err(nodes[i].at) };
        while bad - good > 1 {
            let middle = usize::midpoint(good, bad);
            match try_to(middle) {
                Some(next) => (good, found) = (middle, next),
                None => bad = middle,
            }
        }
        arcs.extend(found.into_iter().flatten());
        i = good;
    }
    Ok(arcs)
}

/// Neighbouring places that are tried when the next one cannot be reached.
const FIRST_TRIES: usize = 4;

type Found = [Option<Arc>; 2];

/// The places along a tube.
fn nodes(tube: &Tube, ends: Ends) -> Vec<Node> {
    let last = tube.chords();
    let mut nodes = vec![Node { at: tube.points[0], along: ends.start, station: 0.0, chord: 0 }];
    // A bend of turn t whose rounding touches both chords a way w off its vertex leaves the vertex by w tan(t / 4).
    let shoulder = |vertex: usize| {
        let turn = tube.turns[vertex].abs();
        if turn < TURN_EPSILON { f64::INFINITY } else { ROUNDING_SHARE * tube.tolerance / (turn / 4.0).tan() }
    };
    for chord in 0..last {
        let (a, length) = (tube.points[chord], tube.stations[chord + 1] - tube.stations[chord]);
        let along = tube.direction(chord);
        let place = |way: f64, aside: Vector| Node {
            at: a + along * way + aside,
            along,
            station: tube.stations[chord] + way,
            chord,
        };
        let (before, behind) = (shoulder(chord), shoulder(chord + 1));
        let is_first = chord == 0;
        let is_last = chord + 1 == last;
        if before < 0.45 * length && !is_first {
            nodes.push(place(before, Vector::zeros()));
        }
        nodes.push(place(0.5 * length, tube.bulges[chord]));
        if behind < 0.45 * length && !is_last {
            nodes.push(place(length - behind, Vector::zeros()));
        }
    }
    let end = tube.stations[last];
    nodes.push(Node { at: tube.points[last], along: ends.end, station: end, chord: last - 1 });
    nodes
}

/// The arcs between two places, when they stay in the tube.
fn biarc(tube: &Tube, from: &Node, to: &Node) -> Option<Found> {
    let way = to.at - from.at;
    let (t0, t1) = (from.along, to.along);
    let dot = t0.dot(&t1);
    if dot < OPPOSED || way.dot(&(t0 + t1)) <= 0.0 {
        return None;
    }
    if let Some(one) = Arc::through(from.at, t0, to.at)
        && angle::turn(one.along_at(one.length), t1).abs() + angle::turn(t0, one.along).abs() < SAME_EPSILON
    {
        let arcs = [Some(Arc { chord: to.chord, ..one }), None];
        return stays(tube, &arcs, from, to).then_some(arcs);
    }
    let ahead = way.dot(&(t0 + t1));
    let open = 2.0 * (1.0 - dot);
    let reach = if open < 1e-12 {
        way.norm_squared() / (2.0 * ahead)
    } else {
        (-ahead + (ahead * ahead + open * way.norm_squared()).sqrt()) / open
    };
    let middle = from.at + ((way) + (t0 - t1) * reach) * 0.5;
    let first = Arc::through(from.at, t0, middle)?;
    let meet = first.along_at(first.length);
    let second = Arc::through(middle, meet, to.at)?;
    let station = f64::midpoint(from.station, to.station);
    let chord = tube.stations.partition_point(|&s| s <= station).clamp(1, tube.chords()) - 1;
    let arcs = [Some(Arc { chord, ..first }), Some(Arc { chord: to.chord, ..second })];
    stays(tube, &arcs, from, to).then_some(arcs)
}

/// Whether arcs stay in the tube: their places beside each chord, and each vertex that they pass.
fn stays(tube: &Tube, arcs: &Found, from: &Node, to: &Node) -> bool {
    let allowed = SHARE * tube.tolerance;
    let total: f64 = arcs.iter().flatten().map(|arc| arc.length).sum();
    let stretch = total / (to.station - from.station);
    let place = |mut s: f64| {
        for arc in arcs.iter().flatten() {
            if s <= arc.length {
                return arc.at(s);
            }
            s -= arc.length;
        }
        to.at
    };
    let mut chord = from.chord;
    for beside in from.chord..=to.chord {
        let low = tube.stations[beside].max(from.station);
        let high = tube.stations[beside + 1].min(to.station);
        if beside > from.chord {
            let vertex = tube.points[beside];
            let nearest = arcs.iter().flatten().map(|arc| arc.distance(vertex)).fold(f64::INFINITY, f64::min);
            if nearest > allowed {
                return false;
            }
        }
        for i in 0..SAMPLES {
            let station = low + (high - low) * (i as f64 + 0.5) / SAMPLES as f64;
            let at = place((station - from.station) * stretch);
            // The station only says about where the place is: it may lie beside a neighbour.
            let mut near = chord.min(beside);
            if tube.deviation(at, &mut near) > allowed {
                return false;
            }
            chord = chord.max(beside.saturating_sub(1));
        }
    }
    true
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::machine::MachineProfile;

    fn fitted(points: Vec<Point>) -> Vec<Arc> {
        let tube = Tube::new(points, 0.05, &MachineProfile::default());
        let ends = Ends { start: tube.direction(0), end: tube.direction(tube.chords() - 1) };
        let arcs = fit(&tube, ends).expect("it fits");
        for pair in arcs.windows(2) {
            assert!((pair[0].at(pair[0].length) - pair[1].from).norm() < 1e-9, "no gap");
            let kink = angle::turn(pair[0].along_at(pair[0].length), pair[1].along).abs();
            assert!(kink < 3.0 * SAME_EPSILON, "no kink: {kink}");
        }
        arcs
    }

    #[test]
    fn a_flattened_circle_is_few_arcs_again() {
        let around = |i: i32| f64::from(i) * std::f64::consts::TAU / 40.0;
        let arcs = fitted((0..=40).map(|i| Point::new(30.0 * around(i).cos(), 30.0 * around(i).sin())).collect());
        assert!(arcs.len() <= 10, "{} arcs", arcs.len());
    }

    #[test]
    fn a_slight_corner_is_rounded_between_two_lines() {
        let arcs = fitted(vec![Point::new(0.0, 0.0), Point::new(100.0, 0.0), Point::new(180.0, 50.0)]);
        let curved = arcs.iter().filter(|arc| arc.curvature != 0.0).count();
        assert!(arcs.len() <= 4 && curved <= 2, "{arcs:?}");
    }

    #[test]
    fn a_straight_line_of_many_points_is_one_piece() {
        assert_eq!(fitted((0..50).map(|i| Point::new(f64::from(i), 2.0)).collect()).len(), 1);
    }
}
