//! Approximation of a polyline by few arcs and lines that join tangentially and stay in its band.
//!
//! Two nodes with known directions are joined by a biarc: two arcs with a common tangent where they meet (K. M. Bolton, *Biarc
//! curves*, Computer-Aided Design 7, 1975; here with tangents of equal length at both ends). The nodes are the middles of
//! chords, where the curve has the direction of the chord, and the shoulders of bends that can be rounded within the band. From
//! each node the fit takes the farthest node whose biarc stays in the band.

use super::band::{Stretch, ToleranceBand};
use crate::geom::{Point, Vector, angle, cross};

/// Fraction of the tolerance available to the fit. The rest covers decimals and the difference between arcs and parabolas.
const SHARE: f64 = 0.92;
/// Fraction of the tolerance used to round a single bend.
const ROUNDING_SHARE: f64 = 0.75;
/// Maximum length of a shoulder as a fraction of its chord, so that the middle lies between two shoulders.
const SHOULDER_SHARE: f64 = 0.45;
/// Turn below which a vertex needs no shoulder, rad.
const TURN_EPSILON: f64 = 1e-9;
/// Maximum turn of an arc, rad: controllers confuse the direction of longer ones.
const SWEEP_MAX: f64 = 2.8;
/// Minimum dot product of the directions at both ends of a biarc.
const OPPOSED: f64 = -0.7;
/// Sagitta below which an arc becomes a line, mm.
const LINE_EPSILON: f64 = 1e-5;
/// Maximum direction error at the ends for which a single arc replaces a biarc, rad.
const SAME_EPSILON: f64 = 2e-4;
/// Length below which there is no arc, mm.
const LENGTH_EPSILON: f64 = 1e-9;
/// Tangents at the ends of a biarc are parallel when 2 (1 - dot product) is below this.
const PARALLEL_EPSILON: f64 = 1e-12;
/// Curvature limits that are tried in turn, as multiples of the gentlest one: rounding turns short lines on a tight arc the
/// more the tighter it is.
const LOOSER: [f64; 4] = [1.0, 2.0, 4.0, 8.0];
/// Number of following nodes to try when no aim can be reached.
const FIRST_TRIES: usize = 4;

/// A single arc, or the two arcs of a biarc.
type Found = [Option<Arc>; 2];

/// An arc; a line when its curvature is 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Arc {
    /// Start point.
    pub(super) from: Point,
    /// Unit vector along it at the start.
    pub(super) along: Vector,
    /// Length, mm.
    pub(super) length: f64,
    /// Curvature, left positive, per mm.
    pub(super) curvature: f64,
    /// Index of the last chord beside it.
    pub(super) chord: usize,
    /// True if it ends at the end of that chord.
    pub(super) stops: bool,
}

impl Arc {
    /// The arc that leaves a point in a direction and passes through another point, not yet [`measured`](Self::measured). `None`
    /// when the points coincide or the arc would turn by more than [`SWEEP_MAX`].
    fn through(from: Point, along: Vector, to: Point) -> Option<Self> {
        let way = to - from;
        let chord = way.norm();
        if chord < LENGTH_EPSILON {
            return None;
        }
        // The chord is 2 R sin(half); the cross product of the two vectors is chord sin(half).
        let aside = cross(along, way);
        let half = || angle::turn(along, way).abs();
        // The angle itself is needed only near the limits: below 45 degrees the arc turns by less than `SWEEP_MAX`, and an
        // angle is greater than its sine.
        if aside.abs() >= along.dot(&way) && 2.0 * half() > SWEEP_MAX {
            return None;
        }
        if aside.abs() < 8.0 * LINE_EPSILON && chord * half() / 4.0 < LINE_EPSILON {
            return Some(Self { from, along: way / chord, length: chord, curvature: 0.0, chord: 0, stops: false });
        }
        let curvature = 2.0 * aside / (chord * chord);
        Some(Self { from, along, length: f64::NAN, curvature, chord: 0, stops: false })
    }

    /// The arc with its length, which ends at `to`.
    fn measured(self, to: Point) -> Self {
        if self.curvature == 0.0 {
            return self;
        }
        Self { length: 2.0 * angle::turn(self.along, to - self.from) / self.curvature, ..self }
    }

