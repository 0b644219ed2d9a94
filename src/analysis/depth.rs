//! Depth of the overlap of two parts: distance from the deepest place of one in the other to the edge of that.
//!
//! An estimate from the vertices and some places of each segment within the common box of both. It is exact for an overlap by
//! edges along each other, as in a nest. Two parts of one shape that lie nearly on each other overlap by little depth and most
//! of their area: see [`share`].

use super::outlines::Outlines;
use crate::geom::budget::Budget;
use crate::geom::{Extent, Point};

/// Spacing of the places tried on a segment, mm, and the range of their number, ends included.
const STEP: f64 = 2.0;
const PLACES: std::ops::RangeInclusive<usize> = 5..=500;

/// Number of parallel lines over a box along which areas are measured.
const ROWS: usize = 32;

/// Deepest place.
#[derive(Debug, Clone, Copy)]
pub struct Depth {
    /// Depth, mm.
    pub by: f64,
    /// Position.
    pub at: Point,
    /// Depth of the deepest place of an outline, mm: an open line in a part takes no cloth from it.
    pub of_outlines: f64,
    /// True if all places were tried: the budget was not spent first.
    pub is_whole: bool,
}

/// Depth of the overlap of two parts; that of the places tried so far once the budget is spent.
pub fn depth([a, b]: [&Outlines; 2], work: &mut Budget) -> Depth {
    let common = common(&a.extent, &b.extent);
    let mut deepest = Depth { by: 0.0, at: common.min, of_outlines: 0.0, is_whole: true };
    for (part, other) in [(a, b), (b, a)] {
        for k in 0..part.contours.len() {
            let is_closed = part.contours[k].is_closed;
            for ends in part.contour(k).windows(2) {
                let Some([from, to]) = clipped([ends[0], ends[1]], &common) else { continue };
                // An odd number puts the middle among them.
                let places = (((to - from).norm() / STEP) as usize).clamp(*PLACES.start(), *PLACES.end()) | 1;
                for i in 0..places {
                    if !work.spend(2 * other.points.len()) {
                        return Depth { is_whole: false, ..deepest };
                    }
                    let at = from + (to - from) * (i as f64 / (places - 1) as f64);
                    if !other.holds(at) {
                        continue;
                    }
                    let by = other.distance(at);
                    if by > deepest.by {
                        (deepest.by, deepest.at) = (by, at);
                    }
                    if is_closed && by > deepest.of_outlines {
                        deepest.of_outlines = by;
                    }
                }
            }
        }
    }
    deepest
}

/// Share of the smaller one of two parts that lies in the other, and the index of the smaller one. Zero for lines without area.
pub fn share(parts: [&Outlines; 2]) -> (f64, usize) {
    let areas = parts.map(|part| area(&[part], &part.extent));
    let smaller = usize::from(areas[1] < areas[0]);
    if areas[smaller] <= 0.0 {
        return (0.0, smaller);
    }
    (area(&parts, &common(&parts[0].extent, &parts[1].extent)) / areas[smaller], smaller)
}

/// Area of a box that lies in all of some parts, mm2, by its share of [`ROWS`] lines along X.
fn area(parts: &[&Outlines], within: &Extent) -> f64 {
    let step = (within.max.y - within.min.y) / ROWS as f64;
    if !(step > 0.0 && step.is_finite()) {
        return 0.0;
    }
    let height = |row: usize| within.min.y + (row as f64 + 0.5) * step;
    // Each crossing of a row by an edge of a part: the row, the place along it, and the part.
    let mut crossings: Vec<(usize, f64, usize)> = Vec::new();
    for (part, index) in parts.iter().zip(0..) {
        for ends in part.closed().flat_map(|points| points.windows(2)) {
            let [low, high] = if ends[0].y < ends[1].y { [ends[0], ends[1]] } else { [ends[1], ends[0]] };
            // Conversion saturates, and a row lies in the middle of its step.
            let first = ((low.y - within.min.y) / step - 0.5).ceil() as usize;
            for row in (first..ROWS).take_while(|&row| height(row) < high.y).filter(|&row| height(row) >= low.y) {
                let along = (height(row) - low.y) / (high.y - low.y);
                crossings.push((row, low.x + (high.x - low.x) * along, index));
            }
        }
    }
    crossings.sort_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
    let mut length = 0.0;
    for row in crossings.chunk_by(|a, b| a.0 == b.0) {
        let mut is_in = vec![false; parts.len()];
        for (k, &(_, x, part)) in row.iter().enumerate() {
            if k > 0 && is_in.iter().all(|&is_in| is_in) {
                length += x - row[k - 1].1;
            }
            is_in[part] = !is_in[part];
        }
    }
    length * step
}

