//! Polylines: lengths, turns, distances.

use super::{Point, Vector, angle};

/// Maximum chord length of a flattened curve, mm. CAD flattens to small sagittas, so longer segments are straight lines.
pub const CURVE_CHORD_MAX: f64 = 25.0;
/// Relative tolerance of comparisons of turns, for rounding.
const SURE_EPSILON: f64 = 1e-9;

/// Length of a polyline, mm.
pub fn length(points: &[Point]) -> f64 {
    points.windows(2).map(|w| (w[1] - w[0]).norm()).sum()
}

/// Chord length from the first point to each point, mm.
pub fn stations(points: &[Point]) -> Vec<f64> {
    let mut from = points.first().copied().unwrap_or_default();
    let mut at = 0.0;
    let station = |&point: &Point| {
        at += (point - std::mem::replace(&mut from, point)).norm();
        at
    };
    points.iter().map(station).collect()
}

/// Signed turn at an inner vertex, rad, left positive.
pub fn turn_at(before: Point, vertex: Point, after: Point) -> f64 {
    angle::turn(vertex - before, after - vertex)
}

/// True if the absolute turns at the inner vertices of a polyline sum to less than `limit` rad. The angles themselves are
/// rarely computed.
pub fn turns_by_less(points: &[Point], limit: f64) -> bool {
    // An angle is less than its tangent.
    let tangent = |w: &[Point]| {
        let (before, after) = (w[1] - w[0], w[2] - w[1]);
        let cosine = before.dot(&after);
        if cosine > 0.0 { super::cross(before, after).abs() / cosine } else { f64::INFINITY }
    };
    points.windows(3).map(tangent).sum::<f64>() < limit * (1.0 - SURE_EPSILON)
        || points.windows(3).map(|w| turn_at(w[0], w[1], w[2]).abs()).sum::<f64>() < limit
}

/// Foot of the perpendicular from `point` on the segment from `a` to `b`, as a fraction of the segment clamped to `[0, 1]`.
pub fn foot(point: Point, a: Point, b: Point) -> f64 {
    let along = b - a;
    let square = along.norm_squared();
    if square == 0.0 { 0.0 } else { ((point - a).dot(&along) / square).clamp(0.0, 1.0) }
}

/// Distance from `point` to the segment from `a` to `b`, mm.
pub fn distance_to_segment(point: Point, a: Point, b: Point) -> f64 {
    (point - (a + (b - a) * foot(point, a, b))).norm()
}

/// Distance of a point from the line through `from` along a unit vector, mm.
pub fn distance_to_line(point: Point, from: Point, along: Vector) -> f64 {
    super::cross(along, point - from).abs()
}

/// Distance between two segments, mm; 0 where they cross.
pub fn distance_of_segments([a, b]: [Point; 2], [c, d]: [Point; 2]) -> f64 {
    let side = |from: Point, to: Point, point: Point| super::cross(to - from, point - from);
    let parts = |from: Point, to: Point, p: Point, q: Point| side(from, to, p) * side(from, to, q) < 0.0;
    if parts(a, b, c, d) && parts(c, d, a, b) {
        return 0.0;
    }
    let ends = [(a, c, d), (b, c, d), (c, a, b), (d, a, b)];
    ends.into_iter().map(|(point, from, to)| distance_to_segment(point, from, to)).fold(f64::INFINITY, f64::min)
}

/// Distance from a point to a polyline of at least two points, mm.
pub fn distance(point: Point, points: &[Point]) -> f64 {
    points.windows(2).map(|ends| distance_to_segment(point, ends[0], ends[1])).fold(f64::INFINITY, f64::min)
}

/// Point at a station, mm, on a polyline of at least two points with its [`stations`]; clamped to its ends.
pub fn place(points: &[Point], stations: &[f64], station: f64) -> Point {
    on_chord(points, stations, station, stations.partition_point(|&passed| passed < station))
}

/// Point at a station, mm; the search starts at the vertex index `vertex`, which should be near.
pub fn place_near(points: &[Point], stations: &[f64], station: f64, vertex: usize) -> Point {
    let mut next = vertex;
    while next > 0 && stations[next - 1] >= station {
        next -= 1;
    }
    while next < stations.len() && stations[next] < station {
        next += 1;
    }
    on_chord(points, stations, station, next)
}

/// Point at a station on the chord that ends at the vertex `next`, or on the nearest chord that exists.
fn on_chord(points: &[Point], stations: &[f64], station: f64, next: usize) -> Point {
    let next = next.clamp(1, points.len() - 1);
    let (from, to) = (stations[next - 1], stations[next]);
    let share = if to > from { ((station - from) / (to - from)).clamp(0.0, 1.0) } else { 0.0 };
    points[next - 1] + (points[next] - points[next - 1]) * share
}

/// Unit vector along a segment; `None` for a segment of zero length.
pub fn direction(a: Point, b: Point) -> Option<Vector> {
    (b - a).try_normalize(0.0)
}

