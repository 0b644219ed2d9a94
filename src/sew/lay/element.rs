//! Elements along a line: needle points of straight seams, zigzags, bar tacks and boxes.

use super::pitch::even;
use super::satin::satin;
use crate::geom::{Point, Vector, left};
use crate::machine::Sewing;
use crate::sew::pattern::{Element, Seam, distinct};

/// The needle points of a seam, before its ends are locked.
pub(super) fn needle_points(seam: &Seam, sewing: &Sewing) -> Vec<Point> {
    let pitch = |usual: f64| seam.pitch.unwrap_or(usual);
    let width = |usual: f64| seam.width.unwrap_or(usual);
    let straight = |points: &[Point], pitch: f64| even(points, pitch, sewing.corner_deg);
    match seam.element {
        Element::Straight => straight(&seam.points, pitch(sewing.pitch_mm)),
        Element::Zigzag => {
            zigzag(&straight(&seam.points, pitch(sewing.zigzag_pitch_mm)), width(sewing.zigzag_width_mm))
        }
        Element::BarTack | Element::Eyelet => {
            // The underlay, then the zigzag back over it.
            let mut points = straight(&seam.points, sewing.pitch_mm);
            let back: Vec<Point> = seam.points.iter().rev().copied().collect();
            points.extend(zigzag(&straight(&back, pitch(sewing.tack_pitch_mm)), width(sewing.tack_width_mm)));
            points
        }
        Element::Satin => satin(&seam.points, pitch(sewing.tack_pitch_mm)),
        // The corners of a box count as corners at any angle.
        Element::BoxX => even(&box_x(&seam.points), pitch(sewing.pitch_mm), 0.0),
    }
}

/// The line of the thread of a seam: straight seams and boxes follow their lines, others run from needle point to needle point.
pub(super) fn line(seam: &Seam, points: &[Point]) -> Vec<Point> {
    match seam.element {
        Element::Straight => distinct(&seam.points),
        Element::BoxX => box_x(&seam.points),
        Element::Zigzag | Element::BarTack | Element::Satin | Element::Eyelet => points.to_vec(),
    }
}

/// Needle points alternating between both sides of a line, at half a width from each of its points; at a vertex on the
/// bisector.
fn zigzag(middle: &[Point], width: f64) -> Vec<Point> {
    let along = |a: Point, b: Point| (b - a).try_normalize(0.0).unwrap_or_else(Vector::zeros);
    let point = |i: usize| {
        let here = middle[i];
        let before = if i > 0 { along(middle[i - 1], here) } else { Vector::zeros() };
        let behind = if i + 1 < middle.len() { along(here, middle[i + 1]) } else { Vector::zeros() };
        // At a reversal of the line the side is that of the direction before it.
        let direction = (before + behind).try_normalize(f64::EPSILON).unwrap_or(before);
        let side = if i.is_multiple_of(2) { 1.0 } else { -1.0 };
        here + left(direction) * (side * width / 2.0)
    };
    (0..middle.len()).map(point).collect()
}

/// Path around a box and along its diagonals without a thread cut: around, across, along one edge again, across.
fn box_x(points: &[Point]) -> Vec<Point> {
    match distinct(points)[..] {
        [a, b, c, d, ..] => vec![a, b, c, d, a, c, d, b],
        _ => points.to_vec(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::source::Span;

    fn laid(element: Element, points: &[[f64; 2]]) -> Vec<[f64; 2]> {
        let points = points.iter().map(|&[x, y]| Point::new(x, y)).collect();
        let seam = Seam { element, ..Seam::plain(points, Span::default()) };
        let rounded = |value: f64| (value * 1e3).round() / 1e3;
        needle_points(&seam, &Sewing::default()).iter().map(|p| [rounded(p.x), rounded(p.y)]).collect()
    }

    #[test]
    fn a_zigzag_goes_from_side_to_side() {
        let points = laid(Element::Zigzag, &[[0.0, 0.0], [3.0, 0.0]]);
        assert_eq!(points, [[0.0, 1.5], [1.0, -1.5], [2.0, 1.5], [3.0, -1.5]]);
    }

    #[test]
    fn a_bar_tack_comes_back_over_its_straight_seam() {
        let points = laid(Element::BarTack, &[[0.0, 0.0], [4.0, 0.0]]);
        assert_eq!(points[..3], [[0.0, 0.0], [2.0, 0.0], [4.0, 0.0]]);
        assert_eq!((points.len(), points[3], points[13]), (14, [4.0, -1.0], [0.0, -1.0]));
    }

    #[test]
    fn a_box_is_sewn_with_both_diagonals_and_one_thread() {
        let points = laid(Element::BoxX, &[[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0], [0.0, 0.0]]);
        let corners: Vec<[f64; 2]> = points.into_iter().filter(|p| p.iter().all(|v| [0.0, 2.0].contains(v))).collect();
        let [a, b, c, d] = [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]];
        assert_eq!(corners, [a, b, c, d, a, c, d, b]);
    }
}
