//! Corners of a polyline with rounded points. A turn is a corner only if neither rounding nor a curve of dense points can
//! produce it.

use std::cmp::Ordering;

use super::{Point, angle, polyline};

/// Distances from a vertex to the neighbours that are compared, in units of the rounding. Points closer together turn by
/// rounding alone.
const WINDOWS: [f64; 3] = [3.0, 6.0, 12.0];
/// Minimum height of a corner above the line between its neighbours, in units. Rounding alone gives up to sqrt(2): three points
/// of a straight line, each off by half a diagonal of the unit.
const HEIGHT: f64 = 1.5;
/// Difference of heights that count as equal, in units: those of both directions differ by the rounding of numbers.
const HEIGHT_EPSILON: f64 = 1e-6;
/// Length of the two ways over which the turn of the curve beside a vertex is taken, in units. Rounding turns them by less than
/// 0.1 rad.
const CURVE: f64 = 24.0;
/// Maximum number of points examined on either side of a vertex. It bounds the cost of a line that goes to and fro on the spot.
const LOOK: usize = 64;

/// Polyline whose corners are asked for. All its points are rounded to multiples of one unit.
pub struct Corners<F> {
    /// Point of each vertex.
    pub point: F,
    /// Number of vertices; the first of a ring counts once.
    pub count: usize,
    /// True if the last vertex is joined to the first.
    pub is_ring: bool,
    /// Greatest turn that is no corner, rad.
    pub limit: f64,
    /// Grid of the points, mm; 0 = not rounded.
    pub unit: f64,
}

/// Turn at a vertex that may be a corner.
struct Turn {
    /// Distance from which it is seen, mm.
    reach: f64,
    is_left: bool,
    /// Height above the line between the places of the polyline at that distance, in steps of `HEIGHT_EPSILON` units. Of two
    /// vertices at the tip of a needle only the tip stands out.
    height: f64,
    at: Point,
}

impl Turn {
    /// Order of sharpness: a turn that is seen from nearby is sharper than one that a longer way shows. The place decides
    /// between equals, so that both directions of a polyline agree.
    fn order(&self, other: &Self) -> Ordering {
        let by_height = other.height.total_cmp(&self.height);
        let by_place = || self.at.x.total_cmp(&other.at.x).then(self.at.y.total_cmp(&other.at.y));
        self.reach.total_cmp(&other.reach).then(by_height).then_with(by_place)
    }
}

impl<F: Fn(usize) -> Point> Corners<F> {
    /// True if the polyline turns at a vertex by more than the limit.
    ///
    /// A curve drawn with points as close as its unit climbs in steps that each turn by 45 degrees or more. There a corner must
    /// also turn when seen from neighbours farther away, by more than the curve on either side of it does, and stand out by
    /// more than rounding. Of several such vertices within the distance of those neighbours the sharpest is the corner; a
    /// vertex that is none itself hides no other.
    pub fn is_at(&self, vertex: usize) -> bool {
        let Some([from, at, to]) = self.turned(vertex) else { return false };
        let far = WINDOWS[WINDOWS.len() - 1] * self.unit;
        if [from, to].iter().all(|point| (point - at).norm() >= far) {
            return true;
        }
        self.turn(vertex).is_some_and(|turn| self.stands_out(vertex, &turn, &mut Vec::new()))
    }

    /// True if no sharper corner is within the reach of a turn. `known` are the vertices that were asked for, with the answers;
    /// beyond the greatest number of them a sharper turn counts as a corner.
    fn stands_out(&self, vertex: usize, turn: &Turn, known: &mut Vec<(usize, bool)>) -> bool {
        let mut beside = [false, true].into_iter().flat_map(|ahead| {
            let near = self.walk(vertex, ahead).take_while(|&i| ((self.point)(i) - turn.at).norm() < turn.reach);
            near.filter_map(|i| self.turn(i).map(|other| (i, other)))
        });
        !beside.any(|(i, other)| {
            if other.is_left != turn.is_left || !other.order(turn).is_lt() {
                return false;
            }
            if let Some(&(_, is_corner)) = known.iter().find(|known| known.0 == i) {
                return is_corner;
            }
            let place = known.len();
            known.push((i, true));
            if place < LOOK {
                known[place].1 = self.stands_out(i, &other, known);
            }
            known[place].1
        })
    }