    /// Unit vector along it at its end point `to`: the direction at its start, mirrored at the chord.
    fn along_at_end(&self, to: Point) -> Vector {
        if self.curvature == 0.0 { self.along } else { mirrored(self.along, to - self.from) }
    }

    /// Turn, rad.
    pub(super) fn turn(&self) -> f64 {
        self.curvature * self.length
    }

    /// Unit vector along it at a length from its start.
    pub(super) fn along_at(&self, s: f64) -> Vector {
        let (sin, cos) = (self.curvature * s).sin_cos();
        Vector::new(self.along.x * cos - self.along.y * sin, self.along.x * sin + self.along.y * cos)
    }

    /// Point at a length from its start.
    pub(super) fn at(&self, s: f64) -> Point {
        let half = 0.5 * self.curvature * s;
        let (sin, cos) = half.sin_cos();
        let chord = if half == 0.0 { s } else { s * sin / half };
        self.from
            + Vector::new(self.along.x * cos - self.along.y * sin, self.along.x * sin + self.along.y * cos) * chord
    }

    /// Signed distance of a point from it, positive to the left, mm.
    fn left_of(&self, point: Point) -> f64 {
        let away = point - self.from;
        let side = cross(self.along, away);
        if self.curvature == 0.0 {
            return side;
        }
        // |away - radius n| - radius, in a form that stays accurate for large radii.
        let bent = away.norm_squared() * self.curvature - 2.0 * side;
        -bent / (1.0 + (1.0 + bent * self.curvature).max(0.0).sqrt())
    }
}

/// A place where an arc may start or end.
#[derive(Debug, Clone, Copy)]
struct Node {
    at: Point,
    along: Vector,
    station: f64,
    /// Index of its chord.
    chord: usize,
    kind: Kind,
    /// True if an arc must end here: the node is at the end of its chord, and the feed changes there.
    stops: bool,
}

/// Kind of a node.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    /// A place on the curve that the polyline approximates.
    Aim,
    /// The shoulder of a bend.
    Shoulder,
    /// A shoulder of any other vertex, used as a last resort. A line or an arc always fits from one to the next.
    Spare,
}

/// A vertex where an arc must end.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Stop {
    /// Index of the vertex in the band.
    pub(super) vertex: usize,
    /// Unit vector along the path there; `None` = midway between the directions of its two chords.
    pub(super) along: Option<Vector>,
}

/// Boundary conditions and options of a fit.
#[derive(Debug, Clone)]
pub(super) struct Ends {
    /// Unit vectors along the path at its start and its end.
    pub(super) start: Vector,
    pub(super) end: Vector,
    /// Vertices where an arc must end, in order.
    pub(super) stops: Vec<Stop>,
    /// Maximum curvature to prefer where a gentler path stays in the band, per mm. Infinite where the controller takes arcs.
    pub(super) curvature: f64,
    /// True if every vertex gets shoulders, as a last resort.
    pub(super) spares: bool,
    /// Half length of the secant that gives the direction at nodes on shorter chords, as a multiple of the tolerance; 0 = use
    /// the chord itself.
    pub(super) reach: f64,
}

/// Fits arcs to a band. The error is the node from which no arc stays inside.
pub(super) fn fit(band: &ToleranceBand, ends: &Ends) -> Result<Vec<Arc>, Point> {
    let nodes = nodes(band, ends);
    let aims: Vec<usize> = (1..nodes.len()).filter(|&i| nodes[i].kind == Kind::Aim).collect();
    let mut arcs = Vec::new();
    let (mut i, mut ahead) = (0, 0);
    while i + 1 < nodes.len() {
        while aims[ahead] <= i {
            ahead += 1;
        }
        let stop = (i + 1..nodes.len()).find(|&k| nodes[k].stops).unwrap_or(nodes.len() - 1);
        let end = aims.partition_point(|&aim| aim <= stop);
        let reach = |curvature: f64| farthest(band, &nodes[..=stop], i, &aims[ahead..end], curvature);
        let least = ends.curvature;
        let mut gentle = LOOSER.iter().map(|times| times * least).filter(|curvature| curvature.is_finite());
        let (to, found) = gentle.find_map(reach).or_else(|| reach(f64::INFINITY)).ok_or(nodes[i].at)?;
        arcs.extend(found.into_iter().flatten());
        i = to;
    }
    Ok(arcs)
}

