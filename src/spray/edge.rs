//! Edges of parts: closed rings with the material on their left.

use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::geom::{Heading, Point, Vector, polyline, ring};
use crate::ir::Marker;
use crate::source::Span;

/// Distance below which two points are the same, mm; far below the resolution of a file.
const SAME_EPSILON: f64 = 1e-6;

/// A closed edge with the material on the left of each chord: counter-clockwise around a part, clockwise around a hole.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Ring {
    /// Vertices, mm. The last one is joined to the first.
    pub(super) points: Vec<Point>,
    /// Source block of the chord behind each vertex.
    pub(super) spans: Vec<Span>,
    /// Turn of the direction at each vertex, rad. It is positive to the left, at an outward corner of the part.
    pub(super) turns: Vec<f64>,
    /// True for the vertices that are corners, at which edges end. At other vertices the chords on both sides stand for a
    /// curve.
    corners: Vec<bool>,
}

impl Ring {
    /// The ring of these vertices, in this order. Turns of at least `corner` rad are corners.
    pub(super) fn new(points: Vec<Point>, spans: Vec<Span>, corner: f64) -> Self {
        let n = points.len();
        let mut ring = Self::with_corners(points, spans, vec![false; n]);
        ring.corners = ring.turns.iter().map(|turn| turn.abs() >= corner).collect();
        ring
    }

    /// The ring of these vertices with known corners.
    pub(super) fn with_corners(points: Vec<Point>, spans: Vec<Span>, corners: Vec<bool>) -> Self {
        let n = points.len();
        let turns =
            (0..n).map(|i| polyline::turn_at(points[(i + n - 1) % n], points[i], points[(i + 1) % n])).collect();
        Self { points, spans, turns, corners }
    }

    /// Start and end of a chord.
    pub(super) fn chord(&self, chord: usize) -> [Point; 2] {
        [self.points[chord], self.points[self.behind(chord)]]
    }

    /// Unit vector along a chord.
    pub(super) fn along(&self, chord: usize) -> Vector {
        let [from, to] = self.chord(chord);
        (to - from).normalize()
    }

    /// Length of a chord, mm.
    pub(super) fn length(&self, chord: usize) -> f64 {
        let [from, to] = self.chord(chord);
        (to - from).norm()
    }

    /// Inward normal of a chord, as an angle, rad.
    pub(super) fn inwards(&self, chord: usize) -> f64 {
        Heading::of(self.along(chord)).radians() + std::f64::consts::FRAC_PI_2
    }

    /// Index of the chord before a vertex.
    pub(super) fn before(&self, vertex: usize) -> usize {
        (vertex + self.points.len() - 1) % self.points.len()
    }

    /// Index of the vertex behind a chord or another vertex.
    pub(super) fn behind(&self, vertex: usize) -> usize {
        (vertex + 1) % self.points.len()
    }

    /// True if the vertex is a corner.
    pub(super) fn is_corner(&self, vertex: usize) -> bool {
        self.corners[vertex]
    }
}

/// The edges of all closed contours of a marker. Reports lines that are not edges.
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

/// The contour without consecutive duplicate points; `None` if fewer than three are left.
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

/// A contour as a ring: clockwise if it lies in an odd number of other contours, otherwise counter-clockwise.
fn turned(i: usize, closed: &[(Vec<Point>, Vec<Span>)], corner: f64) -> Ring {
    let (mut points, mut spans) = closed[i].clone();
    let around = closed.iter().enumerate().filter(|&(j, (ring, _))| j != i && ring::contains(ring, points[0])).count();
    if (ring::area(&points) > 0.0) == (around % 2 == 1) {
        points.reverse();
        // Chord i goes from point i, so the blocks move by one.
        spans.reverse();
        spans.rotate_left(1);
    }
    Ring::new(points, spans, corner)
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
        assert_eq!(rings.iter().map(|ring| ring::area(&ring.points) > 0.0).collect::<Vec<_>>(), [true, false, true]);
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
