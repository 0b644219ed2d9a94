//! Depth of the overlap of two parts: distance from the deepest place of one in the other to the edge of that.
//!
//! An estimate from the vertices and some places of each segment within the common box of both. It is exact for an overlap by
//! edges along each other, as in a nest.

use super::outlines::Outlines;
use crate::geom::budget::Budget;
use crate::geom::{Extent, Point};

/// Spacing of the places tried on a segment, mm, and the range of their number, ends included.
const STEP: f64 = 2.0;
const PLACES: std::ops::RangeInclusive<usize> = 5..=500;

/// Deepest place.
#[derive(Debug, Clone, Copy)]
pub struct Depth {
    /// Depth, mm.
    pub by: f64,
    /// Position.
    pub at: Point,
}

/// Depth of the overlap of two parts; `None` if the budget was spent first.
pub fn depth([a, b]: [&Outlines; 2], work: &mut Budget) -> Option<Depth> {
    let common = common(&a.extent, &b.extent);
    let mut deepest = Depth { by: 0.0, at: common.min };
    for (part, other) in [(a, b), (b, a)] {
        for k in 0..part.contours.len() {
            for ends in part.contour(k).windows(2) {
                let Some([from, to]) = clipped([ends[0], ends[1]], &common) else { continue };
                // An odd number puts the middle among them.
                let places = (((to - from).norm() / STEP) as usize).clamp(*PLACES.start(), *PLACES.end()) | 1;
                for i in 0..places {
                    if !work.spend(2 * other.points.len()) {
                        return None;
                    }
                    let at = from + (to - from) * (i as f64 / (places - 1) as f64);
                    if !other.holds(at) {
                        continue;
                    }
                    let by = other.distance(at);
                    if by > deepest.by {
                        deepest = Depth { by, at };
                    }
                }
            }
        }
    }
    Some(deepest)
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

    #[test]
    fn a_segment_is_clipped_to_a_box() {
        let within = Extent { min: Point::new(0.0, 0.0), max: Point::new(10.0, 5.0) };
        let clip = |a: [f64; 2], b: [f64; 2]| clipped([a.into(), b.into()], &within);
        assert_eq!(clip([-5.0, 2.0], [15.0, 2.0]), Some([Point::new(0.0, 2.0), Point::new(10.0, 2.0)]));
        assert_eq!(clip([-5.0, 6.0], [15.0, 6.0]), None);
        assert_eq!(clip([1.0, 1.0], [2.0, 2.0]), Some([Point::new(1.0, 1.0), Point::new(2.0, 2.0)]));
    }
}