/// The farthest node that a biarc from node `i` reaches with arcs up to a curvature, and that biarc. `aims` are the nodes on
/// the curve after `i`.
fn farthest(band: &ToleranceBand, nodes: &[Node], i: usize, aims: &[usize], curvature: f64) -> Option<(usize, Found)> {
    let is_gentle = |found: &Found| found.iter().flatten().all(|arc| arc.curvature.abs() <= curvature);
    let try_to = |j: usize| biarc(band, &nodes[i], &nodes[j]).filter(is_gentle);
    let mut best: Option<(usize, Found)> = None;
    // Double the distance until a biarc fails, then bisect.
    let (mut reached, mut bad) = (0, aims.len() + 1);
    let mut step = 1;
    while step < bad {
        match try_to(aims[step - 1]) {
            Some(found) => (best, reached) = (Some((aims[step - 1], found)), step),
            None => bad = step,
        }
        step = if step == aims.len() { bad } else { (2 * step).min(aims.len()) };
    }
    while bad - reached > 1 {
        let middle = usize::midpoint(reached, bad);
        match try_to(aims[middle - 1]) {
            Some(found) => (best, reached) = (Some((aims[middle - 1], found)), middle),
            None => bad = middle,
        }
    }
    // A shoulder beyond that node, if any, ends a straight line at the bend.
    let from = best.map_or(i, |(reached, _)| reached);
    let next = aims.get(reached).copied().unwrap_or(from);
    let mut shoulders = (from + 1..next.max(from + 1)).rev().filter(|&j| nodes[j].kind == Kind::Shoulder);
    let beyond = shoulders.find_map(|j| Some((j, try_to(j)?)));
    beyond.or(best).or_else(|| {
        let last = (i + FIRST_TRIES).min(nodes.len() - 1);
        (i + 1..=last).rev().find_map(|j| Some((j, try_to(j)?)))
    })
}

/// The nodes along a band.
fn nodes(band: &ToleranceBand, ends: &Ends) -> Vec<Node> {
    let last = band.chords();
    let node = |chord: usize, (at, along): (Point, Vector), station: f64| Node {
        at,
        along,
        station,
        chord,
        kind: Kind::Aim,
        stops: false,
    };
    // At most two shoulders and a middle per chord, plus the nodes where the feed changes.
    let mut nodes = Vec::with_capacity(3 * last + 2);
    nodes.push(node(0, (band.points[0], ends.start), 0.0));
    // For a bend of turn t, a rounding that touches both chords at a distance w from the vertex passes the vertex at w tan(t /
    // 4). Vertices of a curve get no shoulder.
    let shoulder = |chord: usize, vertex: usize| {
        let turn = band.turns[vertex].abs();
        if turn <= TURN_EPSILON {
            return None;
        }
        let is_bend = band.is_bend(chord, vertex);
        if !is_bend && !ends.spares {
            return None;
        }
        let way = ROUNDING_SHARE * band.tolerance_at(vertex) / (turn / 4.0).tan();
        let longest = SHOULDER_SHARE * (band.stations[chord + 1] - band.stations[chord]);
        if is_bend && way < longest {
            Some((way, Kind::Shoulder))
        } else {
            ends.spares.then_some((way.min(longest), Kind::Spare))
        }
    };
    for chord in 0..last {
        let (a, length) = (band.points[chord], band.stations[chord + 1] - band.stations[chord]);
        let along = band.direction(chord);
        let place = |way: f64| node(chord, (a + along * way, along), band.stations[chord] + way);
        nodes.extend(shoulder(chord, chord).map(|(way, kind)| Node { kind, ..place(way) }));
        let middle = place(0.5 * length);
        // Chords as short as the resolution of the file only show the direction of the curve in groups.
        let reach = ends.reach * band.tolerance;
        let along = if length < reach { band.around(middle.station, reach) } else { along };
        nodes.push(Node { at: middle.at + band.middle(chord), along, ..middle });
        nodes.extend(shoulder(chord, chord + 1).map(|(way, kind)| Node { kind, ..place(length - way) }));
        if let Ok(stop) = ends.stops.binary_search_by_key(&(chord + 1), |stop| stop.vertex) {
            let between = || (band.direction(chord) + band.direction(chord + 1)).normalize();
            let along = ends.stops[stop].along.unwrap_or_else(between);
            let end = (band.points[chord + 1], along);
            nodes.push(Node { stops: true, ..node(chord, end, band.stations[chord + 1]) });
        }
    }
    nodes.push(node(last - 1, (band.points[last], ends.end), band.stations[last]));
    nodes
}

