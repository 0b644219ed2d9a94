//! The edges of parts: closed rings with the material on their left.

use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::geom::{Heading, Point, Vector, polyline};
use crate::ir::Marker;
use crate::source::Span;

/// Points nearer to each other than that are one, mm: far below what a file resolves.
const SAME_EPSILON: f64 = 1e-6;

/// A chord that is longer than the next by more than this factor is straight, and no chord of the curve that begins there.
const SAME_CURVE: f64 = 4.0;

/// How far to both sides of a vertex its curvature is the mean of, mm: about what a jet covers at once.
const MEAN_WAY: f64 = 15.0;

/// A closed edge, with the material on the left of each chord: around a part against the clock, around a hole with it.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Ring {
    /// Its vertices, mm; the last is joined to the first.
    pub(super) points: Vec<Point>,
    /// The block of the chord behind each vertex.
    pub(super) spans: Vec<Span>,
    /// How far the direction turns at each vertex, rad: to the left is positive, there the part has a corner outwards.
    pub(super) turns: Vec<f64>,
    /// The least turn of a corner, rad.
    corner: f64,
}

impl Ring {
    /// A ring of these vertices, in this order.
    pub(super) fn new(points: Vec<Point>, spans: Vec<Span>, corner: f64) -> Self {
        let n = points.len();
        let turns =
            (0..n).map(|i| polyline::turn_at(points[(i + n - 1) % n], points[i], points[(i + 1) % n])).collect();
        Self { points, spans, turns, corner }
    }

    /// The ends of a chord.
    pub(super) fn chord(&self, chord: usize) -> [Point; 2] {
        [self.points[chord], self.points[(chord + 1) % self.points.len()]]
    }

    /// The unit vector along a chord.
    pub(super) fn along(&self, chord: usize) -> Vector {
        let [from, to] = self.chord(chord);
        (to - from).normalize()
    }

    /// Length of a chord, mm.
    pub(super) fn length(&self, chord: usize) -> f64 {
        let [from, to] = self.chord(chord);
        (to - from).norm()
    }

    /// The direction from outside to a chord, across it, rad.
    pub(super) fn inwards(&self, chord: usize) -> f64 {
        Heading::of(self.along(chord)).radians() + std::f64::consts::FRAC_PI_2
    }

    /// The chord before a vertex.
    pub(super) fn before(&self, vertex: usize) -> usize {
        (vertex + self.points.len() - 1) % self.points.len()
    }

    /// Whether a vertex is a corner, where edges end; else the chords on both sides stand for a curve.
    pub(super) fn is_corner(&self, vertex: usize) -> bool {
        self.turns[vertex].abs() >= self.corner
    }

    /// How far the curve through a vertex reaches before and behind it, mm: half of each chord, as far as the other is one of
    /// the same curve; nothing at a corner.
    pub(super) fn bend(&self, vertex: usize) -> [f64; 2] {
        if self.is_corner(vertex) {
            return [0.0; 2];
        }
        let [before, behind] = [self.length(self.before(vertex)), self.length(vertex)];
        [before.min(SAME_CURVE * behind), behind.min(SAME_CURVE * before)].map(|length| 0.5 * length)
    }

    /// The curvature about a vertex, 1/mm: the mean over the bends to both sides that go on in each other. Of one bend alone it
    /// would carry the rounding of three vertices.
    pub(super) fn curvature(&self, vertex: usize) -> f64 {
        let n = self.points.len();
        let (mut turn, mut way) = (self.turns[vertex], self.bend(vertex).iter().sum::<f64>());
        for (step, side) in [(1, 1), (n - 1, 0)] {
            let (mut last, mut left) = (vertex, MEAN_WAY);
            for _ in 1..n {
                let next = (last + step) % n;
                let bend = self.bend(next);
                let between = self.length(if side == 1 { last } else { next });
                let together = self.bend(last)[side] + bend[1 - side];
                left -= bend[0] + bend[1];
                if left < 0.0 || between - together > SAME_EPSILON * between {
                    break;
                }
                turn += self.turns[next];
                way += bend[0] + bend[1];
                last = next;
            }
        }
        if way > 0.0 { turn / way } else { 0.0 }
    }
}

