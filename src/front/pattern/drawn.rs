//! Notches drawn in an outline: a notch point at one of them requires no second cut.

use std::f64::consts::{FRAC_PI_3, FRAC_PI_6};

use crate::geom::budget::Budget;
use crate::geom::{Point, Vector, polyline};
use crate::ir::marker::Notch;
use crate::machine::patterns::Dxf;

/// Minimum depth of a notch in the outline, mm.
pub(super) const LEAST_DEPTH: f64 = 1.5;
/// Length of edge that defines the direction beside a mouth, mm.
const BESIDE: f64 = 1.0;
/// Maximum angle between a mouth and the adjacent edge, and maximum turn of the edge across a mouth, rad.
const MOUTH_ANGLE: f64 = FRAC_PI_6;
const MOUTH_TURN: f64 = FRAC_PI_3;
/// Minimum width of a mouth with a direction, mm; the ends of a narrower one count as one point.
const NARROW: f64 = 0.5;
/// Cosine of the minimum turn of an outline at the start of a mouth, 12 degrees.
const TURN_COSINE: f64 = 0.978;
/// Fraction of the depth of a notch at which its bottom begins.
const BOTTOM: f64 = 0.7;

/// True if an outline has a drawn notch with its mouth or bottom at a point. The outline repeats its first point.
pub(super) fn makes_notch_at(outline: &[Point], at: Point, work: &mut Budget) -> bool {
    let ring = Ring(&outline[..outline.len() - 1]);
    let count = ring.0.len();
    if count < 3 || !work.spend(count) {
        return false;
    }
    let reach = Notch::WIDEST + Notch::LONGEST;
    let is_near = |i: &usize| (ring.0[*i] - at).amax() <= reach;
    (0..count).filter(is_near).any(|i| ring.turns_at(i) && ring.notch_from(i, at, work))
}

/// Vertices of an outline.
struct Ring<'a>(&'a [Point]);

impl Ring<'_> {
    fn at(&self, i: usize) -> Point {
        self.0[i % self.0.len()]
    }

    /// Unit vector along the outline before or after a vertex, measured over at least [`BESIDE`].
    fn beside(&self, i: usize, is_before: bool) -> Option<Vector> {
        let count = self.0.len();
        let step = |k: usize| self.at(if is_before { i + count - k } else { i + k });
        let far = (1..count).map(step).find(|point| (point - self.at(i)).norm() >= BESIDE)?;
        let way = (far - self.at(i)).normalize();
        Some(if is_before { -way } else { way })
    }

    fn turns_at(&self, i: usize) -> bool {
        let [before, behind] = [true, false].map(|is_before| self.beside(i, is_before));
        before.zip(behind).is_some_and(|(before, behind)| before.dot(&behind) < TURN_COSINE)
    }

    /// True if a notch marked by a point begins at a vertex.
    fn notch_from(&self, first: usize, at: Point, work: &mut Budget) -> bool {
        let mut way = 0.0;
        for last in first + 1..first + self.0.len() {
            way += (self.at(last) - self.at(last - 1)).norm();
            if way > Notch::LONGEST_STROKE || !work.spend(last - first) {
                return false;
            }
            if last > first + 1 && self.is_mouth([first, last]) && self.is_marked([first, last], at) {
                return true;
            }
        }
        false
    }

    /// True if two vertices are the ends of a mouth: the edge continues after it in the same direction.
    fn is_mouth(&self, [first, last]: [usize; 2]) -> bool {
        let mouth = self.at(last) - self.at(first);
        let Some((before, after)) = self.beside(first, true).zip(self.beside(last, false)) else { return false };
        let is_along = |way: Vector| way.dot(&mouth) >= MOUTH_ANGLE.cos() * mouth.norm();
        mouth.norm() <= Notch::WIDEST
            && before.dot(&after) >= MOUTH_TURN.cos()
            && (mouth.norm() <= NARROW || is_along(before) && is_along(after))
    }

    /// True if a point lies in the mouth of the notch between two vertices, or at its bottom.
    fn is_marked(&self, [first, last]: [usize; 2], at: Point) -> bool {
        let mouth = [self.at(first), self.at(last)];
        let depth = |place: Point| polyline::distance_to_segment(place, mouth[0], mouth[1]);
        let deepest = (first + 1..last).map(|i| depth(self.at(i))).fold(0.0, f64::max);
        let off = |i: usize| polyline::distance_to_segment(at, self.at(i), self.at(i + 1));
        let is_on_way = || (first..last).any(|i| off(i) <= Dxf::NOTCH_OFF);
        (LEAST_DEPTH..=Notch::LONGEST).contains(&deepest)
            && (depth(at) <= Dxf::NOTCH_OFF || depth(at) >= BOTTOM * deepest && is_on_way())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn is_marked(edge: &[(f64, f64)], at: (f64, f64)) -> bool {
        let corners = [(100.0, 0.0), (100.0, 50.0), (0.0, 50.0), (0.0, 0.0)];
        let outline: Vec<Point> =
            [(0.0, 0.0)].iter().chain(edge).chain(&corners).map(|&(x, y)| Point::new(x, y)).collect();
        makes_notch_at(&outline, Point::new(at.0, at.1), &mut Budget::of_a_marker())
    }

    #[test]
    fn a_point_in_the_mouth_or_at_the_bottom_of_a_drawn_notch_marks_it() {
        let slit = [(40.0, 0.0), (40.0, 6.0), (40.0, 0.0)];
        let vee = [(37.0, 0.0), (40.0, 6.0), (43.0, 0.0)];
        let castle = [(38.0, 0.0), (38.0, 6.0), (42.0, 6.0), (42.0, 0.0)];
        let outside = [(37.0, 0.0), (40.0, -6.0), (43.0, 0.0)];
        for edge in [&slit[..], &vee, &castle, &outside] {
            let tip = if edge[1].1 < 0.0 { -6.0 } else { 6.0 };
            assert!(is_marked(edge, (40.0, 0.0)), "{edge:?}");
            assert!(is_marked(edge, (40.0, tip)), "{edge:?}");
            assert!(!is_marked(edge, (50.0, 0.0)), "{edge:?}");
        }
        assert!(is_marked(&castle, (38.0, 0.0)));
    }

    #[test]
    fn a_point_on_a_plain_edge_or_at_a_corner_marks_none() {
        assert!(!is_marked(&[(40.0, 0.0)], (40.0, 0.0)));
        assert!(!is_marked(&[], (0.0, 0.0)));
        // An inward corner, as at a neck, and a step.
        assert!(!is_marked(&[(40.0, 0.0), (40.0, 6.0)], (40.0, 6.0)));
        assert!(!is_marked(&[(40.0, 0.0), (40.0, 6.0), (60.0, 6.0), (60.0, 0.0)], (40.0, 0.0)));
    }
}