/// The arcs between two nodes; `None` when they leave the band.
fn biarc(band: &ToleranceBand, from: &Node, to: &Node) -> Option<Found> {
    let way = to.at - from.at;
    let (t0, t1) = (from.along, to.along);
    let dot = t0.dot(&t1);
    if dot < OPPOSED || way.dot(&(t0 + t1)) <= 0.0 {
        return None;
    }
    if cross(mirrored(t0, way), t1).abs() < SAME_EPSILON
        && let Some(one) = Arc::through(from.at, t0, to.at)
        && let end = one.along_at_end(to.at)
        && end.dot(&t1) > 0.0
        && cross(end, t1).abs() + cross(t0, one.along).abs() < SAME_EPSILON
    {
        let arcs = [Some(Arc { chord: to.chord, stops: to.stops, ..one }), None];
        return stays(band, &arcs, (to.at, end), [from, to]).then(|| arcs.map(|arc| Some(arc?.measured(to.at))));
    }
    let ahead = way.dot(&(t0 + t1));
    let open = 2.0 * (1.0 - dot);
    let reach = if open < PARALLEL_EPSILON {
        way.norm_squared() / (2.0 * ahead)
    } else {
        (-ahead + (ahead * ahead + open * way.norm_squared()).sqrt()) / open
    };
    let middle = from.at + ((way) + (t0 - t1) * reach) * 0.5;
    let first = Arc::through(from.at, t0, middle)?;
    let meet = first.along_at_end(middle);
    let second = Arc::through(middle, meet, to.at)?;
    let station = f64::midpoint(from.station, to.station);
    let chord = band.chord_at(station);
    let arcs = [Some(Arc { chord, ..first }), Some(Arc { chord: to.chord, stops: to.stops, ..second })];
    let ends = [middle, to.at];
    stays(band, &arcs, (middle, meet), [from, to]).then(|| [0, 1].map(|k| Some(arcs[k]?.measured(ends[k]))))
}

/// The direction at the end of an arc with chord `way`: the direction `along` at its other end, mirrored at the chord.
fn mirrored(along: Vector, way: Vector) -> Vector {
    way * (2.0 * along.dot(&way) / way.norm_squared()) - along
}