    /// A vertex and its neighbours, if the drawn line turns there by more than the limit.
    fn turned(&self, vertex: usize) -> Option<[Point; 3]> {
        let next = |ahead: bool| self.walk(vertex, ahead).next().map(&self.point);
        let [from, at, to] = [next(false)?, (self.point)(vertex), next(true)?];
        angle::is_turned(at - from, to - at, self.limit).then_some([from, at, to])
    }

    /// Other vertices on one side of a vertex, the nearest first.
    fn walk(&self, vertex: usize, ahead: bool) -> impl Iterator<Item = usize> + Clone + use<F> {
        let count = self.count;
        let most = match (self.is_ring, ahead) {
            (true, _) => count - 1,
            (false, true) => count - 1 - vertex,
            (false, false) => vertex,
        };
        (1..=most.min(LOOK)).map(move |k| (vertex + if ahead { k } else { count - k }) % count)
    }

    /// Turn at a vertex as seen from the nearest neighbours that show it.
    fn turn(&self, vertex: usize) -> Option<Turn> {
        let [_, at, _] = self.turned(vertex)?;
        let side = |ahead: bool| self.walk(vertex, ahead).map(&self.point);
        // Left turns of the curve before the vertex and behind it; those over a shorter way are lost in the rounding.
        let bends = [-bend(side(false), at, CURVE * self.unit), bend(side(true), at, CURVE * self.unit)];
        WINDOWS.iter().find_map(|window| {
            let reach = window * self.unit;
            let [from, to] = [false, true].map(|ahead| neighbour(&mut side(ahead), at, reach));
            let turn = angle::turn(at - from.point, to.point - at);
            let curve = |near: &Neighbour, bend: f64| if near.skips { (bend * turn.signum()).max(0.0) } else { 0.0 };
            let curve = f64::midpoint(curve(&from, bends[0]), curve(&to, bends[1])) * window / CURVE;
            // Share of the turn that the curve does not explain.
            let share = 1.0 - curve / turn.abs();
            let height = polyline::distance_to_segment(at, from.point, to.point) * share;
            let is_sharp = share > 0.0
                && angle::is_turned(at - from.point, to.point - at, self.limit / share)
                && height > (HEIGHT + HEIGHT_EPSILON) * self.unit;
            is_sharp.then(|| {
                let [from, to] = [false, true].map(|ahead| place(side(ahead), at, reach));
                let height = share * polyline::distance_to_segment(at, from, to);
                let height = (height / (HEIGHT_EPSILON * self.unit)).round();
                Turn { reach, is_left: turn > 0.0, height, at }
            })
        })
    }
}

/// Point of a polyline at a distance from a vertex.
struct Neighbour {
    point: Point,
    /// True if the polyline has a point between.
    skips: bool,
}

/// First point that is `reach` mm from `at`, or the last point; `points` has a first one.
fn neighbour(points: &mut impl Iterator<Item = Point>, at: Point, reach: f64) -> Neighbour {
    let mut near = Neighbour { point: at, skips: false };
    for (i, point) in points.enumerate() {
        near = Neighbour { point, skips: i > 0 };
        if (point - at).norm() >= reach {
            break;
        }
    }
    near
}

/// Place of a polyline `reach` mm along it from `at`, or its last point.
fn place(points: impl Iterator<Item = Point>, at: Point, reach: f64) -> Point {
    let (mut last, mut left) = (at, reach);
    for point in points {
        let way = (point - last).norm();
        if way >= left {
            return last + (point - last) * (left / way);
        }
        (last, left) = (point, left - way);
    }
    last
}