/// Total absolute turn at the inner vertices of a polyline up to the first one `distance` or more from the start, rad.
pub fn turn_within(points: &[Point], distance: f64) -> f64 {
    let inner = points.windows(3).take_while(|w| (w[1] - points[0]).norm() < distance);
    inner.map(|w| turn_at(w[0], w[1], w[2]).abs()).sum()
}

/// The first point of a polyline at `distance` from its start, and the index of its chord. `None` when the polyline stays
/// nearer.
pub fn first_at_distance(points: &[Point], distance: f64) -> Option<(Point, usize)> {
    let from = *points.first()?;
    for (i, ends) in points.windows(2).enumerate() {
        if (ends[1] - from).norm() < distance {
            continue;
        }
        // Solve |a + x d - from| = distance for the root ahead: the chord starts nearer and ends farther.
        let (a, d) = (ends[0] - from, ends[1] - ends[0]);
        let (square, half, rest) = (d.norm_squared(), a.dot(&d), a.norm_squared() - distance * distance);
        let x = (-half + (half * half - square * rest).max(0.0).sqrt()) / square;
        return Some((ends[0] + d * x.clamp(0.0, 1.0), i));
    }
    None
}

/// Sagitta of an arc over a chord, mm, for a turn of the arc in rad, up to a half circle; greater turns are clamped. For small
/// turns it is an eighth of the turn times the chord.
pub fn sagitta(chord: f64, turn: f64) -> f64 {
    chord / 2.0 * (turn.min(std::f64::consts::PI) / 4.0).tan()
}

/// True if the polyline is straight: every vertex lies within `tolerance` of the chord between its ends, and no segment goes
/// back.
pub fn is_straight(points: &[Point], tolerance: f64) -> bool {
    let (Some(&first), Some(&last)) = (points.first(), points.last()) else { return true };
    let Some(along) = direction(first, last) else { return points.len() < 2 };
    let within = points.iter().all(|p| super::cross(along, p - first).abs() <= tolerance);
    within && points.windows(2).all(|w| (w[1] - w[0]).dot(&along) > 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_foot_stays_on_the_segment() {
        let (a, b) = (Point::new(0.0, 0.0), Point::new(10.0, 0.0));
        assert_eq!(distance_to_segment(Point::new(5.0, 2.0), a, b), 2.0);
        assert_eq!(distance_to_segment(Point::new(13.0, 4.0), a, b), 5.0);
        assert_eq!(distance_to_segment(Point::new(3.0, 4.0), a, a), 5.0);
    }

    #[test]
    fn a_place_is_the_same_from_whichever_vertex_it_is_looked_for() {
        let points = [(0.0, 0.0), (3.0, 0.0), (3.0, 4.0), (3.0, 4.0), (9.0, 4.0)].map(|(x, y)| Point::new(x, y));
        let along = stations(&points);
        for station in [-1.0, 0.0, 2.0, 3.0, 5.0, 7.0, 8.0, 13.0, 20.0] {
            for vertex in 0..points.len() {
                assert_eq!(place_near(&points, &along, station, vertex), place(&points, &along, station));
            }
        }
    }

    #[test]
    fn turns_sum_to_less_than_a_limit_above_their_sum_alone() {
        let wave = [(0.0, 0.0), (2.0, 0.0), (4.0, 1.0), (6.0, 1.0), (6.0, 3.0)].map(|(x, y)| Point::new(x, y));
        let turned = 2.0 * 0.5_f64.atan() + std::f64::consts::FRAC_PI_2;
        assert!(turns_by_less(&wave, turned + 1e-6) && !turns_by_less(&wave, turned - 1e-6));
        assert!(turns_by_less(&wave[..4], 1.1) && !turns_by_less(&wave[..4], 0.9));
    }

    #[test]
    fn the_first_point_at_a_distance_is_found_on_its_chord() {
        let corner = [Point::new(0.0, 0.0), Point::new(3.0, 0.0), Point::new(3.0, 9.0)];
        assert_eq!(first_at_distance(&corner, 2.0), Some((Point::new(2.0, 0.0), 0)));
        assert_eq!(first_at_distance(&corner, 5.0), Some((Point::new(3.0, 4.0), 1)));
        assert_eq!(first_at_distance(&corner, 10.0), None);
    }

    #[test]
    fn the_sagitta_is_that_of_the_circle() {
        for (radius, chord) in [(6.5_f64, 6.0_f64), (100.0, 6.0), (3.0, 6.0)] {
            let turn = 2.0 * (chord / 2.0 / radius).asin();
            let exact = radius - (radius * radius - chord * chord / 4.0).max(0.0).sqrt();
            assert!((sagitta(chord, turn) - exact).abs() < 1e-9);
        }
    }

    #[test]
    fn a_hairpin_is_not_straight() {
        let there_and_back = [Point::new(0.0, 0.0), Point::new(10.0, 0.0), Point::new(5.0, 0.01)];
        assert!(!is_straight(&there_and_back, 0.05));
        assert!(is_straight(&there_and_back[..2], 0.05));
    }
}