/// Intersection of two boxes.
fn common(a: &Extent, b: &Extent) -> Extent {
    let min = Point::new(a.min.x.max(b.min.x), a.min.y.max(b.min.y));
    Extent { min, max: Point::new(a.max.x.min(b.max.x), a.max.y.min(b.max.y)) }
}

/// Part of a segment inside a box (Liang and Barsky, *A new concept and method for line clipping*, 1984).
fn clipped([from, to]: [Point; 2], within: &Extent) -> Option<[Point; 2]> {
    let way = to - from;
    let (mut start, mut end) = (0.0_f64, 1.0_f64);
    for axis in 0..2 {
        let room = [within.min[axis] - from[axis], within.max[axis] - from[axis]];
        if way[axis] == 0.0 {
            if room[0] > 0.0 || room[1] < 0.0 {
                return None;
            }
        } else {
            let [a, b] = room.map(|room| room / way[axis]);
            start = start.max(a.min(b));
            end = end.min(a.max(b));
        }
    }
    (start <= end).then(|| [from + way * start, from + way * end])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ir::marker::{Contour, Marker, Piece};

    /// Shares of two rectangles, given by two corners each, the first with a hole where one is given.
    fn shares(rectangles: [[f64; 4]; 2], hole: Option<[f64; 4]>) -> (f64, usize) {
        let mut marker = Marker::default();
        for (k, corners) in rectangles.into_iter().enumerate() {
            let mut piece = Piece::default();
            for [x, y, right, top] in std::iter::once(corners).chain(hole.filter(|_| k == 0)) {
                let corners = [[x, y], [right, y], [right, top], [x, top], [x, y]];
                let range = marker.list.append_line(&corners.map(Point::from), &[piece.span; 5]);
                piece.contours.extend(range.map(|range| Contour { range, closed: true }));
            }
            marker.pieces.push(piece);
        }
        share([&Outlines::of(&marker, 0), &Outlines::of(&marker, 1)])
    }

    #[test]
    fn a_segment_is_clipped_to_a_box() {
        let within = Extent { min: Point::new(0.0, 0.0), max: Point::new(10.0, 5.0) };
        let clip = |a: [f64; 2], b: [f64; 2]| clipped([a.into(), b.into()], &within);
        assert_eq!(clip([-5.0, 2.0], [15.0, 2.0]), Some([Point::new(0.0, 2.0), Point::new(10.0, 2.0)]));
        assert_eq!(clip([-5.0, 6.0], [15.0, 6.0]), None);
        assert_eq!(clip([1.0, 1.0], [2.0, 2.0]), Some([Point::new(1.0, 1.0), Point::new(2.0, 2.0)]));
    }

    #[test]
    fn a_share_is_that_of_the_smaller_part_without_its_holes() {
        let check = |rectangles, hole, expected: f64, smaller| {
            let (share, index) = shares(rectangles, hole);
            assert!((share - expected).abs() < 0.02 && index == smaller, "{share} of {index}");
        };
        let part = [0.0, 0.0, 100.0, 100.0];
        check([part, [20.0, 96.0, 60.0, 104.0]], None, 0.5, 1);
        check([[20.0, 96.0, 60.0, 104.0], part], None, 0.5, 0);
        check([part, [3.0, 0.0, 103.0, 100.0]], None, 0.97, 0);
        check([part, [100.0, 0.0, 200.0, 50.0]], None, 0.0, 1);
        // The hole takes up three quarters of the second part.
        check([part, [50.0, 50.0, 90.0, 90.0]], Some([50.0, 50.0, 80.0, 90.0]), 0.25, 1);
    }
}