/// Left turn of a polyline over two ways of `reach` mm out from `at`, rad; 0 where it ends before or is drawn in such steps.
fn bend(mut points: impl Iterator<Item = Point>, at: Point, reach: f64) -> f64 {
    let near = neighbour(&mut points, at, reach);
    let next = points.find(|&point| (point - near.point).norm() >= reach);
    next.filter(|_| near.skips).map_or(0.0, |next| angle::turn(near.point - at, next - near.point))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{FRAC_PI_4, TAU};

    /// Vertices of a polyline that are corners of more than 45 degrees.
    fn corners(points: &[(f64, f64)], unit: f64) -> Vec<usize> {
        corners_of(points, unit, FRAC_PI_4)
    }

    /// Vertices of a polyline that are corners of more than `limit` rad.
    fn corners_of(points: &[(f64, f64)], unit: f64, limit: f64) -> Vec<usize> {
        let point = |i: usize| Point::new(points[i].0, points[i].1);
        let corners = Corners { point, count: points.len(), is_ring: false, limit, unit };
        (0..points.len()).filter(|&i| corners.is_at(i)).collect()
    }

    #[test]
    fn tight_curves_of_dense_points_have_no_corners() {
        for radius in [1.5, 2.0, 3.0, 8.0] {
            for spacing in [0.04, 0.11, 0.3] {
                let last = (TAU * radius / spacing) as u32;
                let round = |x: f64| (x * 10.0).round() / 10.0;
                let turns = (0..last).map(|i| TAU * f64::from(i) / f64::from(last));
                let mut circle: Vec<Point> =
                    turns.map(|turn| Point::new(round(radius * turn.cos()), round(radius * turn.sin()))).collect();
                circle.dedup();
                let count = circle.len();
                let corners =
                    Corners { point: |i: usize| circle[i], count, is_ring: true, limit: FRAC_PI_4 / 2.0, unit: 0.1 };
                assert!(!(0..count).any(|i| corners.is_at(i)), "{radius} {spacing}");
            }
        }
    }

    #[test]
    fn only_corners_hide_turns_and_both_directions_have_the_same() {
        let (limit, unit) = (FRAC_PI_4 / 2.0, 0.1);
        let mut hidden_by_none = 0;
        for seed in 0..1000 {
            let mut random = fastrand::Rng::with_seed(seed);
            let mut at = [0_i32; 2];
            let points = (0..60).map(|_| {
                at = [at[0] + random.i32(1..4), at[1] + random.i32(-3..4)];
                Point::new(f64::from(at[0]) * unit, f64::from(at[1]) * unit)
            });
            let mut points: Vec<Point> = points.collect();
            points.dedup();
            let count = points.len();
            let corners = Corners { point: |i: usize| points[i], count, is_ring: false, limit, unit };
            let reversed = Corners { point: |i: usize| points[count - 1 - i], count, is_ring: false, limit, unit };
            for vertex in 0..count {
                assert_eq!(corners.is_at(vertex), reversed.is_at(count - 1 - vertex), "{seed} {vertex}");
            }
            // The sharpest turn is a corner, then the next one that no corner hides, and so on.
            let mut turns: Vec<(usize, Turn)> =
                (0..count).filter_map(|i| corners.turn(i).map(|turn| (i, turn))).collect();
            turns.sort_by(|a, b| a.1.order(&b.1));
            let mut found: Vec<usize> = Vec::new();
            for (i, turn) in &turns {
                let near = |ahead| corners.walk(*i, ahead).take_while(|&k| (points[k] - turn.at).norm() < turn.reach);
                let beside: Vec<usize> = [false, true].into_iter().flat_map(near).collect();
                let is_sharper = |k: &usize| {
                    let other = corners.turn(*k);
                    other.is_some_and(|other| other.is_left == turn.is_left && other.order(turn).is_lt())
                };
                if !beside.iter().any(|k| found.contains(k) && is_sharper(k)) {
                    hidden_by_none += usize::from(beside.iter().any(is_sharper));
                    found.push(*i);
                }
            }
            found.sort_unstable();
            let far = |i: &usize| corners.is_at(*i) && corners.turn(*i).is_some();
            assert_eq!((0..count).filter(far).collect::<Vec<_>>(), found, "{seed}");
        }
        assert!(hidden_by_none > 100, "{hidden_by_none}");
    }

    #[test]
    fn steps_of_rounding_are_no_corners_and_small_notches_are() {
        // A slanted line in steps of one unit.
        let steps: Vec<(f64, f64)> =
            (0..40).map(|i| (f64::from(i / 2 + i % 2) * 0.1, f64::from(i / 2) * 0.1)).collect();
        assert!(corners(&steps, 0.1).is_empty());
        assert_eq!(corners(&steps, 0.0).len(), 38);
        // A V three units high, and a right angle between points three units apart.
        assert_eq!(corners(&[(0.0, 0.0), (6.0, 0.0), (6.4, 0.3), (6.8, 0.0), (9.0, 0.0)], 0.1), [2]);
        let dense: Vec<(f64, f64)> = (0..20)
            .map(|i| 0.3 * f64::from(i))
            .map(|way| if way < 3.0 { (way, 0.0) } else { (3.0, way - 3.0) })
            .collect();
        assert_eq!(corners(&dense, 0.1), [10]);
        // Two points of a corner that are one unit apart.
        assert_eq!(corners(&[(0.0, 0.0), (5.0, 0.0), (5.1, 0.0), (5.1, 9.0)], 0.1), [2]);
    }
}