/// The edges of everything in a marker. What is no edge is said.
pub(super) fn rings(marker: &Marker, corner: f64, out: &mut Diagnostics) -> Vec<Ring> {
    let mut closed = Vec::new();
    let mut open = 0;
    for (_, contour) in marker.contours() {
        if contour.closed {
            let (points, spans) = (marker.list.points(contour.range), marker.list.spans(contour.range));
            closed.extend(distinct(&points, &spans));
        } else {
            open += 1;
        }
    }
    let others: usize = marker.pieces.iter().map(|piece| piece.notches.len() + piece.drills.len()).sum();
    if open + others > 0 {
        let message = format!("{open} open lines and {others} notches and holes are no edges: no head follows them");
        let hint = "a head at a distance follows closed contours; a pen or a wheel follows any line";
        out.push(Diagnostic::new(&code::SPRAY_NO_EDGE, message).hint(hint));
    }
    if closed.is_empty() {
        let hint = "close the contours in the CAD system, or choose the lines that are edges";
        out.push(Diagnostic::new(&code::SPRAY_NOTHING, "the file has no closed contour").hint(hint));
    }
    (0..closed.len()).map(|i| turned(i, &closed, corner)).collect()
}

/// A contour without points that stand twice; `None` when too few are left.
fn distinct(points: &[Point], spans: &[Span]) -> Option<(Vec<Point>, Vec<Span>)> {
    let mut kept: (Vec<Point>, Vec<Span>) = (Vec::new(), Vec::new());
    for (&point, &span) in points.iter().zip(spans) {
        if kept.0.last().is_none_or(|last: &Point| (point - last).norm() > SAME_EPSILON) {
            kept.0.push(point);
            kept.1.push(span);
        }
    }
    while kept.0.len() > 1 && (kept.0[0] - kept.0[kept.0.len() - 1]).norm() <= SAME_EPSILON {
        kept.0.pop();
        kept.1.pop();
    }
    (kept.0.len() > 2).then_some(kept)
}

/// A contour as a ring: against the clock unless it lies in an odd number of others.
fn turned(i: usize, closed: &[(Vec<Point>, Vec<Span>)], corner: f64) -> Ring {
    let (mut points, mut spans) = closed[i].clone();
    let around = closed.iter().enumerate().filter(|&(j, (ring, _))| j != i && holds(ring, points[0])).count();
    if (area(&points) > 0.0) == (around % 2 == 1) {
        points.reverse();
        // Chord i goes from point i: what was before the first point is behind the last.
        spans.reverse();
        spans.rotate_left(1);
    }
    Ring::new(points, spans, corner)
}

/// Twice the area of a ring, mm2; positive against the clock.
fn area(points: &[Point]) -> f64 {
    let next = points.iter().cycle().skip(1);
    points.iter().zip(next).map(|(a, b)| a.x * b.y - a.y * b.x).sum()
}

/// Whether a point lies in a ring: a ray to the right crosses it an odd number of times.
fn holds(ring: &[Point], point: Point) -> bool {
    let next = ring.iter().cycle().skip(1);
    let crosses = |(a, b): &(&Point, &Point)| {
        (a.y > point.y) != (b.y > point.y) && point.x < a.x + (b.x - a.x) * (point.y - a.y) / (b.y - a.y)
    };
    ring.iter().zip(next).filter(crosses).count() % 2 == 1
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square(from: f64, to: f64) -> (Vec<Point>, Vec<Span>) {
        let points = [[from, from], [to, from], [to, to], [from, to]].map(|[x, y]| Point::new(x, y)).to_vec();
        let spans = (1..=4).map(|block| Span { start: 0, end: 0, block }).collect();
        (points, spans)
    }

    #[test]
    fn material_lies_on_the_left_of_parts_and_holes_whichever_way_they_are_drawn() {
        let closed = [square(0.0, 100.0), square(20.0, 80.0), square(40.0, 60.0)];
        let rings: Vec<Ring> = (0..3).map(|i| turned(i, &closed, 0.5)).collect();
        assert_eq!(rings.iter().map(|ring| area(&ring.points) > 0.0).collect::<Vec<_>>(), [true, false, true]);
        let blocks: Vec<u32> = rings[1].spans.iter().map(|span| span.block).collect();
        assert_eq!((rings[1].points[0], rings[1].points[1]), (Point::new(20.0, 80.0), Point::new(80.0, 80.0)));
        assert_eq!(blocks, [3, 2, 1, 4]);
    }

    #[test]
    fn points_that_stand_twice_are_one() {
        let (mut points, mut spans) = square(0.0, 10.0);
        points.insert(1, points[0]);
        spans.insert(1, spans[0]);
        points.push(points[0]);
        spans.push(spans[0]);
        assert_eq!(distinct(&points, &spans).expect("a ring").0.len(), 4);
        assert!(distinct(&points[..2], &spans[..2]).is_none());
    }
}