/// True if arcs that meet at a place stay in the band, beside every chord and beside the parts of the chords that they start
/// and end on.
fn stays(band: &ToleranceBand, arcs: &Found, meet: (Point, Vector), [from, to]: [&Node; 2]) -> bool {
    let allowed = SHARE * band.tolerance;
    let [Some(first), second] = arcs else { return false };
    let second = second.as_ref().unwrap_or(first);
    // Offset of the arcs at a vertex, to its left, and the curvature of the arc there.
    let beside = |vertex: usize| {
        let point = band.points[vertex];
        let arc = if (point - meet.0).dot(&meet.1) < 0.0 { first } else { second };
        (-arc.left_of(point), arc.curvature)
    };
    let left_of_chord = |chord: usize, place: Point| cross(band.direction(chord), place - band.points[chord]);
    let mut before = (from.station, left_of_chord(from.chord, from.at), first.curvature);
    for chord in from.chord..=to.chord {
        let (station, (offset, curvature)) = if chord == to.chord {
            (to.station, (left_of_chord(chord, to.at), second.curvature))
        } else {
            (band.stations[chord + 1], beside(chord + 1))
        };
        let (start, left, bent) = before;
        let stretch = |stations, ends| Stretch { chord, stations, ends };
        let holds = if curvature == bent {
            band.holds(&stretch([start, station], [left, offset]), bent, allowed)
        } else {
            // The arcs meet beside this chord.
            let at = band.stations[chord] + (meet.0 - band.points[chord]).dot(&band.direction(chord));
            let (at, between) = (at.max(start).min(station), left_of_chord(chord, meet.0));
            band.holds(&stretch([start, at], [left, between]), bent, allowed)
                && band.holds(&stretch([at, station], [between, offset]), curvature, allowed)
        };
        if !holds {
            return false;
        }
        before = (station, offset, curvature);
    }
    true
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::polyline;
    use crate::machine::MachineProfile;

    fn band(points: Vec<Point>) -> ToleranceBand {
        ToleranceBand::new(points, 0.05, [0.0; 2], &MachineProfile::default())
    }

    fn ends(band: &ToleranceBand) -> Ends {
        Ends {
            start: band.direction(0),
            end: band.direction(band.chords() - 1),
            stops: Vec::new(),
            curvature: f64::INFINITY,
            spares: false,
            reach: 0.0,
        }
    }

    fn fitted(points: Vec<Point>) -> Vec<Arc> {
        let band = band(points);
        let arcs = fit(&band, &ends(&band)).expect("it fits");
        check(&band, &arcs);
        arcs
    }

    /// Checks by an independent measure: the distance of every place from the nearest chord and the height of its sagitta.
    fn check(band: &ToleranceBand, arcs: &[Arc]) {
        for pair in arcs.windows(2) {
            assert!((pair[0].at(pair[0].length) - pair[1].from).norm() < 1e-9, "no gap");
            let kink = angle::turn(pair[0].along_at(pair[0].length), pair[1].along).abs();
            assert!(kink < 3.0 * SAME_EPSILON, "no kink: {kink}");
        }
        for arc in arcs {
            for place in (0..=20).map(|i| arc.at(arc.length * f64::from(i) / 20.0)) {
                let away = |chord: usize| {
                    let ends = [band.points[chord], band.points[chord + 1]];
                    polyline::distance_to_segment(place, ends[0], ends[1]) - band.sagittas[chord].norm()
                };
                let away = (0..band.chords()).map(away).fold(f64::INFINITY, f64::min);
                assert!(away <= 0.05, "{away} mm off at {place}");
            }
        }
    }

    #[test]
    fn ways_of_short_chords_and_sharp_turns_stay_in_their_band() {
        let mut random = fastrand::Rng::with_seed(3);
        let mut fits = 0;
        for _ in 0..400 {
            let (mut at, mut heading) = (Point::origin(), 0.0_f64);
            let side = if random.bool() { 1.0 } else { -1.0 };
            let mut points = vec![at];
            for _ in 0..random.usize(2..12) {
                at += Vector::new(heading.cos(), heading.sin()) * (0.1 + 0.9 * random.f64());
                heading += side * random.f64();
                points.push(at);
            }
            let band = band(points);
            if let Ok(arcs) = fit(&band, &ends(&band)) {
                check(&band, &arcs);
                fits += 1;
            }
        }
        assert!(fits > 200, "{fits}");
    }

    #[test]
    fn a_flattened_circle_is_few_arcs_again() {
        let around = |i: i32| f64::from(i) * std::f64::consts::TAU / 40.0;
        let arcs = fitted((0..=40).map(|i| Point::new(30.0 * around(i).cos(), 30.0 * around(i).sin())).collect());
        // Two arcs at each end, where the direction is that of the chord.
        assert!(arcs.len() <= 8, "{} arcs", arcs.len());
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

    #[test]
    fn an_arc_ends_where_the_feed_changes() {
        let band = ToleranceBand::new(
            (0..5).map(|i| Point::new(f64::from(i) * 10.0, 0.0)).collect(),
            0.05,
            [0.0; 2],
            &MachineProfile::default(),
        );
        let along = band.direction(0);
        let stops = [1, 3].map(|vertex| Stop { vertex, along: None }).to_vec();
        let arcs =
            fit(&band, &Ends { start: along, end: along, stops, curvature: f64::INFINITY, spares: false, reach: 0.0 })
                .expect("it fits");
        let ends: Vec<(usize, bool)> = arcs.iter().map(|arc| (arc.chord, arc.stops)).collect();
        assert_eq!(ends, [(0, true), (2, true), (3, false)]);
    }
}
